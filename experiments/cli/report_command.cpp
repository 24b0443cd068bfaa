#include <algorithm>
#include <memory>

#include "experiments/analysis/step_times.hpp"
#include "experiments/cli/command.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/report/experiment_report.hpp"
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
/// of the clouds.
std::string report_of(const std::filesystem::path& folder, const std::filesystem::path& data,
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
    views = trial_views(results, data, catalogue);
  } catch (const InputError& error) {
    without_views = "The clouds of the trials could not be read, so there is no view of them: " +
                    error.faults().front().line() + ". With --data the report shows them.";
  }
  return html_document(experiment_report(results, views, without_views));
}

}  // namespace

int report_command(const std::vector<std::filesystem::path>& folders,
                   const std::filesystem::path& data, const Catalogue& catalogue,
                   std::ostream& out) {
  if (!can_write_html()) {
    throw InputError("", "report", "this build of croon writes no reports (CROON_WITH_REPORT)");
  }
  refuse_repeats(folders);
  for (const std::filesystem::path& folder : folders) {
    const std::string bytes = report_of(folder, data_root(data), catalogue);
    const std::filesystem::path path = folder / kReport;
    write_whole_file(path, bytes);
    out << "The report is in " << printable(path.string()) << "\n";
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
    add_path(command, "DIR", folders_, "Folders of results of `croon run`.")->required();
    add_data(command, data_);
  }

  int run(const Console& console) override {
    return report_command(folders_, data_, console.catalogue, console.out);
  }

 private:
  std::vector<std::filesystem::path> folders_;
  std::filesystem::path data_;
};

}  // namespace

std::unique_ptr<Command> make_report_command() { return std::make_unique<ReportCommand>(); }

}  // namespace croon::experiments
