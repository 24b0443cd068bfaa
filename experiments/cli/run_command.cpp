#include "experiments/cli/commands.hpp"

#include <memory>

#include "experiments/cli/command.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/report/result_clouds.hpp"
#include "experiments/report/result_sections.hpp"
#include "experiments/run/pipeline_tree.hpp"
#include "experiments/session/run_in_folder.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/document/renderers.hpp"

namespace croon::experiments {
namespace {

std::string text_of_plan(const CheckedRun& run, const Work& work, const RunOptions& options) {
  PlanCounts counts{work.plan.starts.size(), work.plan.trials, work.done,
                    count_steps(run.experiment, work.plan)};
  if (options.no_share) {
    for (StepCount& count : counts.steps) count.runs = count.alone;
  }
  return text_section(plan_section(counts), options.colours);
}

/// Writes the clouds of `--clouds` and adds failures to `complaints`. Returns a sentence if there
/// is nothing to write, else nothing.
std::string write_clouds(const CheckedRun& run, const Summary& summary,
                         const std::filesystem::path& folder,
                         std::vector<std::string>& complaints) {
  const FusedClouds fused = write_fused_clouds(run.experiment, run.groups, summary, folder);
  complaints.insert(complaints.end(), fused.complaints.begin(), fused.complaints.end());
  if (fused.is_any || !fused.complaints.empty()) return "";
  return "No clouds to write: no sensor has trials that agree.\n";
}

/// Draws the picture of `--png`. Returns a sentence that describes it.
std::string draw_picture(const CheckedRun& run, const Summary& summary,
                         const std::filesystem::path& path) {
  const std::string scene = draw_before_after(run.experiment, run.groups, summary, path);
  if (scene.empty()) return "No scene to draw: no scene has a pose for every sensor.\n";
  return "Scene " + scene + " from above, before (left) and after (right), is in " +
         printable(path.string()) + "\n";
}

}  // namespace

int run_command(const RunOptions& options, const Catalogue& catalogue, std::ostream& out,
                std::ostream& progress_out) {
  CheckedRun run = check_run(options, catalogue);
  print_notes(run.experiment.notes, progress_out);
  StoreHeader header = header_of(run);
  const FolderRun how{options.no_share, options.fresh, options.same_build,
                      progress_style_of_stderr(options.quiet)};
  if (options.plan) {
    out << text_of_plan(run, work_of(run, std::move(header), how), options);
    return 0;
  }
  const OutputFolder folder(run.out);
  auto [results, complaints] = run_in_folder(run, std::move(header), folder, how, progress_out);
  std::string clouds, picture;
  if (options.clouds) {
    clouds = write_clouds(run, results.summary, folder.file(kClouds), complaints);
  }
  try {
    if (options.png) picture = draw_picture(run, results.summary, folder.file(kPicture));
  } catch (const UnavailableFile& error) {
    complaints.push_back(error.faults().front().line() + "; the picture is not drawn");
  }
  for (const std::string& complaint : complaints)
    progress_out << "croon: " << printable(complaint) << "\n";
  out << result_text(results, options.colours) << "Results are in " << printable(run.out.string())
      << "\n"
      << clouds << picture;
  return complaints.empty() && !has_failed_trials(results) ? 0 : 3;
}

namespace {

class RunCommand final : public Command {
 public:
  std::string sentence() const override { return "Run an experiment; finished trials are kept."; }

  void add_options(CLI::App& command) override {
    add_experiment(command, options_.experiment, options_.with);
    add_path(command, "--out", options_.out, "Folder to write to; default results/<name>.");
    add_data(command, options_.data);
    add_jobs(command, options_.jobs);
    add_trials(command, options_.trials, "Trials per variant, scene and sensor.");
    add_text(command, "--only", options_.only, "Run only these variants.", "a variant");
    add_text(command, "--shard", options_.shard, "Run only part K of N of the trials, K/N.",
             "K/N with 1 <= K <= N");
    command.add_flag("--plan", options_.plan,
                     "Only show the trials to run and the steps that variants share.");
    command.add_flag("--no-share", options_.no_share,
                     "Run the variants one by one; the results are the same.");
    command.add_flag("--fresh", options_.fresh, "Delete the results in the folder and start over.");
    command.add_flag("--same-build", options_.same_build,
                     "Refuse to continue trials of another build of croon.");
    command.add_flag("--quiet", options_.quiet, "Do not show progress.");
    command.add_flag("--clouds", options_.clouds,
                     "Write the rig's clouds, fused with the poses that trials agree on.");
    command.add_flag("--png", options_.png,
                     "Draw the first scene from above, before and after calibration.");
  }

  int run(const Console& console) override {
    options_.colours = console.colours;
    return run_command(options_, console.catalogue, console.out, console.err);
  }

 private:
  RunOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_run_command() { return std::make_unique<RunCommand>(); }

}  // namespace croon::experiments
