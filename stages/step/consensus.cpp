#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/geometry/pose_mean.hpp"
#include "framework/params/choice.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::step {
namespace {

enum class Weights { equal, covariance };

struct Params {
  Weights weights = Weights::equal;
  double rotation_deg = 0.5;
  double translation_m = 0.1;
  double min_agreeing_ratio = 0.6;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::choice("weights", &Params::weights,
                     {{"equal", Weights::equal}, {"covariance", Weights::covariance}},
                     "Whether all scenes that agree count alike, or each direction of each pose by "
                     "its covariance, which a step before has to estimate."),
      params::number("rotation_deg", &Params::rotation_deg, {0.0, 180.0},
                     "Poses of two scenes agree if the angle between them is at most this."),
      params::number("translation_m", &Params::translation_m, {0.0, 1e6},
                     "Poses of two scenes agree if their origins are at most this far apart."),
      params::number(
          "min_agreeing_ratio", &Params::min_agreeing_ratio, {0.0, 1.0},
          "The pose is rejected if the poses of fewer of the scenes agree with it; those in which "
          "a step failed do not."),
  };
  return table;
}

/// The estimates that vote: those that no step has rejected, or all if there are no others.
RigGroup voters(const RigGroup& estimates) {
  RigGroup accepted;
  for (RigEstimate* const one : estimates) {
    if (!one->estimate.rejection) accepted.push_back(one);
  }
  return accepted.empty() ? estimates : accepted;
}

class ConsensusStep final : public RigStep {
 public:
  explicit ConsensusStep(const Params& params)
      : params_(params), bounds_{rad_from_deg(params.rotation_deg), params.translation_m} {}

  static params::DataFlow data_flow(const Params& params) {
    if (params.weights != Weights::covariance) return {};
    params::DataFlow flow = takes(kCovariance);
    flow.add(gives(kCovariance));
    return flow;
  }

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    const auto sensor = [](const RigEstimate& one) { return RigKey{one.target, one.source}; };
    for (const RigGroup& estimates : rig_groups(rig, sensor)) agree_on_pose(estimates);
  }

 private:
  /// Gives all estimates of a sensor the pose that they agree on.
  void agree_on_pose(const RigGroup& estimates) const {
    const RigGroup votes = voters(estimates);
    RigidTransform pose = consensus_pose(poses_of(votes), bounds_);
    const RigGroup agreeing = near(votes, pose);
    const double ratio =
        static_cast<double>(agreeing.size()) / static_cast<double>(estimates.front()->scenes);
    const std::optional<Matrix6d> information = joint_information(agreeing);
    std::optional<PoseCovariance> covariance = joint_covariance(agreeing);
    if (params_.weights == Weights::covariance && !agreeing.empty()) {
      if (!covariance) {
        for (RigEstimate* const one : estimates) {
          one->failure = "weights \"covariance\" needs a step before that estimates one";
        }
        return;
      }
      const InformedPose mean = weighted_mean(agreeing);
      pose = mean.pose;
      covariance->matrix = guarded_inverse<6>(mean.information);
      // A scene that does not hold a direction has no weight in it, so its word does not count.
      for (const RigEstimate* const one : agreeing) {
        covariance->dofs = best_observability(covariance->dofs, one->estimate.covariance->dofs);
      }
    } else if (agreeing.size() > 1) {
      // consensus_pose is the mean of the poses near a medoid; those near that mean may be others.
      pose = mean_pose(poses_of(agreeing));
    }
    const std::optional<std::string> rejection = verdict(estimates, votes, agreeing.size(), ratio);
    for (RigEstimate* const one : estimates) {
      one->estimate.set_pose(pose);
      one->estimate.information = information;
      one->estimate.covariance = covariance;
      one->estimate.rejection = rejection;
      one->estimate.diagnostics = {{"scenes", static_cast<double>(estimates.front()->scenes)},
                                   {"agreeing_ratio", ratio}};
    }
  }

  static std::vector<RigidTransform> poses_of(const RigGroup& estimates) {
    std::vector<RigidTransform> poses;
    for (const RigEstimate* const one : estimates) poses.push_back(one->estimate.T_target_source);
    return poses;
  }

  /// The votes within the bounds of `pose`.
  RigGroup near(const RigGroup& votes, const RigidTransform& pose) const {
    RigGroup agreeing;
    for (RigEstimate* const vote : votes) {
      if (agree(vote->estimate.T_target_source, pose, bounds_)) agreeing.push_back(vote);
    }
    return agreeing;
  }

  /// The mean of the poses of these scenes, each of which has a covariance, weighed by it.
  static InformedPose weighted_mean(const RigGroup& agreeing) {
    std::vector<InformedPose> known;
    for (const RigEstimate* const one : agreeing) {
      known.push_back(informed(one->estimate.T_target_source, one->estimate.covariance->matrix));
    }
    return informed_mean(known);
  }

  /// Scenes are independent observations of one pose, so their information adds; std::nullopt if
  /// one of them has none.
  static std::optional<Matrix6d> joint_information(const RigGroup& agreeing) {
    if (agreeing.empty()) return std::nullopt;
    Matrix6d sum = Matrix6d::Zero();
    for (const RigEstimate* const one : agreeing) {
      if (!one->estimate.information) return std::nullopt;
      sum += *one->estimate.information;
    }
    return sum;
  }

  /// The pose is the mean of the poses of these scenes, whose errors are independent; std::nullopt
  /// if one of them has no covariance.
  static std::optional<PoseCovariance> joint_covariance(const RigGroup& agreeing) {
    std::vector<PoseCovariance> covariances;
    for (const RigEstimate* const one : agreeing) {
      if (!one->estimate.covariance) return std::nullopt;
      covariances.push_back(*one->estimate.covariance);
    }
    if (covariances.empty()) return std::nullopt;
    return covariance_of_mean(covariances);
  }

  /// Why the pose must not be trusted, if so.
  std::optional<std::string> verdict(const RigGroup& estimates, const RigGroup& votes,
                                     std::size_t agreeing, double ratio) const {
    if (votes.front()->estimate.rejection) return votes.front()->estimate.rejection;
    if (ratio >= params_.min_agreeing_ratio) return std::nullopt;
    return "the poses of " + std::to_string(agreeing) + " of " +
           counted(estimates.front()->scenes, "scene") + " agree, a share below " +
           fixed_number(params_.min_agreeing_ratio, 2);
  }

  Params params_;
  PoseBounds bounds_;
};

}  // namespace

StageEntry consensus() {
  return stage_entry<ConsensusStep>(
      "consensus",
      "Sees the whole rig: gives each sensor, in all scenes of a trial, the pose that most of its "
      "scenes agree on.",
      "the mean is that of Markley et al., Averaging Quaternions, JGCD 2007", table(), 3);
}

}  // namespace croon::stages::step
