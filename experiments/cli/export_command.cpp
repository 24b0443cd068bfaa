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
#include "experiments/session/output_files.hpp"
#include "experiments/store/timings_store.hpp"
#include "framework/base/error.hpp"
#include "framework/picture/writers.hpp"

namespace croon::experiments {
namespace {

constexpr const char* kRangesAdvice =
    "the figure of ranges shows clouds: use croon describe EXPERIMENT --out DIR";

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

/// The results in the only folder, restricted to the chosen trials. The wall times of millions of
/// trials take seconds to read, so only a figure that shows them has them.
Results figure_results(const ExportOptions& options, bool with_times) {
  if (options.folders.size() > 1) {
    throw InputError("", "--figure",
                     "expected one folder, found " + std::to_string(options.folders.size()));
  }
  const std::filesystem::path& folder = options.folders.front();
  Results results =
      restricted(read_results(folder), {options.variants, options.sensors, options.kinds});
  if (with_times) {
    results.times = step_times(TimingsStore(timings_path(folder), Access::read), results.summary);
  }
  return results;
}

FigureOptions figure_options(const ExportOptions& options, Sheet sheet) {
  sheet.has_title = sheet.has_title || options.title;
  return {sheet, options.units};
}

std::string figure_bytes(const ExportOptions& options) {
  if (options.figure == "ranges") throw InputError("", "--figure", kRangesAdvice);
  const Figure& figure = called("--figure", options.figure, figures());
  const std::string format = options.format.empty() ? "pdf" : options.format;
  const DrawingFormat& writer = called("--format", format, drawing_formats());
  const Sheet sheet = sheet_called(options.width, format, kTwoColumns);
  const Results results = figure_results(options, figure.has_times);
  const std::optional<Drawing> drawing = figure.draw(results, figure_options(options, sheet));
  if (!drawing) {
    throw InputError(options.folders.front().string(), "",
                     std::string("expected results with ") + figure.requirement +
                         " for the figure " + figure.name);
  }
  return writer.bytes(*drawing);
}

/// Writes every figure that the results have, as each format and for each column width unless the
/// options choose one, and a line for each figure that is missing.
void export_all_figures(const ExportOptions& options, std::ostream& out) {
  if (options.out.empty()) throw InputError("", "--out", "expected a folder with --figure all");
  std::vector<DrawingFormat> formats = drawing_formats();
  if (!options.format.empty()) formats = {called("--format", options.format, formats)};
  std::vector<NamedSheet> sheets = {called("--width", "one_column", named_sheets()),
                                    called("--width", "two_columns", named_sheets())};
  if (!options.width.empty()) sheets = {called("--width", options.width, named_sheets())};
  const Results results = figure_results(options, true);
  std::vector<OutputFile> files;
  std::string missing;
  for (const Figure& figure : figures()) {
    for (const NamedSheet& sheet : sheets) {
      const std::string name = figure.name + std::string("_") + sheet.name;
      try {
        const std::optional<Drawing> drawing =
            figure.draw(results, figure_options(options, sheet.sheet));
        if (!drawing) {
          missing += std::string("no ") + figure.name + ": needs " + figure.requirement + "\n";
          break;
        }
        for (const DrawingFormat& format : formats) {
          files.push_back({options.out / (name + "." + format.name), format.bytes(*drawing)});
        }
      } catch (const InputError& error) {  // It does not fit the sheet.
        missing += "no " + name + ": " + error.what() + "\n";
      }
    }
  }
  make_folder(options.out);
  replace_output_files(files);
  for (const OutputFile& file : files) out << file.path.string() << "\n";
  out << missing << "no ranges: " << kRangesAdvice << "\n";
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
  if (options.figure == "all") {
    export_all_figures(options, out);
    return 0;
  }
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
    add_path(command, "--out", o.out,
             "File to write, with --figure all a folder; default standard output.");
    add_text(command, "--figure", o.figure,
             "A figure: " + names_of(figures()) + "; or all, written to the folder --out.",
             "a figure");
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
