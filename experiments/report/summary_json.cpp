#include <nlohmann/json.hpp>

#include "experiments/report/claims.hpp"
#include "experiments/report/comparison_json.hpp"
#include "experiments/report/statistic_names.hpp"
#include "experiments/report/summary.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/geometry/rigid_transform.hpp"

namespace croon::experiments {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Share& share) {
  return {{"count", share.count},
          {"ratio", share.ratio},
          {"low_ratio", share.interval.low},
          {"high_ratio", share.interval.high}};
}

Json json_of(const std::optional<RigidTransform>& pose) {
  if (!pose) return nullptr;
  const Eigen::Vector3d& t = pose->translation;
  const Eigen::Quaterniond q = unit_quaternion(pose->rotation);
  return {{"translation_m", {t.x(), t.y(), t.z()}},
          {"rotation_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

Json json_of(const std::optional<StatisticsTable>& table) {
  if (!table) return nullptr;
  Json json;
  for (std::size_t k = 0; k < kMeasures.size(); ++k) {
    Json& entry = json[std::string(kMeasures[k].name) + "_" + kMeasures[k].unit];
    for (const Statistic& statistic : kStatistics) {
      entry[statistic.name] = (*table)[k].*statistic.value;
    }
  }
  return json;
}

Json json_of(const std::optional<std::array<double, kDofs>>& spread) {
  if (!spread) return nullptr;
  Json json;
  for (std::size_t k = 0; k < kDofs; ++k) {
    json[std::string(kMeasures[k].name) + "_" + kMeasures[k].unit] = (*spread)[k];
  }
  return json;
}

/// What a row and a scene have in common.
template <typename RowOrScene>
void add_common(Json& json, const RowOrScene& from) {
  json["trials"] = from.outcomes.trials;
  json["success"] = json_of(from.success);
  json["inaccurate"] = from.outcomes.inaccurate;
  json["rejected"] = from.outcomes.rejected;
  json["failed"] = from.outcomes.failed;
  json["agreement"] = json_of(from.agreement);
  json["consensus"] = json_of(from.consensus);
  json["counted"] = from.counted;
  json["statistics"] = json_of(from.statistics);
}

Json json_of(const SummaryRow& row) {
  Json json = {{"variant", row.variant},
               {"sensor", row.sensor},
               {"reference", reference_name(row.reference)}};
  add_common(json, row);
  json["within_scene_std"] = json_of(row.within_scene_std);
  json["across_scenes_std"] = json_of(row.across_scenes_std);
  if (row.scenes.size() > kMaxJsonScenes) {
    json["scenes"] = nullptr;
    return json;
  }
  json["scenes"] = Json::array();
  for (const SceneSummary& scene : row.scenes) {
    Json entry = {{"scene", scene.scene}};
    add_common(entry, scene);
    json["scenes"].push_back(std::move(entry));
  }
  return json;
}

Json json_of(const KindSummary& kind) {
  return {{"variant", kind.variant},
          {"kind", kind.kind},
          {"sensor", kind.sensor.empty() ? Json() : Json(kind.sensor)},
          {"reference", reference_name(kind.reference)},
          {"scenes", kind.scenes},
          {"trials", kind.outcomes.trials},
          {"success", json_of(kind.success)},
          {"inaccurate", kind.outcomes.inaccurate},
          {"rejected", kind.outcomes.rejected},
          {"failed", kind.outcomes.failed},
          {"agreement", json_of(kind.agreement)},
          {"counted", kind.counted},
          {"statistics", json_of(kind.statistics)}};
}

Json json_of(const LoopClosure& loop) {
  return {{"variant", loop.variant},     {"pair", loop.pair.name},
          {"source", loop.pair.source},  {"target", loop.pair.target},
          {"loops", loop.closed.trials}, {"closed", json_of(loop.closed)},
          {"counted", loop.counted},     {"statistics", json_of(loop.statistics)}};
}

Json json_of(const ClaimResult& claim) {
  const Claim& expected = claim.claim;
  const auto word = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  return {{"claim", expected.claim},
          {"source", expected.source},
          {"variant", expected.variant},
          {"sensor", word(expected.sensor)},
          {"measure", word(expected.measure)},
          {"statistic", expected.statistic},
          {"unit", unit_of(expected)},
          {"expected", expected.value},
          {"band", expected.band},
          {"found", claim.found ? Json(*claim.found) : Json()},
          {"verdict", verdict_name(claim.verdict)}};
}

}  // namespace

std::string summary_json(const Summary& summary, const std::vector<ClaimResult>& claims) {
  Json json;
  json["success_bounds"] = {{"rotation_deg", summary.bounds.rotation_deg},
                            {"translation_m", summary.bounds.translation_m}};
  json["rows"] = Json::array();
  for (const SummaryRow& row : summary.rows) json["rows"].push_back(json_of(row));
  json["reasons"] = Json::array();
  for (const ReasonCount& reason : summary.reasons) {
    json["reasons"].push_back({{"variant", reason.variant},
                               {"status", status_name(reason.status)},
                               {"reason", reason.reason},
                               {"count", reason.count}});
  }
  for (const Comparison& comparison : summary.comparisons) {
    json["comparisons"].push_back(comparison_json(comparison));
  }
  for (const KindSummary& kind : summary.kinds) json["kinds"].push_back(json_of(kind));
  for (const LoopClosure& loop : summary.loops) json["loops"].push_back(json_of(loop));
  for (const ClaimResult& claim : claims) json["claims"].push_back(json_of(claim));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace croon::experiments
