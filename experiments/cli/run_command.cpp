#include "experiments/cli/run_command.hpp"

#include <tbb/info.h>

#include <algorithm>

#include "experiments/cli/before_after.hpp"
#include "experiments/cli/data_root.hpp"
#include "experiments/cli/fused_clouds.hpp"
#include "experiments/cli/output_folder.hpp"
#include "experiments/cli/timings_file.hpp"
#include "experiments/engine/experiment_loader.hpp"
#include "experiments/engine/manifest.hpp"
#include "experiments/engine/provenance.hpp"
#include "experiments/engine/runner.hpp"
#include "experiments/engine/starts.hpp"
#include "experiments/engine/store.hpp"
#include "experiments/report/box_plots.hpp"
#include "experiments/report/csv_files.hpp"
#include "experiments/report/progress.hpp"
#include "experiments/report/summary.hpp"
#include "experiments/report/table.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::experiments {
namespace {

/// A run of which everything was checked that can be before anything is written.
struct CheckedRun {
  Experiment experiment;
  Selection selection;
  std::filesystem::path data_root;
  std::vector<Scene> scenes;
  std::filesystem::path out;
  int jobs = 1;
};

/// Takes `trials` for those of the file; 0 keeps them.
void set_trials(Experiment& experiment, int trials) {
  if (trials > kMaxTrials) {
    throw InputError("", "--trials",
                     "expected a whole number from 1 to " + std::to_string(kMaxTrials) +
                         ", found " + std::to_string(trials));
  }
  if (trials > 0) experiment.starts.trials = trials;
}

CheckedRun check(const RunOptions& options, const Catalogue& catalogue) {
  CheckedRun run;
  run.experiment = load_experiment(options.experiment, catalogue);
  run.data_root = data_root(options.data);
  std::vector<Fault> faults;
  collect_faults(faults, [&] { set_trials(run.experiment, options.trials); });
  collect_faults(faults,
                 [&] { run.selection.variants = select_variants(run.experiment, options.only); });
  collect_faults(faults, [&] {
    if (!options.shard.empty()) run.selection.shard = read_shard(options.shard);
  });
  collect_faults(faults, [&] {
    run.scenes = run.experiment.dataset->scenes(run.data_root);
    check_centres(run.experiment, run.scenes);
  });
  if (!faults.empty()) throw InputError(std::move(faults));
  run.out = options.out;
  if (run.out.empty()) run.out = std::filesystem::path("results") / run.experiment.name;
  run.jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  return run;
}

/// The trials of `plan` that the store lacks.
std::vector<PlannedTrial> missing_trials(const CheckedRun& run,
                                         const std::vector<PlannedTrial>& plan,
                                         const Store& store) {
  const std::set<TrialKey> keys = store.keys();
  std::vector<PlannedTrial> missing;
  for (const PlannedTrial& planned : plan) {
    const TrialId id = trial_id(run.experiment, run.scenes, planned);
    if (keys.count(trial_key(id)) == 0) missing.push_back(planned);
  }
  return missing;
}

/// Runs what is missing and returns all the records of the store, in report order.
std::vector<TrialRecord> fill_store(const CheckedRun& run, const OutputFolder& folder, Store& store,
                                    Progress& progress, const std::vector<PlannedTrial>& plan) {
  const std::vector<PlannedTrial> missing = missing_trials(run, plan, store);
  progress.skip(plan.size() - missing.size());
  TimingsFile timings(folder.timings());
  RunListener listener;
  listener.on_scene = [&](const std::string& scene) { progress.set_scene(scene); };
  listener.on_trial = [&](const TrialRecord& record, const std::vector<TimingRow>& rows) {
    store.add(record);
    timings.add(rows);
    progress.advance();
  };
  listener.on_scene_timings = [&](const std::vector<TimingRow>& rows) { timings.add(rows); };
  run_trials(run.experiment, run.scenes, missing, run.jobs, listener);
  progress.finish();
  return in_report_order(store.records(), run.experiment, run.scenes);
}

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

ReportOrder report_order(const CheckedRun& run) {
  ReportOrder order;
  for (const Variant& variant : run.experiment.variants) order.variants.push_back(variant.name);
  for (const Scene& scene : run.scenes) {
    order.scenes.push_back(scene.name);
    if (!scene.kind.empty()) order.kinds[scene.name] = scene.kind;
    for (const SensorScan& scan : scene.sensors) add_once(order.sensors, scan.sensor);
  }
  return order;
}

/// Writes the file where it is wanted; else none stays from an earlier run.
void write_or_remove(const std::filesystem::path& path, const std::string& bytes, bool is_wanted) {
  std::error_code ignored;
  if (is_wanted) {
    write_whole_file(path, bytes);
  } else {
    std::filesystem::remove(path, ignored);
  }
}

void write_reports(const OutputFolder& folder, const std::vector<TrialRecord>& records,
                   const Summary& summary, const std::string& manifest) {
  write_whole_file(folder.file("trials.csv"), trials_csv(records));
  write_whole_file(folder.file("summary.csv"), summary_csv(summary));
  write_whole_file(folder.file("summary.json"), summary_json(summary));
  write_or_remove(folder.file("summary_by_kind.csv"), summary_by_kind_csv(summary),
                  !summary.kinds.empty());
  write_whole_file(folder.file("box_plots.svg"), box_plots_svg(summary));
  write_whole_file(folder.file("manifest.json"), manifest);
}

constexpr const char* kPicture = "before_after.png";

/// Draws the picture of `--png` and says what it shows.
std::string draw_picture(const CheckedRun& run, const std::vector<TrialRecord>& records,
                         const std::filesystem::path& path) {
  const std::string scene = draw_before_after(run.experiment, run.scenes, records, path);
  if (scene.empty()) return "There is no scene to draw: none has all its sensors.\n";
  return "Scene " + scene + " from above, before (left) and after (right), is in " + path.string() +
         "\n";
}

}  // namespace

int run_command(const RunOptions& options, const Catalogue& catalogue, std::ostream& out,
                std::ostream& progress_out) {
  const CheckedRun run = check(options, catalogue);
  const std::vector<InputFile> inputs = input_files(run.scenes, run.data_root, run.jobs);
  const Provenance provenance = provenance_of(run.experiment, run.scenes, inputs);
  const std::string manifest =
      manifest_json(run.experiment, inputs, provenance, run.data_root, run.jobs);
  const std::vector<PlannedTrial> plan = plan_trials(run.experiment, run.scenes, run.selection);
  const OutputFolder folder(run.out);
  if (options.fresh) folder.clear();
  std::vector<TrialRecord> records;
  {
    Store store(folder.store(), provenance);
    Progress progress(progress_out, progress_style_of_stderr(options.quiet), plan.size());
    records = fill_store(run, folder, store, progress, plan);
  }
  rewrite_in_order(folder.store());
  const Summary summary = summarise(records, run.experiment.success, report_order(run));
  write_reports(folder, records, summary, manifest);
  std::vector<std::string> complaints;
  if (options.clouds) {
    complaints = write_fused_clouds(run.experiment, run.scenes, records, folder.clouds());
  }
  for (const std::string& complaint : complaints) progress_out << "croon: " << complaint << "\n";
  TableStyle style;
  style.colours = options.colours;
  out << summary_table(summary, style) << "Results are in " << run.out.string() << "\n";
  if (options.png) out << draw_picture(run, records, folder.file(kPicture));
  const auto is_failed = [](const TrialRecord& r) { return r.status == Status::failed; };
  const bool all_done =
      complaints.empty() && std::none_of(records.begin(), records.end(), is_failed);
  return all_done ? 0 : 3;
}

}  // namespace croon::experiments
