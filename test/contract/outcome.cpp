#include "test/contract/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"
#include "framework/stage/ground_extractor.hpp"
#include "framework/stage/hypotheses.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/volume_scorer.hpp"
#include "framework/stage/yaw_search.hpp"
#include "registry/registry.hpp"
#include "test/contract/every_stage.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon::test {
namespace {

using Numbers = std::vector<double>;

void add_points(Numbers& numbers, const Points& cloud) {
  for (const Eigen::Vector3f& point : cloud) {
    for (int i = 0; i < 3; ++i) numbers.push_back(point(i));
  }
}

/// The points and the channels.
void add_cloud(Numbers& numbers, const PointCloud& cloud) {
  numbers.push_back(static_cast<double>(cloud.size()));
  add_points(numbers, cloud.points);
  for (const Channel& channel : cloud.channels) {
    for (std::size_t i = 0; i < cloud.size(); ++i) numbers.push_back(channel.value(i));
  }
}

void add_pose(Numbers& numbers, const RigidTransform& pose) {
  for (int i = 0; i < 9; ++i) numbers.push_back(pose.rotation(i / 3, i % 3));
  for (int i = 0; i < 3; ++i) numbers.push_back(pose.translation(i));
}

void add_matrix(Numbers& numbers, const Matrix6d& matrix) {
  for (int i = 0; i < 36; ++i) numbers.push_back(matrix(i / 6, i % 6));
}

void add_plane(Numbers& numbers, const Plane& plane) {
  for (int i = 0; i < 3; ++i) numbers.push_back(plane.normal(i));
  numbers.push_back(plane.offset_m);
}

void add_ground(Numbers& numbers, const GroundSplit& ground) {
  add_plane(numbers, ground.plane);
  add_cloud(numbers, ground.non_ground->with_channels());
}

void add_covariance(Numbers& numbers, const PoseCovariance& covariance) {
  add_matrix(numbers, covariance.matrix);
  for (const Observability word : covariance.dofs) numbers.push_back(static_cast<double>(word));
}

/// Those that framework declares; an extra that is declared elsewhere is not compared.
void add_extras(Numbers& numbers, const Extras& extras) {
  if (const auto* const hypotheses = extras.find(kHypotheses)) {
    numbers.push_back(static_cast<double>(hypotheses->size()));
    for (const Hypothesis& hypothesis : *hypotheses) {
      add_pose(numbers, hypothesis.T_target_source);
      numbers.push_back(hypothesis.score);
    }
  }
  if (const Twist* const motion = extras.find(kMotion)) {
    const Vector6d velocity = vector_of(*motion);
    numbers.insert(numbers.end(), velocity.data(), velocity.data() + velocity.size());
  }
  if (const Matrix6d* const covariance = extras.find(kMotionCovariance)) {
    add_matrix(numbers, *covariance);
  }
}

void add_estimate(Numbers& numbers, const Estimate& estimate) {
  add_pose(numbers, estimate.T_target_source);
  for (const auto& [name, value] : estimate.diagnostics) numbers.push_back(value);
  // Which parts it has, so that none is taken for another.
  for (const bool has_part : {estimate.rejection.has_value(), estimate.information.has_value(),
                              estimate.covariance.has_value(), estimate.target_ground != nullptr,
                              estimate.source_ground != nullptr}) {
    numbers.push_back(has_part ? 1.0 : 0.0);
  }
  if (estimate.information) add_matrix(numbers, *estimate.information);
  if (estimate.covariance) add_covariance(numbers, *estimate.covariance);
  if (estimate.target_ground) add_ground(numbers, *estimate.target_ground);
  if (estimate.source_ground) add_ground(numbers, *estimate.source_ground);
  add_extras(numbers, estimate.extras);
  add_cloud(numbers, estimate.target->with_channels());
  add_cloud(numbers, estimate.source->with_channels());
}

RigidTransform start() {
  Rng rng = test_rng(77);
  return pose_near(rng, {}, 1.0, 0.05);
}

Numbers preprocessed(const std::string& stage_json, const CloudPair& clouds) {
  Numbers numbers;
  add_cloud(numbers, stage<Preprocessor>(stage_json)->apply(clouds.source->with_channels()));
  return numbers;
}

Numbers extracted(const std::string& stage_json, const CloudPair& clouds) {
  Rng rng = test_rng();
  const Ground ground = stage<GroundExtractor>(stage_json)->extract(clouds.source->points(), rng);
  Numbers numbers;
  add_plane(numbers, ground.plane);
  numbers.insert(numbers.end(), ground.is_ground.begin(), ground.is_ground.end());
  return numbers;
}

Numbers registered(const std::string& stage_json, const CloudPair& clouds) {
  const Registration result =
      stage<Icp>(stage_json)->align(*clouds.target, *clouds.source, start());
  Numbers numbers = {result.rmse_m, result.inlier_ratio,
                     static_cast<double>(result.correspondences),
                     static_cast<double>(result.iterations), result.converged ? 1.0 : 0.0};
  add_pose(numbers, result.T_target_source);
  add_matrix(numbers, result.information);
  return numbers;
}

Numbers scored(const std::string& stage_json, const CloudPair& clouds) {
  const VolumeFunction volume = stage<VolumeScorer>(stage_json)->bind(clouds.target, clouds.source);
  Rng rng = test_rng(78);
  Numbers numbers;
  for (int i = 0; i < 3; ++i) numbers.push_back(volume(pose_near(rng, {}, 45.0, 1.0)).m3);
  return numbers;
}

Numbers searched_yaw(const std::string& stage_json, const CloudPair&) {
  Numbers numbers;
  const auto search = stage<YawSearch>(stage_json);
  const std::vector<YawCost> costs = {[](double yaw_rad) { return -std::cos(yaw_rad - 0.2); },
                                      [](double) { return 1.0; }};
  for (const YawCost& cost : costs) {
    const YawMinimum minimum = search->minimise(cost);
    numbers.insert(numbers.end(),
                   {minimum.yaw_rad, minimum.cost, static_cast<double>(minimum.evaluations)});
  }
  return numbers;
}

Numbers searched_pose(const std::string& stage_json, const CloudPair&) {
  Numbers numbers;
  const auto search = stage<PoseSearch>(stage_json);
  const std::vector<PoseCost> costs = {[](const RigidTransform& pose) {
                                         return pose.translation.squaredNorm() +
                                                rotation_angle(pose.rotation);
                                       },
                                       [](const RigidTransform&) { return 1.0; }};
  for (const PoseCost& cost : costs) {
    const PoseMinimum minimum = search->minimise(cost, start());
    if (minimum.cost > cost(start())) throw std::logic_error("the search went uphill");
    numbers.insert(numbers.end(), {minimum.cost, static_cast<double>(minimum.evaluations)});
    add_pose(numbers, minimum.pose);
  }
  return numbers;
}

/// A step of the registry, with its defaults, for each extra that `step` takes.
Pipeline givers_of(const params::Slot<Step>& step) {
  Pipeline givers;
  for (const params::ExtraDoc& taken : step.flow().takes) {
    for (const StageEntry& entry : registry().entries()) {
      const auto is_it = [&](const params::ExtraDoc& given) { return given.name == taken.name; };
      const auto& gives = entry.flow.gives;
      if (entry.kind != Step::kKind || std::none_of(gives.begin(), gives.end(), is_it)) continue;
      givers.push_back({entry.name, stage<Step>(minimal_json(entry))});
      break;
    }
  }
  return givers;
}

NamedStep ground_step() { return {"ground", stage<Step>(R"({"step": "ground_alignment"})")}; }

/// The step `stage_json` after those that it needs.
Pipeline pipeline_of(const std::string& stage_json, bool has_ground) {
  const NamedStep tested{"tested", stage<Step>(stage_json)};
  Pipeline pipeline = givers_of(tested.step);
  if (has_ground) pipeline.insert(pipeline.begin(), ground_step());
  pipeline.push_back(tested);
  return pipeline;
}

Numbers advanced(const std::string& stage_json, const CloudPair& clouds) {
  const StreamKey key(5);
  const bool has_ground =
      run_pipeline({ground_step()}, clouds.target, clouds.source, start(), key).failure.empty();
  const PipelineResult result =
      run_pipeline(pipeline_of(stage_json, has_ground), clouds.target, clouds.source, start(), key);
  if (!result.failure.empty()) throw StageError(result.failure);
  Numbers numbers;
  add_estimate(numbers, result.estimate);
  return numbers;
}

/// The steps with the stage `stage_json` in a slot of the kind `kind`, each as JSON.
std::vector<std::string> steps_with(const std::string& kind, const std::string& stage_json) {
  std::vector<std::string> steps;
  for (const StageEntry& entry : every_stage_of(Step::kKind)) {
    for (const params::ParameterDoc& parameter : entry.parameters) {
      if (parameter.stage_kind != kind) continue;
      nlohmann::json step = nlohmann::json::parse(minimal_json(entry));
      const nlohmann::json held = nlohmann::json::parse(stage_json);
      const bool is_list = parameter.type == params::ParameterType::stages;
      step[parameter.key] = is_list ? nlohmann::json::array({held}) : held;
      steps.push_back(step.dump());
    }
  }
  return steps;
}

/// Runs a stage of a kind that has no run of its own, in each step that has a slot of the kind.
Numbers advanced_by_steps(const std::string& kind, const std::string& stage_json,
                          const CloudPair& clouds) {
  const std::vector<std::string> steps = steps_with(kind, stage_json);
  if (steps.empty()) {
    throw std::logic_error("no test runs stages of the kind \"" + kind +
                           "\": no step has a slot of it");
  }
  Numbers numbers;
  for (const std::string& step : steps) {
    const Numbers of_step = advanced(step, clouds);
    numbers.insert(numbers.end(), of_step.begin(), of_step.end());
  }
  return numbers;
}

using Run = std::function<Numbers(const std::string&, const CloudPair&)>;

const std::map<std::string, Run>& runs() {
  static const std::map<std::string, Run> runs = {{"preprocessor", preprocessed},
                                                  {"ground_extractor", extracted},
                                                  {"icp", registered},
                                                  {"volume_scorer", scored},
                                                  {"yaw_search", searched_yaw},
                                                  {"pose_search", searched_pose},
                                                  {"step", advanced}};
  return runs;
}

}  // namespace

std::string Outcome::bits() const {
  std::string text(numbers.size() * sizeof(double), '\0');
  if (!numbers.empty()) std::memcpy(text.data(), numbers.data(), text.size());
  return text + stage_error;
}

bool Outcome::is_finite() const {
  for (const double number : numbers) {
    if (!std::isfinite(number)) return false;
  }
  return true;
}

CloudPair cloud_pair(const Points& target, const Points& source) {
  const StreamKey key(3);
  return {std::make_shared<const Cloud>(measured(target), key.with("target")),
          std::make_shared<const Cloud>(measured(source), key.with("source"))};
}

Outcome outcome_of(const std::string& kind, const std::string& stage_json,
                   const CloudPair& clouds) {
  try {
    const auto run = runs().find(kind);
    if (run == runs().end()) return {advanced_by_steps(kind, stage_json, clouds), ""};
    return {run->second(stage_json, clouds), ""};
  } catch (const StageError& error) {
    return {{}, std::string("StageError: ") + error.what()};
  }
}

Outcome outcome_of_rig(const std::string& step_json, Rig rig) {
  run_pipeline(pipeline_of(step_json, true), rig, StreamKey(5));
  Outcome outcome;
  for (const RigMember& member : rig) {
    outcome.stage_error += member.result.failure;
    if (member.result.failure.empty()) add_estimate(outcome.numbers, member.result.estimate);
  }
  return outcome;
}

}  // namespace croon::test
