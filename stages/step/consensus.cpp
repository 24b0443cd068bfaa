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
  double max_rotation_deg = 0.5;
  double max_translation_m = 0.1;
  double min_agreeing_ratio = 0.6;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::choice("weights", &Params::weights,
                     {{"equal", Weights::equal}, {"covariance", Weights::covariance}},
                     "Whether all agreeing scenes have the same weight, or each pose is weighted "
                     "by its covariance, which an earlier step must estimate."),
      params::number("max_rotation_deg", &Params::max_rotation_deg, {0.0, 180.0},
                     "Poses of two scenes agree if the angle between them is at most this.")
          .formerly("rotation_deg"),
      params::number("max_translation_m", &Params::max_translation_m, {0.0, 1e6},
                     "Poses of two scenes agree if their origins are at most this far apart.")
          .formerly("translation_m"),
      params::number("min_agreeing_ratio", &Params::min_agreeing_ratio, {0.0, 1.0},
                     "Minimum share of scenes whose poses agree; below it the pose is rejected. "
                     "Scenes in which a step failed count as disagreeing."),
  };
  return table;
}

/// The estimates that vote: those that no step has rejected, or all of them if every one was
/// rejected.
RigGroup voters(const RigGroup& estimates) {
  RigGroup accepted;
  for (RigEstimate* const member : estimates) {
    if (!member->estimate.rejection) accepted.push_back(member);
  }
  return accepted.empty() ? estimates : accepted;
}

class ConsensusStep final : public RigStep {
 public:
  explicit ConsensusStep(const Params& params)
      : params_(params), bounds_{rad_from_deg(params.max_rotation_deg), params.max_translation_m} {}

  static params::DataFlow data_flow(const Params& params) {
    if (params.weights != Weights::covariance) return {};
    params::DataFlow flow = takes(kCovariance);
    flow.add(gives(kCovariance));
    return flow;
  }

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    const auto sensor = [](const RigEstimate& member) {
      return RigKey{member.target, member.source};
    };
    for (const RigGroup& estimates : rig_groups(rig, sensor)) agree_on_pose(estimates);
  }

 private:
  /// Sets all estimates of a sensor to the pose that they agree on.
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
        for (RigEstimate* const member : estimates) {
          member->failure =
              "weights \"covariance\" requires an earlier step that estimates a covariance";
        }
        return;
      }
      const InformedPose mean = weighted_mean(agreeing);
      pose = mean.pose;
      covariance->matrix = guarded_inverse<6>(mean.information);
      // A scene that does not constrain a direction has no weight in it, so the best class counts.
      for (const RigEstimate* const member : agreeing) {
        covariance->dofs = best_observability(covariance->dofs, member->estimate.covariance->dofs);
      }
    } else if (agreeing.size() > 1) {
      // consensus_pose averages the poses near a medoid; the poses near that mean may differ.
      pose = mean_pose(poses_of(agreeing));
    }
    const std::optional<std::string> rejection = verdict(estimates, votes, agreeing.size(), ratio);
    for (RigEstimate* const member : estimates) {
      member->estimate.set_pose(pose);
      member->estimate.information = information;
      member->estimate.covariance = covariance;
      member->estimate.rejection = rejection;
      member->estimate.diagnostics = {{"scenes", static_cast<double>(estimates.front()->scenes)},
                                      {"agreeing_ratio", ratio}};
    }
  }

  static std::vector<RigidTransform> poses_of(const RigGroup& estimates) {
    std::vector<RigidTransform> poses;
    for (const RigEstimate* const member : estimates)
      poses.push_back(member->estimate.T_target_source);
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

  /// The mean of the poses of these scenes, weighted by their covariances, which all must have.
  static InformedPose weighted_mean(const RigGroup& agreeing) {
    std::vector<InformedPose> known;
    for (const RigEstimate* const member : agreeing) {
      known.push_back(
          informed(member->estimate.T_target_source, member->estimate.covariance->matrix));
    }
    return informed_mean(known);
  }

  /// Scenes are independent observations of one pose, so their information matrices add up;
  /// std::nullopt if a scene has none.
  static std::optional<Matrix6d> joint_information(const RigGroup& agreeing) {
    if (agreeing.empty()) return std::nullopt;
    Matrix6d sum = Matrix6d::Zero();
    for (const RigEstimate* const member : agreeing) {
      if (!member->estimate.information) return std::nullopt;
      sum += *member->estimate.information;
    }
    return sum;
  }

  /// The covariance of the mean of the poses of these scenes, whose errors are independent;
  /// std::nullopt if a scene has none.
  static std::optional<PoseCovariance> joint_covariance(const RigGroup& agreeing) {
    std::vector<PoseCovariance> covariances;
    for (const RigEstimate* const member : agreeing) {
      if (!member->estimate.covariance) return std::nullopt;
      covariances.push_back(*member->estimate.covariance);
    }
    if (covariances.empty()) return std::nullopt;
    return covariance_of_mean(covariances);
  }

  /// The reason for a rejection, or std::nullopt if the pose is accepted.
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
  return stage_entry<ConsensusStep>("consensus",
                                    "Processes the whole rig: sets each sensor, in all scenes of a "
                                    "trial, to the pose on which the majority of its scenes agree.",
                                    "mean after Markley et al., Averaging Quaternions, JGCD 2007",
                                    table(), 3);
}

}  // namespace croon::stages::step
