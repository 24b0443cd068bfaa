#include <nlohmann/json.hpp>

#include "experiments/report/result_tables.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {
namespace {

using Json = nlohmann::ordered_json;

/// An element of "extrinsics", without its scenes.
struct Extrinsics {
  const SummaryRow* row;
  std::string reference_sensor;
};

Columns<Extrinsics> extrinsics_columns() {
  using E = Extrinsics;
  Columns<E> columns;
  return columns.add({"variant"}, [](const E& e) { return e.row->variant; })
      .add({"sensor"}, [](const E& e) { return e.row->sensor; })
      .add({"reference_sensor"}, [](const E& e) { return nothing_if_empty(e.reference_sensor); })
      .add(agreed_pose_columns(), [](const E& e) { return agreed_pose(*e.row); });
}

Columns<SceneSummary> scene_columns() {
  using S = SceneSummary;
  Columns<S> columns;
  return columns.add({"scene"}, &S::scene).add(agreed_pose_columns(), [](const S& scene) {
    return agreed_pose(scene);
  });
}

}  // namespace

std::string extrinsics_json(const Summary& summary,
                            const std::map<std::string, std::string>& references) {
  std::vector<Extrinsics> extrinsics;
  for (const SummaryRow& row : summary.rows) {
    const auto reference = references.find(row.sensor);
    extrinsics.push_back({&row, reference == references.end() ? "" : reference->second});
  }
  Json json;
  json["method"] =
      "per scene the medoid of the trials' poses, with distances cut off at the bounds, then the "
      "mean of the poses within the bounds of it; over scenes the same of the scenes' poses, each "
      "with as many votes as trials of its scene agree with it (docs/statistics.md)";
  json["bounds"] = {{"rotation_deg", summary.bounds.rotation_deg},
                    {"translation_m", summary.bounds.translation_m}};
  json["roll_pitch_yaw"] = "R = Rz(yaw) Ry(pitch) Rx(roll)";
  json["extrinsics"] = json_rows(extrinsics_columns().table(extrinsics));
  for (std::size_t i = 0; i < extrinsics.size(); ++i) {
    json["extrinsics"][i]["scenes"] = json_rows(scene_columns().table(extrinsics[i].row->scenes));
  }
  return json_bytes(json);
}

}  // namespace croon::experiments
