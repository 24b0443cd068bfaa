#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/registration/icp_loop.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::icp {
namespace {

struct Params : IcpOptions {
  int normal_neighbours = 40;
  double max_normal_angle_deg = 60.0;
  double max_surface_variation = 0.02;
  double tangent_weight_ratio = 0.001;
  double rough_weight_ratio = 0.02;
  double normal_weight_m = 0.1;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::integer("normal_neighbours", &Params::normal_neighbours, {3, 1000},
                          "Number of neighbours from which a normal is computed."),
          params::number("max_normal_angle_deg", &Params::max_normal_angle_deg, {0.0, 180.0},
                         "Maximum angle between the normals of corresponding points."),
          params::number("max_surface_variation", &Params::max_surface_variation, {0.0, 1.0},
                         "Maximum surface variation of a point on a plane, where normals are used "
                         "and distances along the surface have little weight.")
              .formerly("plane_surface_variation"),
          params::number("tangent_weight_ratio", &Params::tangent_weight_ratio, {1e-9, 1.0},
                         "Weight of a distance along a plane relative to a distance across it."),
          params::number("rough_weight_ratio", &Params::rough_weight_ratio, {0.0, 1.0},
                         "Weight of a distance, in any direction, at a point that is not on a "
                         "plane, relative to a distance across a plane."),
          params::number(
              "normal_weight_m", &Params::normal_weight_m, {0.0, 1e3},
              "Distance with the same weight as a difference of one radian between normals."),
      }
          .inherit(icp_table());
  return table;
}

/// `[-[R n]x, 0]`: the Jacobian of a rotated normal.
Eigen::Matrix<double, 3, 6> normal_jacobian(const Eigen::Vector3d& normal) {
  Eigen::Matrix<double, 3, 6> J = point_jacobian(normal);
  J.rightCols<3>().setZero();
  return J;
}

/// Adds the residuals `R s + t - p`, weighted by the information of the target's surface (low along
/// a flat surface, low in every direction on a rough one), and `R n_s - n_t` if it is flat
/// (Serafin, Grisetti 2015, section III).
void linearise(const Params& params, const Correspondence& pair, const RobustKernel& kernel,
               NormalEquations& equations) {
  const bool is_flat = pair.target_variation <= params.max_surface_variation;
  const Eigen::Vector3d& n = pair.target_normal;
  Eigen::Matrix3d Omega = params.rough_weight_ratio * Eigen::Matrix3d::Identity();
  if (is_flat) {
    const double along = params.tangent_weight_ratio;
    Omega = along * Eigen::Matrix3d::Identity() + (1.0 - along) * (n * n.transpose());
  }
  const double weight = kernel.weight(pair.offset.dot(Omega * pair.offset));
  equations.add(point_jacobian(pair.arm), pair.offset, Omega, weight);
  if (!is_flat) return;
  const double share = params.normal_weight_m * params.normal_weight_m;
  equations.add(normal_jacobian(pair.source_normal), pair.source_normal - n,
                share * Eigen::Matrix3d::Identity(), weight);
}

class Nicp final : public Icp {
 public:
  explicit Nicp(Params params) : params_(std::move(params)) {}

  Registration align(const Cloud& target, const Cloud& source,
                     const RigidTransform& start) const override {
    CorrespondenceRule rule;
    rule.target_normals = params_.normal_neighbours;
    rule.source_normals = params_.normal_neighbours;
    rule.min_normal_cosine = min_cosine_within(params_.max_normal_angle_deg);
    return iterate_icp(
        target, source, start, params_, rule,
        for_each_correspondence(
            [this](const Correspondence& pair, const RobustKernel& kernel,
                   NormalEquations& equations) { linearise(params_, pair, kernel, equations); }));
  }

 private:
  Params params_;
};

}  // namespace

StageEntry nicp() {
  return stage_entry<Nicp>(
      "nicp",
      "Minimises the distances of the points and the differences of their normals together.",
      "Serafin, Grisetti: NICP: Dense normal based point cloud registration, IROS 2015", table(),
      3);
}

}  // namespace croon::stages::icp
