#include "experiments/cli/commands.hpp"

#include <map>

#include "experiments/analysis/results.hpp"
#include "experiments/report/result_clouds.hpp"
#include "experiments/report/result_files.hpp"
#include "experiments/report/run_text.hpp"
#include "experiments/run/pipeline_tree.hpp"
#include "experiments/run/runner.hpp"
#include "experiments/store/manifest.hpp"
#include "experiments/store/store_writer.hpp"
#include "framework/base/progress.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

/// What the store of a run says of itself. The clouds of the run are held to their digests.
StoreHeader header_of(CheckedRun& run) {
  const std::vector<InputFile> inputs = record_inputs(run.scenes, run.data_root, run.jobs);
  const Provenance provenance = provenance_of(run.experiment, run.scenes, inputs);
  return header_of(run.experiment, run.scenes, provenance,
                   manifest_json(run.experiment, run.scenes, inputs, provenance));
}

/// What a run has before it.
struct Work {
  StoreHeader stored;    ///< Of the store as it is; without provenance if there is none.
  StoreHeader header;    ///< Of the store as it will be.
  Plan plan;             ///< What is missing.
  std::size_t done = 0;  ///< Trials that were asked for and are there.
};

Work work_of(const CheckedRun& run, StoreHeader header, const RunOptions& options) {
  const std::filesystem::path path = store_path(run.out);
  StoreHeader stored = options.fresh ? StoreHeader() : stored_header(path);
  if (options.same_build) refuse_other_builds(path.string(), stored, header, kFreshRemedy);
  const std::vector<TrialIndex> done =
      options.fresh ? std::vector<TrialIndex>() : stored_trials(path, stored, header);
  Work work{{}, {}, plan_trials(run.experiment, run.scenes, run.selection, done)};
  // A build that adds no trial has no part in the results.
  if (work.plan.trials == 0 && !stored.builds.empty()) header.builds.clear();
  work.header = continued(stored, std::move(header));
  work.stored = std::move(stored);
  if (done.empty()) return work;
  const Plan all = plan_trials(run.experiment, run.scenes, run.selection);
  work.done = all.trials - work.plan.trials;
  return work;
}

std::string text_of_plan(const CheckedRun& run, const Work& work, const RunOptions& options) {
  PlanCounts counts{work.plan.starts.size(), work.plan.trials, work.done,
                    count_steps(run.experiment, work.plan)};
  if (options.no_share) {
    for (StepCount& count : counts.steps) count.runs = count.alone;
  }
  return plan_text(counts, options.colours);
}

/// The plan for each of the variants alone, one after the other.
std::vector<Plan> one_by_one(const Plan& plan) {
  std::map<std::size_t, Plan> plans;
  for (const PlannedStart& start : plan.starts) {
    for (const std::size_t variant : plan.variants[start.variants]) {
      Plan& alone = plans[variant];
      alone.variants = {{variant}};
      alone.starts.push_back({start.scene, start.sensor, start.trial, 0});
      ++alone.trials;
    }
  }
  std::vector<Plan> list;
  for (auto& [variant, alone] : plans) list.push_back(std::move(alone));
  return list;
}

/// Runs what is missing into the store. Returns a line for each cloud that was not available.
std::vector<std::string> fill_store(const CheckedRun& run, const OutputFolder& folder,
                                    const Work& work, const std::vector<Plan>& plans,
                                    Progress& progress) {
  progress.skip(work.done);
  Store store(folder.store(), work.header);
  TimingsFile timings(folder.file(kTimings));
  StoreWriter writer(store, [&](const std::vector<Done>& batch) {
    for (const Done& done : batch) {
      timings.add(done.timings);
      if (done.record) progress.advance();
    }
    timings.flush();
  });
  std::vector<std::string> complaints;
  RunListener listener;
  listener.on_unavailable = [&](const Fault& fault) {
    complaints.push_back(fault.line() + "; its trials are not stored, the next run runs them");
  };
  listener.on_scene = [&](const std::string& scene) { progress.set_scene(scene); };
  listener.on_trial = [&](const TrialRecord& record, const std::vector<TimingRow>& rows) {
    writer.add({record, rows});
  };
  listener.on_scene_timings = [&](const std::vector<TimingRow>& rows) {
    writer.add({std::nullopt, rows});
  };
  for (const Plan& plan : plans) {
    run_trials(run.experiment, run.scenes, plan, run.jobs, listener);
  }
  writer.finish();
  progress.finish();
  return complaints;
}

/// Runs what is missing and reads all that the store then has. Adds to `complaints` a line for each
/// cloud that was not available.
Results run_missing(const CheckedRun& run, const OutputFolder& folder, const Work& work,
                    const RunOptions& options, std::ostream& progress_out,
                    std::vector<std::string>& complaints) {
  const bool is_complete = work.plan.trials == 0 && is_same(work.stored, work.header);
  if (!is_complete) {
    Progress progress(progress_out, progress_style_of_stderr(options.quiet),
                      work.plan.trials + work.done);
    complaints =
        fill_store(run, folder, work,
                   options.no_share ? one_by_one(work.plan) : std::vector{work.plan}, progress);
  }
  rewrite_in_order(folder.store());
  return read_results(run.out, Content::trials_and_steps);
}

/// Draws the picture of `--png` and says what it shows.
std::string draw_picture(const CheckedRun& run, const Summary& summary,
                         const std::filesystem::path& path) {
  const std::string scene = draw_before_after(run.experiment, run.scenes, summary, path);
  if (scene.empty()) return "There is no scene to draw: none has all its sensors.\n";
  return "Scene " + scene + " from above, before (left) and after (right), is in " +
         printable(path.string()) + "\n";
}

}  // namespace

int run_command(const RunOptions& options, const Catalogue& catalogue, std::ostream& out,
                std::ostream& progress_out) {
  CheckedRun run = check_run(options, catalogue);
  StoreHeader header = header_of(run);
  if (options.plan) {
    out << text_of_plan(run, work_of(run, std::move(header), options), options);
    return 0;
  }
  const OutputFolder folder(run.out);
  if (options.fresh) folder.clear();
  const Work work = work_of(run, std::move(header), options);
  std::vector<std::string> complaints;
  const Results results = run_missing(run, folder, work, options, progress_out, complaints);
  folder.write_reports(results, manifest_with_host(results.manifest, run.data_root, run.jobs));
  if (options.clouds) {
    for (const std::string& complaint :
         write_fused_clouds(run.experiment, run.scenes, results.summary, folder.file(kClouds))) {
      complaints.push_back(complaint);
    }
  }
  for (const std::string& complaint : complaints)
    progress_out << "croon: " << printable(complaint) << "\n";
  out << result_text(results, options.colours) << "Results are in " << printable(run.out.string())
      << "\n";
  if (options.png) out << draw_picture(run, results.summary, folder.file(kPicture));
  return complaints.empty() && !has_failed_trials(results) ? 0 : 3;
}

}  // namespace croon::experiments
