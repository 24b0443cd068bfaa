#include "experiments/session/run_in_folder.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "experiments/run/loaded_scene.hpp"
#include "experiments/run/runner.hpp"
#include "experiments/store/build.hpp"
#include "experiments/store/manifest.hpp"
#include "experiments/store/store_writer.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"

namespace croon::experiments {
namespace {

/// Splits the plan into one plan per variant, to be run one after the other.
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

/// Whether `scene` has a cloud whose file is damaged or empty.
bool has_damage(const CheckedRun& run, const Scene& scene) {
  const auto is_damaged = [&](const SensorScan& scan) {
    return run.damaged_files.count(scan.file) > 0;
  };
  return is_damaged(scene.reference) ||
         std::any_of(scene.sensors.begin(), scene.sensors.end(), is_damaged);
}

/// The damage of clouds in the requested groups. The trials of a group use its undamaged scenes and
/// do not record the damage, so every run has to report it.
std::set<std::string> damage_in_groups(const CheckedRun& run) {
  std::set<std::size_t> requested;
  for (const PlannedStart& start : plan_trials(run.experiment, run.groups, run.selection).starts) {
    if (run.groups[start.scene].scenes.size() > 1) requested.insert(start.scene);
  }
  std::set<std::string> damage;
  for (const std::size_t group : requested) {
    for (const Scene& scene : run.groups[group].scenes) {
      if (!has_damage(run, scene)) continue;
      std::set<std::string> sensors;
      for (const SensorScan& scan : scene.sensors) sensors.insert(scan.sensor);
      const std::vector<std::string> reasons =
          damaged_clouds(load_scene(scene, sensors, run.experiment.seed, {}));
      damage.insert(reasons.begin(), reasons.end());
    }
  }
  return damage;
}

/// Runs the missing trials and stores them. Returns a line for each unavailable cloud, and adds to
/// `damage` the damaged clouds of groups.
std::vector<std::string> fill_store(const CheckedRun& run, const OutputFolder& folder,
                                    TimingsStore& timings, const Work& work, const FolderRun& how,
                                    Progress& progress, std::set<std::string>& damage) {
  progress.skip(work.done);
  Store store(folder.store(), work.header);
  StoreWriter writer(store, [&](const std::vector<Done>& batch) {
    timings.add(batch);
    for (const Done& done : batch) {
      if (done.record) progress.advance();
    }
  });
  std::vector<std::string> complaints;
  RunListener listener;
  listener.on_unavailable = [&](const Fault& fault) {
    complaints.push_back(fault.line() + "; its trials are not stored, the next run repeats them");
  };
  listener.on_damaged = [&](const std::string& reason) { damage.insert(reason); };
  listener.on_scene = [&](const std::string& scene) {
    progress.set_scene(scene);
    how.check();
  };
  listener.on_trial = [&](const TrialRecord& record, const std::vector<TimingRow>& rows) {
    writer.add({record, rows});
    how.check();
  };
  listener.on_scene_timings = [&](const std::vector<TimingRow>& rows) {
    writer.add({std::nullopt, rows});
  };
  const std::vector<Plan> plans = how.no_share ? one_by_one(work.plan) : std::vector{work.plan};
  for (const Plan& plan : plans) {
    run_trials(run.experiment, run.groups, plan, run.jobs, listener);
  }
  writer.finish();
  progress.finish();
  return complaints;
}

/// Whether a trial of the plan already has a wall time. Wall times are written after the trial is
/// stored, so the store has lost it.
bool has_lost_trials(const CheckedRun& run, const Plan& plan, TimingsStore& timings) {
  return std::any_of(plan.starts.begin(), plan.starts.end(), [&](const PlannedStart& start) {
    const SceneGroup& group = run.groups[start.scene];
    const std::vector<std::size_t>& variants = plan.variants[start.variants];
    return std::any_of(variants.begin(), variants.end(), [&](std::size_t variant) {
      return timings.has({run.experiment.variants[variant].name, group.name,
                          group.pairs[start.sensor].name, start.trial});
    });
  });
}

}  // namespace

StoreHeader header_of(CheckedRun& run) {
  begin_this_build();
  const std::vector<InputFile> inputs = record_inputs(run.groups, run.data_root, run.jobs);
  for (const InputFile& input : inputs) {
    if (input.points.value_or(0) == 0) run.damaged_files.insert(input.file);
  }
  const Provenance provenance = provenance_of(run.experiment, run.groups, inputs);
  return header_of(run.experiment, run.groups, provenance,
                   manifest_json(run.experiment, run.groups, inputs, provenance));
}

Work work_of(const CheckedRun& run, StoreHeader header, const FolderRun& how) {
  const std::filesystem::path path = store_path(run.out);
  StoreHeader stored = how.fresh ? StoreHeader() : stored_header(path);
  if (how.same_build) refuse_other_builds(path.string(), stored, header, kFreshRemedy);
  const std::vector<TrialIndex> done =
      how.fresh ? std::vector<TrialIndex>() : stored_trials(path, stored, header);
  Work work{{}, {}, plan_trials(run.experiment, run.groups, run.selection, done)};
  // A build that adds no trial does not contribute to the results.
  if (work.plan.trials == 0 && !stored.builds.empty()) header.builds.clear();
  work.header = continued(stored, std::move(header));
  work.stored = std::move(stored);
  if (done.empty()) return work;
  const Plan all = plan_trials(run.experiment, run.groups, run.selection);
  work.done = all.trials - work.plan.trials;
  return work;
}

FolderResults run_in_folder(const CheckedRun& run, StoreHeader header, const OutputFolder& folder,
                            const FolderRun& how, std::ostream& progress_out) {
  if (how.fresh) folder.clear();
  const Work work = work_of(run, std::move(header), how);
  FolderResults end;
  std::set<std::string> damage;
  const bool is_changed = work.plan.trials > 0 || !is_same(work.stored, work.header);
  const std::string left_out = left_out_times_text(run.out);
  if (!left_out.empty()) progress_out << "croon: " << left_out;
  TimingsStore timings(folder.timings(), is_changed ? Access::write : Access::read);
  if (has_lost_trials(run, work.plan, timings)) {
    progress_out << "croon: " << printable(folder.store().string())
                 << ": stored trials are missing: the store is lost, or its log "
                 << printable(folder.store().filename().string())
                 << "-wal, which an interrupted run leaves beside it; the trials run again\n";
  }
  if (is_changed) {
    Progress progress(progress_out, how.progress, work.plan.trials + work.done);
    end.complaints = fill_store(run, folder, timings, work, how, progress, damage);
  }
  // The trials of this run have already reported their damaged clouds, including simulated ones.
  on_threads(run.jobs, [&] { damage.merge(damage_in_groups(run)); });
  for (const std::string& reason : damage) {
    end.complaints.push_back(reason + "; its trials use the other scenes of the group");
  }
  rewrite_in_order(folder.store());
  end.results = read_results(run.out, Content::trials_and_steps);
  folder.write_reports(end.results, timings,
                       manifest_with_host(end.results.manifest, run.data_root, run.jobs));
  return end;
}

}  // namespace croon::experiments
