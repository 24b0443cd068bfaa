#include <algorithm>
#include <memory>

#include "experiments/analysis/step_times.hpp"
#include "experiments/cli/command.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/report/experiment_report.hpp"
#include "experiments/report/named_trials.hpp"
#include "experiments/report/trial_views.hpp"
#include "experiments/run/run_request.hpp"
#include "experiments/session/result_files.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/document/renderers.hpp"

namespace croon::experiments {
namespace {

/// The report of the results in `folder`. Without the data, it contains a note instead of the view
/// of the clouds, unless the options name trials.
std::string report_of(const std::filesystem::path& folder, const ReportOptions& options,
                      const Catalogue& catalogue) {
  std::error_code ignored;
  if (std::filesystem::exists(folder / "rig.json", ignored) &&
      !std::filesystem::exists(store_path(folder), ignored)) {
    throw InputError(folder.string(), "",
                     "expected results of croon run, found a calibration, whose report.html is "
                     "written by croon calibrate");
  }
  Results results = read_results(folder, Content::trials_and_steps);
  results.times = step_times(TimingsStore(timings_path(folder), Access::read), results.summary);
  std::vector<TrialView> views;
  std::string without_views = "No trial has a pose.";
  try {
    views = trial_views(results, options.trials, data_root(options.data), catalogue);
  } catch (const InputError& error) {
    if (!options.trials.empty()) throw;
    without_views = "The clouds of the trials could not be read, so there is no view of them: " +
                    error.faults().front().line() + ". With --data the report shows them.";
  }
  return html_document(experiment_report(results, views, without_views));
}

}  // namespace

int report_command(const ReportOptions& options, const Catalogue& catalogue, std::ostream& out) {
  if (!can_write_html()) {
    throw InputError("", "report", "this build of croon writes no reports (CROON_WITH_REPORT)");
  }
  if (!options.trials.empty() && options.folders.size() > 1) {
    throw InputError("", kTrialOption,
                     "expected one folder, found " + std::to_string(options.folders.size()));
  }
  refuse_repeats(options.folders);
  for (const std::filesystem::path& folder : options.folders) {
    const std::string bytes = report_of(folder, options, catalogue);
    const std::filesystem::path path = folder / kReport;
    write_whole_file(path, bytes);
    out << left_out_times_text(folder) << "The report is in " << printable(path.string()) << "\n";
  }
  return 0;
}

namespace {

class ReportCommand final : public Command {
 public:
  std::string sentence() const override {
    return "Write a report of results, report.html, to look at and to send.";
  }

  void add_options(CLI::App& command) override {
    add_path(command, "DIR", options_.folders, "Folders of results of `croon run`.")->required();
    add_text(command, kTrialOption, options_.trials,
             "Also show the clouds of this trial, VARIANT/SCENE/SENSOR/NUMBER, without VARIANT if "
             "there is only one; may be repeated.",
             "a trial")
        ->type_name("TRIAL")
        ->allow_extra_args(false);
    add_data(command, options_.data);
  }

  int run(const Console& console) override {
    return report_command(options_, console.catalogue, console.out);
  }

 private:
  ReportOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_report_command() { return std::make_unique<ReportCommand>(); }

}  // namespace croon::experiments
