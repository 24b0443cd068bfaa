#include "experiments/cli/commands.hpp"

#include <vector>

#include "experiments/analysis/results.hpp"
#include "experiments/report/build_text.hpp"
#include "experiments/report/export.hpp"
#include "experiments/report/result_files.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

const ExportFormat& format_called(const std::string& name) {
  std::vector<std::string> names;
  for (const ExportFormat& format : export_formats()) {
    if (name == format.name) return format;
    names.emplace_back(format.name);
  }
  throw InputError("", "--format", "unknown format \"" + name + "\"" + name_hint(name, names));
}

ExportCaption caption_of(const Results& results) {
  return {results.name,   results.commit,         results.seed,    results.scenes,
          results.trials, results.records.size(), results.planned, build_sentences(results.builds)};
}

}  // namespace

int export_command(const ExportOptions& options, std::ostream& out) {
  const ExportFormat& format = format_called(options.format);
  const Results results = read_results(options.folder);
  const std::string text = format.bytes(export_table(results.summary, caption_of(results)));
  if (options.out.empty()) {
    out << text;
  } else {
    write_output_file(options.out, text, store_path(options.folder));
  }
  return 0;
}

}  // namespace croon::experiments
