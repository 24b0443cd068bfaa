#include "experiments/cli/report_files.hpp"

#include <algorithm>

#include "experiments/report/box_plots.hpp"
#include "experiments/report/claims.hpp"
#include "experiments/report/csv_files.hpp"
#include "experiments/report/table.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::experiments {
namespace {

/// Writes the file where it is wanted; else none stays from an earlier run.
void write_or_remove(const std::filesystem::path& path, const std::string& bytes, bool is_wanted) {
  if (is_wanted) return write_whole_file(path, bytes);
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) throw InputError(path.string(), "", "cannot be deleted: " + error.message());
}

}  // namespace

void write_reports(const std::filesystem::path& folder, const Results& results,
                   const std::string& manifest) {
  const Summary& summary = results.summary;
  write_whole_file(folder / "trials.csv", trials_csv(results.records));
  write_whole_file(folder / "summary.csv", summary_csv(summary));
  write_whole_file(folder / "summary.json", summary_json(summary, results.claims));
  write_or_remove(folder / "summary_by_kind.csv", summary_by_kind_csv(summary),
                  !summary.kinds.empty());
  write_or_remove(folder / "comparison.csv", comparison_csv(summary), !summary.comparisons.empty());
  write_or_remove(folder / "loops.csv", loops_csv(summary), !summary.loops.empty());
  const bool is_sweep = results.basin.has_value();
  write_or_remove(folder / "basin.csv", is_sweep ? basin_csv(*results.basin) : "", is_sweep);
  write_or_remove(folder / "basin.svg", is_sweep ? basin_svg(*results.basin) : "", is_sweep);
  write_whole_file(folder / "box_plots.svg", box_plots_svg(summary));
  write_whole_file(folder / "manifest.json", manifest);
}

std::string result_text(const Results& results, bool colours) {
  TableStyle style;
  style.colours = colours;
  std::string text = summary_table(results.summary, style);
  if (results.basin) text += "\n" + basin_table(*results.basin, style);
  const std::string claims_text =
      claims_table(results.claims, results.quoted, results.summary, style);
  return claims_text.empty() ? text : text + "\n" + claims_text;
}

bool has_failed_trials(const Results& results) {
  return std::any_of(results.records.begin(), results.records.end(),
                     [](const TrialRecord& record) { return record.status == Status::failed; });
}

}  // namespace croon::experiments
