#include "experiments/report/comparison_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/report/csv_row.hpp"

namespace croon::experiments {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(double value) {
  return std::isfinite(value) ? Json(value) : Json(shortest_number(value));
}

Json json_of(const PairedTest& test) {
  return {{"p", test.p},
          {"p_holm", test.p_holm},
          {"p_by_scene", test.p_by_scene},
          {"p_by_scene_holm", test.p_by_scene_holm},
          {"is_significant", is_significant(test)},
          {"holds_by_scene", holds_by_scene(test)}};
}

Json json_of(const ErrorComparison& error) {
  return {{"base_median", json_of(error.base_median)},
          {"variant_median", json_of(error.variant_median)},
          {"difference", json_of(error.difference)},
          {"low", json_of(error.interval.low)},
          {"high", json_of(error.interval.high)},
          {"wilcoxon", json_of(error.test)}};
}

}  // namespace

Json comparison_json(const Comparison& comparison) {
  return {{"variant", comparison.variant},
          {"base", comparison.base},
          {"sensor", comparison.sensor.empty() ? Json() : Json(comparison.sensor)},
          {"pairs", comparison.pairs},
          {"scenes", comparison.scenes},
          {"only_base", comparison.only_base},
          {"only_variant", comparison.only_variant},
          {"rotation_deg", json_of(comparison.rotation_deg)},
          {"translation_m", json_of(comparison.translation_m)},
          {"mcnemar", json_of(comparison.success)}};
}

}  // namespace croon::experiments
