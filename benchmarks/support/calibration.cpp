#include "benchmarks/support/calibration.hpp"

#include <stdexcept>

#include "framework/base/angles.hpp"
#include "framework/base/statistics.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/pipeline/calibrate.hpp"
#include "framework/pipeline/rig.hpp"
#include "registry/registry.hpp"
#include "test/support/tree.hpp"

namespace croon::benchmarks {
namespace {

constexpr int kStarts = 8;

// As `success` in best.json.
constexpr double kMaxRotationDeg = 0.5;
constexpr double kMaxTranslationM = 0.1;

}  // namespace

std::vector<Method> methods() {
  return {{"paper", "experiments/paper/pipeline.json", 45.0},
          {"best", "experiments/best.json", 180.0}};
}

Calibration::Calibration(const Method& method, CloudPair pair)
    : pipeline_(load_pipeline(test::source_root() / method.file, registry())),
      pair_(std::move(pair)),
      starts_(poses_near(pair_, kStarts, method.rotation_deg, 0.1)) {
  forget();
}

void Calibration::forget() {
  target_ = fresh(pair_.target);
  source_ = fresh(pair_.source);
}

Answer Calibration::run(std::size_t trial) {
  Rig rig = {{"scene", "reference", "sensor", StreamKey(1),
              at_start(target_, source_, starts_[trial % starts_.size()])}};
  run_pipeline(pipeline_, rig, StreamKey(1));
  const PipelineResult& result = rig[0].result;
  if (!result.failure.empty()) throw std::runtime_error(result.failure);
  return {result.estimate.T_target_source, result.estimate.rejection.has_value()};
}

void AnswerErrors::add(const Answer& answer, const CloudPair& pair) {
  const PoseError error = pose_error(answer.T_target_source, pair.T_target_source);
  rotations_deg_.push_back(deg_from_rad(error.rotation_rad));
  translations_m_.push_back(error.translation_m);
  const bool is_right =
      rotations_deg_.back() <= kMaxRotationDeg && error.translation_m <= kMaxTranslationM;
  wrong_ += static_cast<int>(!is_right && !answer.is_rejected);
  rejected_ += static_cast<int>(answer.is_rejected);
}

void AnswerErrors::set_counters(benchmark::State& state) const {
  if (rotations_deg_.empty()) return;
  const auto count = static_cast<double>(rotations_deg_.size());
  state.counters["rotation_deg"] = median(rotations_deg_);
  state.counters["translation_m"] = median(translations_m_);
  state.counters["wrong_ratio"] = wrong_ / count;
  state.counters["rejected_ratio"] = rejected_ / count;
}

}  // namespace croon::benchmarks
