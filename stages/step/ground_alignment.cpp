#include "framework/base/error.hpp"
#include "framework/stage/ground_extractor.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  params::Slot<GroundExtractor> extractor;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::slot("extractor", &Params::extractor, R"({"type": "ransac"})",
                   "Finds the ground of each cloud."),
  };
  return table;
}

/// The plane with its normal towards the majority of the non-ground points: the sign of a normal is
/// arbitrary, but objects are above the ground (paper, rough calibration, the flip of roll and
/// pitch by pi).
Plane facing_up(const Ground& ground, const Points& cloud) {
  std::size_t above = 0;
  std::size_t below = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (ground.is_ground[i] != 0) continue;
    ++(ground.plane.signed_distance(cloud[i].cast<double>()) > 0.0 ? above : below);
  }
  return below > above ? ground.plane.flipped() : ground.plane;
}

/// Rotates the source's ground onto the target's by the smallest rotation, then lifts it to the
/// same height (paper, rough calibration): roll, pitch and z.
RigidTransform aligned(const RigidTransform& T_target_source, const Plane& target,
                       const Plane& source) {
  const Eigen::Vector3d source_normal = T_target_source.rotation * source.normal;
  RigidTransform T = T_target_source;
  T.rotation = nearest_rotation(rotation_between(source_normal, target.normal) * T.rotation);
  // The source's plane is now `n . p + offset_source - n . t = 0` in the target's frame.
  const double lift_m = source.offset_m - target.offset_m - target.normal.dot(T.translation);
  T.translation += lift_m * target.normal;
  return T;
}

class GroundAlignment final : public Step {
 public:
  explicit GroundAlignment(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    estimate.target_ground = split(*estimate.target, "reference");
    estimate.source_ground = split(*estimate.source, "sensor");
    estimate.set_pose(aligned(estimate.T_target_source, estimate.target_ground->plane,
                              estimate.source_ground->plane));
    estimate.diagnostics = {{"target_ground_offset_m", estimate.target_ground->plane.offset_m},
                            {"source_ground_offset_m", estimate.source_ground->plane.offset_m}};
    return estimate;
  }

 private:
  /// The cloud's ground, extracted once for all initial guesses.
  std::shared_ptr<const GroundSplit> split(const Cloud& cloud, const char* whose) const {
    if (cloud.empty()) throw StageError(std::string("the ") + whose + " cloud is empty");
    const std::string what = "ground/" + params_.extractor.name();
    const std::string& parameters = params_.extractor.resolved();
    return cloud.once<GroundSplit>(what, parameters, [&] {
      Rng rng = cloud.rng(what);
      const Ground ground = params_.extractor->extract(cloud.with_channels(), rng);
      PointCloud non_ground =
          filtered(cloud.with_channels(), [&](std::size_t i) { return ground.is_ground[i] == 0; });
      return std::make_shared<const GroundSplit>(GroundSplit{
          facing_up(ground, cloud.points()), cloud.derived(std::move(non_ground), what)});
    });
  }

  Params params_;
};

}  // namespace

StageEntry ground_alignment() {
  return stage_entry<GroundAlignment>("ground_alignment",
                                      "Rotates the sensor's ground plane onto the reference's and "
                                      "lifts it to the same height: roll, pitch, z.",
                                      "CROON (arXiv 2203.03182), rough calibration", table());
}

}  // namespace croon::stages::step
