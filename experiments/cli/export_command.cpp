#include "experiments/cli/export_command.hpp"

#include <map>
#include <vector>

#include "experiments/cli/output_file.hpp"
#include "experiments/cli/output_folder.hpp"
#include "experiments/cli/results_folder.hpp"
#include "experiments/report/export_formats.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

using Writer = std::string (*)(const ExportTable&);

Writer writer_of(const std::string& format) {
  static const std::map<std::string, Writer> writers = {
      {"csv", export_csv}, {"json", export_json}, {"latex", export_latex}, {"md", export_markdown}};
  const auto found = writers.find(format);
  if (found != writers.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, writer] : writers) names.push_back(name);
  throw InputError("", "--format", "unknown format \"" + format + "\"" + name_hint(format, names));
}

ExportCaption caption_of(const Results& results) {
  return {results.name,   results.commit,         results.seed,   results.scenes,
          results.trials, results.records.size(), results.planned};
}

}  // namespace

int export_command(const ExportOptions& options, std::ostream& out) {
  const Writer write = writer_of(options.format);
  const Results results = read_results(options.folder);
  const std::string text = write(export_table(results.summary, caption_of(results)));
  if (options.out.empty()) {
    out << text;
  } else {
    write_output_file(options.out, text, store_path(options.folder));
  }
  return 0;
}

}  // namespace croon::experiments
