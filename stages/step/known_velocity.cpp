#include <optional>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/params/values.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/stage/given_motions.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/velocity_numbers.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  std::string file;
  std::vector<double> linear_mps = {0.0, 0.0, 0.0};
  std::vector<double> angular_degps = {0.0, 0.0, 0.0};
  double linear_std_mps = 0.0;
  double angular_std_degps = 0.0;
  std::vector<double> rotation_rpy_deg = {0.0, 0.0, 0.0};
  std::vector<double> translation_m = {0.0, 0.0, 0.0};
  std::string sha256;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = [] {
    params::Table<Params> rows = {
        params::optional(params::text("file", &Params::file,
                                      "A CSV file with a velocity for each scene; without it, "
                                      "linear_mps and angular_degps apply to all.")),
        params::numbers("linear_mps", &Params::linear_mps, {-kMaxSpeed_mps, kMaxSpeed_mps},
                        "The velocity along x, y, z of the velocity frame."),
        params::numbers("angular_degps", &Params::angular_degps,
                        {-kMaxTurnRate_degps, kMaxTurnRate_degps},
                        "The angular velocity about x, y, z of that frame."),
        params::number("linear_std_mps", &Params::linear_std_mps, {0.0, kMaxSpeed_mps},
                       "Standard deviation along each axis, for velocities without one in the "
                       "file; 0: exact."),
        params::number("angular_std_degps", &Params::angular_std_degps, {0.0, kMaxTurnRate_degps},
                       "The same about each axis; either both are 0 or neither."),
        params::numbers("rotation_rpy_deg", &Params::rotation_rpy_deg, {-360.0, 360.0},
                        "Roll, pitch and yaw of the velocity frame in the reference frame, R = "
                        "Rz(yaw) Ry(pitch) Rx(roll)."),
        params::numbers(
            "translation_m", &Params::translation_m, {-100.0, 100.0},
            "Origin of the velocity frame in the reference frame: the lever arm of an INS."),
        params::optional(params::text("sha256", &Params::sha256,
                                      "SHA-256 of the file; a file with another one is an error.")),
    };
    rows.rule({"file",
               {},
               false,
               {},
               {"linear_mps", "angular_degps"},
               "no such key together with \"file\""});
    rows.rule({"sha256", {}, false, {"file"}});
    const auto has_three = [](const std::vector<double>& list) { return list.size() == 3; };
    rows.require(
        [=](const Params& p) {
          return has_three(p.linear_mps) && has_three(p.angular_degps) &&
                 has_three(p.rotation_rpy_deg) && has_three(p.translation_m);
        },
        "linear_mps, angular_degps, rotation_rpy_deg and translation_m must have three numbers");
    rows.require(
        [](const Params& p) {
          return p.sha256.empty() ||
                 (p.sha256.size() == 64 &&
                  p.sha256.find_first_not_of("0123456789abcdef") == std::string::npos);
        },
        "sha256 must have 64 hexadecimal digits, in lower case");
    rows.require(
        [](const Params& p) { return (p.linear_std_mps > 0.0) == (p.angular_std_degps > 0.0); },
        "linear_std_mps and angular_std_degps must both be 0 or both be positive");
    return rows;
  }();
  return table;
}

Eigen::Vector3d vector_from(const std::vector<double>& list) {
  return Eigen::Vector3d(list.data());
}

class KnownVelocityStep final : public GivenMotionStep {
 public:
  explicit KnownVelocityStep(Params params) : params_(std::move(params)) {
    body_pose_ = {rotation_from_rpy(vector_from(params_.rotation_rpy_deg) * rad_from_deg(1.0)),
                  vector_from(params_.translation_m)};
  }

  static params::DataFlow data_flow(const Params&) {
    params::DataFlow flow = params::needs_channels({kTime});
    flow.add(gives(kMotion, kMotionCovariance));
    return flow;
  }

  File file() const override { return {params_.file, params_.sha256}; }

  std::shared_ptr<const Step> with(GivenMotions motions) const override {
    auto copy = std::make_shared<KnownVelocityStep>(params_);
    copy->motions_ = std::move(motions);
    return copy;
  }

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    for (RigEstimate& member : rig) {
      try {
        correct(member.scene, member.estimate);
      } catch (const StageError& error) {
        member.failure = error.what();
      }
    }
  }

 private:
  /// The velocity in `scene` and its uncertainty, in the velocity frame.
  GivenMotion motion_in(const std::string& scene) const {
    if (params_.file.empty()) {
      return {
          {vector_from(params_.angular_degps) * rad_from_deg(1.0), vector_from(params_.linear_mps)},
          std::nullopt};
    }
    if (!motions_) throw StageError("only an experiment reads a file of velocities");
    const auto found = motions_->find(scene);
    if (found == motions_->end()) throw StageError("the file has no velocity for this scene");
    return found->second;
  }

  Matrix6d covariance_of(const GivenMotion& motion) const {
    Vector6d stds = Vector6d::Zero();
    stds.head<3>().setConstant(rad_from_deg(params_.angular_std_degps));
    stds.tail<3>().setConstant(params_.linear_std_mps);
    const Matrix6d of_body = motion.stds.value_or(stds).cwiseAbs2().asDiagonal();
    const Matrix6d A = adjoint(body_pose_);
    return A * of_body * A.transpose();
  }

  /// Moves the points of both clouds to where they were half-way through the target's scan. The
  /// sensor's velocity follows from its pose, which should therefore be nearly correct.
  void correct(const std::string& scene, Estimate& estimate) const {
    if (!is_at_rest(estimate.extras)) {
      throw StageError("an earlier step has already corrected the clouds for a velocity");
    }
    if (estimate.target->empty() || estimate.source->empty()) {
      throw StageError("cannot correct an empty cloud");
    }
    const GivenMotion motion = motion_in(scene);
    const Twist velocity = velocity_in(body_pose_, motion.velocity);
    const double reference_s = span_of(times_s(estimate.target->with_channels())).middle_s();
    // The target is the same for all sensors and trials of the scene.
    const Vector6d numbers = vector_of(velocity);
    std::shared_ptr<const Cloud> target = estimate.target->once<Cloud>(
        "known_velocity",
        params::value_json(std::vector<double>(numbers.data(), numbers.data() + numbers.size())),
        [&] {
          return estimate.target->derived(still(*estimate.target, velocity, reference_s), "still");
        });
    const RigidTransform T_sensor_reference = estimate.T_target_source.inverse();
    estimate.take_clouds(
        std::move(target),
        estimate.source->derived_in_trial(
            still(*estimate.source, velocity_in(T_sensor_reference, velocity), reference_s),
            "still"));
    estimate.extras.put(kMotion, velocity);
    estimate.extras.put(kMotionCovariance, covariance_of(motion));
    estimate.diagnostics = velocity_diagnostics(velocity);
  }

  static PointCloud still(const Cloud& cloud, const Twist& velocity, double reference_s) {
    const std::vector<double> times = times_s(cloud.with_channels());
    require_near(times, reference_s);
    return deskewed(cloud.with_channels(), times, velocity, reference_s);
  }

  Params params_;
  RigidTransform body_pose_;  ///< T_reference_body, with the velocity frame as body.
  std::optional<GivenMotions> motions_;
};

}  // namespace

StageEntry known_velocity() {
  return stage_entry<KnownVelocityStep>(
      "known_velocity",
      "Removes the motion distortion of all scans of a scene with a known velocity: one per scene "
      "from a file, or one for all. The poses should be nearly correct already.",
      "Zhang and Singh, LOAM, 2014, section V.B", table(), 2);
}

}  // namespace croon::stages::step
