#include "experiments/cli/results_folder.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/cli/output_folder.hpp"
#include "experiments/report/claims.hpp"
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
    if (!scene.detail.empty()) order.kinds[scene.name] = scene.detail;
  }
  return order;
}

/// The trials that were asked for. A variant that has none at all was not: `--only` left it out.
std::size_t asked_trials(const json& manifest, const Summary& summary) {
  const std::size_t run = variants_of(summary).size();
  const std::size_t planned = manifest.at("planned");
  const std::size_t variants = manifest.at("experiment").at("variants").size();
  return run == 0 ? planned : planned / variants * run;
}

/// What the stored run says.
Results results_of(StoredRun run, const std::string& file) {
  const json manifest = json::parse(run.header.manifest);
  const json& experiment = manifest.at("experiment");
  Results results;
  results.name = experiment.at("name");
  results.description = experiment.at("description");
  results.commit = manifest.at("croon").at("commit");
  results.seed = experiment.at("seed");
  results.trials = experiment.at("starts").at("trials");
  results.manifest = run.header.manifest;
  const SuccessBounds bounds{experiment.at("success").at("rotation_deg"),
                             experiment.at("success").at("translation_m")};
  const ReportOrder order = report_order(run.header);
  results.scenes = order.scenes.size();
  results.records = std::move(run.records);
  results.summary = summarise(results.records, bounds, order);
  results.planned = asked_trials(manifest, results.summary);
  const std::optional<Sweep> sweep = sweep_of_json(experiment.at("starts"));
  if (sweep) results.basin = basin_of(results.records, *sweep, order);
  const json keys = {{"expect", experiment.at("expect")}, {"quoted", experiment.at("quoted")}};
  Claims claims = claims_of(keys.dump(), file);
  results.claims = check_claims(claims.expect, results.summary);
  results.quoted = std::move(claims.quoted);
  return results;
}

}  // namespace

Results read_results(const std::filesystem::path& folder) {
  const std::filesystem::path path = store_path(folder);
  StoredRun run = read_store(path);
  return reading(path, [&] { return results_of(std::move(run), path.string()); });
}

}  // namespace croon::experiments
