#include "experiments/cli/commands.hpp"

#include <memory>
#include <vector>

#include "experiments/analysis/results.hpp"
#include "experiments/cli/command.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/report/build_text.hpp"
#include "experiments/report/export.hpp"
#include "experiments/report/export_choice.hpp"
#include "experiments/report/figures.hpp"
#include "experiments/report/output_files.hpp"
#include "framework/base/error.hpp"
#include "framework/picture/writers.hpp"

namespace croon::experiments {
namespace {

/// The row called `name`. Throws InputError for the option `option` if there is none.
template <class Row>
const Row& called(const std::string& option, const std::string& name,
                  const std::vector<Row>& rows) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    if (name == row.name) return row;
    names.emplace_back(row.name);
  }
  throw InputError("", option,
                   "unknown " + option.substr(2) + " \"" + name + "\"" + name_hint(name, names));
}

ExportCaption caption_of(const Results& results, const std::vector<std::string>& kinds) {
  return {results.name,
          results.commit,
          results.seed,
          results.scenes,
          results.trials,
          results.records.size(),
          results.planned,
          kinds,
          build_sentences(results.builds),
          results.scenes_per_trial};
}

/// Throws InputError for options that do not apply to the table or figure and for unknown units.
void refuse_options(const ExportOptions& options) {
  const bool is_figure = !options.figure.empty();
  const auto refuse = [](bool is_given, const char* option, const char* what) {
    if (is_given) throw InputError("", option, std::string("expected only with ") + what);
  };
  refuse(is_figure && !options.columns.empty(), "--columns", "tables, found with --figure");
  refuse(is_figure && options.compact, "--compact", "tables, found with --figure");
  refuse(!is_figure && options.title, "--title", "--figure");
  if (options.units.empty() || options.units == "m" || options.units == "mm") return;
  throw InputError("", "--units", "expected m or mm, found \"" + options.units + "\"");
}

std::string figure_bytes(const ExportOptions& options) {
  if (options.figure == "ranges") {
    throw InputError("", "--figure",
                     "the figure of ranges shows clouds: use croon describe --out DIR");
  }
  const Figure& figure = called("--figure", options.figure, figures());
  const std::string format = options.format.empty() ? "pdf" : options.format;
  const DrawingFormat& writer = called("--format", format, drawing_formats());
  FigureOptions figure_options;
  figure_options.sheet = sheet_called(options.width, format, kTwoColumns);
  figure_options.sheet.has_title = figure_options.sheet.has_title || options.title;
  figure_options.length_unit = options.units;
  if (options.folders.size() > 1) {
    throw InputError("", "--figure",
                     "expected one folder, found " + std::to_string(options.folders.size()));
  }
  const std::filesystem::path& folder = options.folders.front();
  const Results results =
      restricted(read_results(folder), {options.variants, options.sensors, options.kinds});
  const std::optional<Drawing> drawing = figure.draw(results, figure_options);
  if (!drawing) {
    throw InputError(folder.string(), "",
                     std::string("expected results with ") + figure.requirement +
                         " for the figure " + figure.name);
  }
  return writer.bytes(*drawing);
}

std::string table_bytes(const ExportOptions& options) {
  const ExportFormat& format =
      called("--format", options.format.empty() ? "md" : options.format, export_formats());
  TableChoice choice = {options.sensors, options.columns, options.units == "mm", options.compact,
                        options.compact};
  if (!options.width.empty()) {
    choice.is_one_column =
        called("--width", options.width, named_sheets()).sheet.width == kOneColumn.width;
  }
  const bool is_full = choice.columns.empty() && !options.compact && !format.fits_page;
  if (is_full && choice.is_one_column) {
    throw InputError("", "--width", "the full table spans two columns; use --compact or --columns");
  }
  std::vector<Summary> summaries;
  std::vector<ExportCaption> captions;
  std::vector<std::string> folders;
  refuse_repeats(options.folders);
  for (const std::filesystem::path& folder : options.folders) {
    // The trials are not kept in memory: several folders may have millions.
    Results results = restricted(read_results(folder), {options.variants, {}, options.kinds});
    captions.push_back(caption_of(results, options.kinds));
    summaries.push_back(std::move(results.summary));
    folders.push_back(folder.string());
  }
  if (choice.columns.empty() && !is_full) {
    choice.columns = page_columns(summaries, choice.is_one_column);
  }
  std::vector<ExportTable> tables;
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    tables.push_back(export_table(summaries[i], captions[i], choice));
  }
  return format.bytes(joined(std::move(tables), folders));
}

}  // namespace

void refuse_repeats(const std::vector<std::filesystem::path>& paths, const std::string& what) {
  std::error_code error;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!std::filesystem::equivalent(paths[i], paths[j], error)) continue;
      throw InputError(paths[i].string(), "",
                       "expected each " + what + " once, found this one twice");
    }
  }
}

Sheet sheet_called(const std::string& width, const std::string& format, const Sheet& on_paper) {
  if (width.empty()) return format == "svg" ? Sheet{} : on_paper;
  return called("--width", width, named_sheets()).sheet;
}

int export_command(const ExportOptions& options, std::ostream& out) {
  refuse_options(options);
  const std::string text = options.figure.empty() ? table_bytes(options) : figure_bytes(options);
  if (options.out.empty()) {
    out << text;
    return 0;
  }
  replace_output_files({{options.out, text}});
  return 0;
}

namespace {

class ExportCommand final : public Command {
 public:
  std::string sentence() const override {
    return "Write results as a table or a figure for a paper.";
  }

  void add_options(CLI::App& command) override {
    ExportOptions& o = options_;
    add_path(command, "DIR", o.folders,
             "Folders of results: any number for a table, one for a figure.")
        ->required();
    add_text(command, "--format", o.format,
             names_of(export_formats()) +
                 "; default md. With --figure: " + names_of(drawing_formats()) + "; default pdf.",
             "a format");
    add_path(command, "--out", o.out, "File to write; default standard output.");
    add_text(command, "--figure", o.figure, "A figure: " + names_of(figures()) + ".", "a figure");
    add_width(command, o.width);
    add_text(command, "--units", o.units, "Unit of lengths: m, mm.", "m or mm");
    add_text(command, "--variants", o.variants, "Only these variants.", "a variant");
    add_text(command, "--sensors", o.sensors,
             "Only these sensors; in tables, all is the row of all sensors pooled.", "a sensor");
    add_text(command, "--kinds", o.kinds, "Only scenes of these kinds.", "a kind of scene");
    add_text(command, "--columns", o.columns,
             "Columns of a table: success, rotation_median, x, x_p95, ...", "a column");
    command.add_flag("--compact", o.compact, "One row per variant, narrow enough for a page.");
    command.add_flag("--title", o.title, "Add a title to the figure.");
  }

  int run(const Console& console) override { return export_command(options_, console.out); }

 private:
  ExportOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_export_command() { return std::make_unique<ExportCommand>(); }

}  // namespace croon::experiments
