#include "framework/registration/joint_pair.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/params/values.hpp"
#include "framework/registration/direction_balance.hpp"
#include "framework/registration/icp_options.hpp"
#include "framework/spatial/deskew.hpp"

namespace croon {
namespace {

/// The points of a scan that take part: evenly through it, those with a normal, and their weights.
struct Sample {
  std::vector<int> indices;
  std::vector<double> weights;
};

/// The same in every iteration, so it is made once.
std::shared_ptr<const Sample> sample_of(const Cloud& cloud, const JointOptions& options) {
  const std::string parameters =
      params::value_json(options.points) + " " + params::value_json(options.normal_neighbours) +
      " " + params::value_json(options.patch_m) + " " + params::value_json(options.patch_balance);
  return cloud.once<Sample>("joint_sample", parameters, [&] {
    auto sample = std::make_shared<Sample>();
    const Normals& normals = cloud.normals(options.normal_neighbours);
    const auto size = static_cast<std::int64_t>(cloud.points().size());
    const std::int64_t count = std::min<std::int64_t>(size, options.points);
    for (std::int64_t n = 0; n < count; ++n) {
      const auto i = static_cast<int>(n * size / count);
      if (!normals.at(i).normal.isZero()) sample->indices.push_back(i);
    }
    sample->weights = patch_weights(cloud, sample->indices, options.normal_neighbours,
                                    options.patch_m, options.patch_balance);
    return sample;
  });
}

}  // namespace

StillTarget::StillTarget(const JointScene& scene, const Twist& velocity, int normal_neighbours)
    : scene_(scene),
      cloud_(
          deskewed(scene.target.cloud->points(), scene.target.times_s, velocity, scene.reference_s),
          StreamKey(0)),
      normals_(cloud_.normals(normal_neighbours)) {}

PairEquations pair_equations(const JointScene::Source& source, const StillTarget& target,
                             double reference_s, const Twist& velocity, const JointState& state,
                             double max_distance_m, const JointOptions& options) {
  using Eigen::Vector3d;
  const RigidTransform& T = state.T_target_sensor[source.sensor];
  const Cloud& cloud = *source.scan.cloud;
  const Normals& normals = cloud.normals(options.normal_neighbours);
  const double min_cosine = std::cos(rad_from_deg(options.max_normal_angle_deg));
  const RobustKernel kernel(Kernel::geman_mcclure,
                            std::max(options.kernel_width_m, max_distance_m / 4.0));
  const std::shared_ptr<const Sample> sample = sample_of(cloud, options);
  PairEquations sums;
  for (std::size_t k = 0; k < sample->indices.size(); ++k) {
    const int i = sample->indices[k];
    const double source_s =
        source.scan.times_s[i] + state.clock_offsets_s[source.sensor] - reference_s;
    const RigidTransform motion = motion_over(velocity, source_s);
    const Vector3d turned = T.rotation * cloud.points()[i].cast<double>();
    const Vector3d q = motion * Vector3d(turned + T.translation);
    const Neighbour nearest =
        target.cloud().kd_tree().nearest(q.cast<float>(), static_cast<float>(max_distance_m));
    if (!nearest) continue;
    const Vector3d n = target.normals().at(nearest.index).normal.cast<double>();
    const Vector3d source_normal =
        motion.rotation * (T.rotation * normals.at(i).normal.cast<double>());
    if (n.isZero() || n.dot(source_normal) < min_cosine) continue;
    const Vector3d p = target.cloud().points()[nearest.index].cast<double>();
    const double target_s = target.time_s(nearest.index);
    const double residual = n.dot(q - p);
    // The derivatives of exp(xi t) at small xi t: a scan turns by a few degrees at most.
    Eigen::Matrix<double, kPairUnknowns, 1> J;
    J << (motion.rotation * turned).cross(n), n, source_s * q.cross(n) - target_s * p.cross(n),
        (source_s - target_s) * n, n.dot(velocity.angular_radps.cross(q) + velocity.linear_mps);
    const double w = sample->weights[k] * kernel.weight(residual * residual);
    sums.information.selfadjointView<Eigen::Lower>().rankUpdate(J, w);
    sums.gradient += (w * residual) * J;
    sums.weighted_square_sum += w * residual * residual;
    sums.weight_sum += w;
    ++sums.correspondences;
  }
  sums.information.triangularView<Eigen::StrictlyUpper>() = sums.information.transpose();
  return sums;
}

}  // namespace croon
