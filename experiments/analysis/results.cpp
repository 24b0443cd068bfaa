#include "experiments/analysis/results.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/store/bounded_json.hpp"
#include "experiments/store/manifest.hpp"
#include "experiments/store/store.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;

/// The names that are current.
std::vector<std::string> current(const std::vector<StoredName>& stored) {
  std::vector<std::string> names;
  for (const StoredName& name : stored) {
    if (name.is_current) names.push_back(name.name);
  }
  return names;
}

ReportOrder report_order(const StoreHeader& header) {
  ReportOrder order;
  order.without_truth = sensors_without_truth(header.manifest);
  order.variants = current(header.variants);
  order.sensors = current(header.sensors);
  order.scenes = current(header.scenes);
  for (const StoredName& sensor : header.sensors) {
    const auto is_target = [&](const StoredName& other) { return other.name == sensor.detail; };
    if (sensor.is_current && std::any_of(header.sensors.begin(), header.sensors.end(), is_target)) {
      order.pairs.push_back(named_pair(sensor.name, sensor.detail));
    }
  }
  for (const StoredName& scene : header.scenes) {
    if (!scene.detail.empty()) order.scene_kinds[scene.name] = scene.detail;
  }
  return order;
}

/// The number of requested trials. A variant without any trial was not requested: `--only` excluded
/// it.
std::size_t requested_trials(const std::string& manifest, const Summary& summary) {
  const std::size_t run = variants_of(summary).size();
  return run == 0 ? planned_trials(manifest) : planned_trials_of_variant(manifest) * run;
}

Results results_of(StoredRun run, const std::string& file) {
  const json manifest = parse_bounded(run.header.manifest);
  const Experiment experiment = read_experiment_json(manifest.at("experiment"), file);
  Results results;
  results.name = experiment.name;
  results.description = experiment.description;
  results.builds = run.header.builds;
  if (!results.builds.empty()) results.commit = results.builds.front().commit;
  results.seed = experiment.seed;
  results.trials = run.header.trials;
  results.manifest =
      manifest_with_builds(run.header.manifest, run.header.builds, run.header.versions);
  const ReportOrder order = report_order(run.header);
  results.scenes = order.scenes.size();
  results.scenes_per_trial = experiment.scenes_per_trial;
  for (const StoredName& sensor : run.header.sensors) {
    if (sensor.is_current) results.references[sensor.name] = sensor.detail;
  }
  results.records = std::move(run.records);
  results.steps = std::move(run.steps);
  results.diagnostics = summarise_diagnostics(results.records, results.steps);
  results.summary = summarise(results.records, experiment.success, order);
  results.planned = requested_trials(run.header.manifest, results.summary);
  const std::optional<Sweep>& sweep = experiment.starts.sweep;
  if (sweep) results.basin = basin_of(results.records, *sweep, order);
  results.acceptance = acceptance_of(results.records, results.summary);
  results.coverage = coverage_of(results.records, results.summary);
  results.claims = check_claims(experiment.claims, results.summary);
  results.quoted = experiment.quoted;
  return results;
}

}  // namespace

void check_reportable(const StoreHeader& header, const std::string& file) {
  reading(file, [&] {
    planned_trials_of_variant(header.manifest);
    return results_of({header, {}, {}}, file);
  });
}

bool has_failed_trials(const Results& results) {
  return std::any_of(results.records.begin(), results.records.end(),
                     [](const TrialRecord& record) { return record.status == Status::failed; });
}

Results read_results(const std::filesystem::path& folder, Content content) {
  const std::filesystem::path path = store_path(folder);
  StoredRun run = read_store(path, content);
  return reading(path, [&] { return results_of(std::move(run), path.string()); });
}

}  // namespace croon::experiments
