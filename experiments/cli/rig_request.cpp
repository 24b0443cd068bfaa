#include <nlohmann/json.hpp>

#include "experiments/cli/requested_calibration.hpp"
#include "framework/base/error.hpp"
#include "framework/io/recording_file.hpp"
#include "framework/params/json_file.hpp"
#include "framework/params/node.hpp"
#include "framework/params/table.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// The keys of a rig.json. Missing numbers are negative, except for the seed.
struct RigKeys : RigRequest {
  double time_gap_s = -1.0, std_deg = -1.0, std_m = -1.0;
  int scenes = -1;
  std::uint64_t seed_number = 1;
};

params::Table<RigRequest> request_table() {
  using R = RigRequest;
  return {
      params::required(
          params::texts("inputs", &R::inputs,
                        "A file, a folder or a topic per sensor, PATH or NAME=PATH; or one "
                        "recording.")),
      params::free_text("reference", &R::reference,
                        "The sensor that defines the frame; default the first."),
      params::free_text("nominal", &R::nominal, "A file of poses to compare with."),
      params::boolean("from_scratch", &R::from_scratch,
                      "Use the nominal poses for comparison only."),
      params::boolean("at_rest", &R::at_rest,
                      "The vehicle stood: times are not used, and no motion is looked for."),
      params::free_text("base", &R::base,
                        "The reference's pose in the vehicle frame: x,y,z,roll,pitch,yaw in m and "
                        "degrees, or a file of extrinsics."),
      params::free_text("pipeline", &R::pipeline, "best, paper, or a file."),
  };
}

const params::Table<RigKeys>& table() {
  using K = RigKeys;
  static const params::Table<K> table =
      params::Table<K>{
          params::optional(params::number("max_time_gap_s", &K::time_gap_s, {0.0, 3600.0},
                                          "Maximum time between the clouds of a scene.")),
          params::optional(params::number("nominal_std_deg", &K::std_deg, {1e-3, 60.0},
                                          "Standard deviation of the nominal rotations.")),
          params::optional(params::number("nominal_std_m", &K::std_m, {1e-3, 10.0},
                                          "Standard deviation of the nominal positions.")),
          params::optional(params::integer("max_scenes", &K::scenes, {1.0, 1000.0},
                                           "Maximum number of scenes, evenly spaced.")),
          params::integer("seed", &K::seed_number, "Seed of the random numbers."),
      }
          .inherit(request_table());
  return table;
}

/// Splits "left=left.pcd" into "left=" and "left.pcd". Without a name, the first is empty.
std::pair<std::string, std::string> name_and_path(const std::string& word) {
  const std::size_t sign = word.find('=');
  if (sign == std::string::npos || word.find('/') < sign) return {"", word};
  return {word.substr(0, sign + 1), word.substr(sign + 1)};
}

/// Replaces each path of the request by `move(path)`.
template <class Move>
void for_each_path(RigRequest& request, const Move& move) {
  bool is_bag = false;
  for (std::size_t i = 0; i < request.inputs.size(); ++i) {
    if (i > 0 && is_bag) break;  // The others are topics.
    const auto [name, path] = name_and_path(request.inputs[i]);
    const std::string moved = move(path);
    is_bag = is_recording(path) || is_recording(moved);
    request.inputs[i] = name + moved;
  }
  const auto move_file = [&](std::string& path) {
    if (!path.empty()) path = move(path);
  };
  move_file(request.nominal);
  if (request.base.find(',') == std::string::npos) move_file(request.base);
  const bool is_file = request.pipeline.find('/') != std::string::npos ||
                       fs::path(request.pipeline).extension() == ".json";
  if (is_file) move_file(request.pipeline);
}

void refuse_experiment(const nlohmann::json& json, const std::string& file) {
  if (!json.is_object() || (!json.contains("dataset") && !json.contains("pipeline"))) return;
  throw InputError(file, "",
                   "expected a calibration with the key \"inputs\", found an experiment; run it "
                   "with croon run");
}

}  // namespace

RigRequest read_rig_request(const fs::path& file) {
  std::vector<Fault> faults;
  const nlohmann::json json = params::read_json_file(file, faults);
  refuse_experiment(json, file.string());
  const params::Node node(json, file.string(), faults);
  RigKeys keys;
  if (node.is_object()) keys = table().read(node, {}, params::NoStages());
  if (!faults.empty()) throw InputError(std::move(faults));
  if (keys.time_gap_s >= 0.0) keys.max_time_gap_s = keys.time_gap_s;
  if (keys.std_deg >= 0.0) keys.nominal_std_deg = keys.std_deg;
  if (keys.std_m >= 0.0) keys.nominal_std_m = keys.std_m;
  if (keys.scenes >= 0) keys.max_scenes = keys.scenes;
  keys.seed = keys.seed_number;
  RigRequest request = keys;
  const fs::path folder = file.parent_path();
  for_each_path(request, [&](const std::string& path) { return (folder / path).string(); });
  return request;
}

std::string rig_request_json(const RigRequest& request, const fs::path& folder) {
  RigRequest moved = request;
  const fs::path from = fs::weakly_canonical(fs::absolute(folder));
  for_each_path(moved, [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path)).lexically_relative(from).string();
  });
  nlohmann::ordered_json json;
  json["inputs"] = moved.inputs;
  const auto add = [&](const char* key, const std::string& text) {
    if (!text.empty()) json[key] = text;
  };
  add("reference", moved.reference);
  add("nominal", moved.nominal);
  if (moved.from_scratch) json["from_scratch"] = true;
  if (moved.at_rest) json["at_rest"] = true;
  if (moved.nominal_std_deg) json["nominal_std_deg"] = *moved.nominal_std_deg;
  if (moved.nominal_std_m) json["nominal_std_m"] = *moved.nominal_std_m;
  add("base", moved.base);
  if (moved.max_time_gap_s) json["max_time_gap_s"] = *moved.max_time_gap_s;
  if (moved.max_scenes) json["max_scenes"] = *moved.max_scenes;
  add("pipeline", moved.pipeline);
  if (moved.seed) json["seed"] = *moved.seed;
  return json.dump(2) + "\n";
}

}  // namespace croon::experiments
