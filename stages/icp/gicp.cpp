#include <Eigen/LU>

#include "framework/registration/direction_balance.hpp"
#include "framework/registration/icp_loop.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::icp {
namespace {

struct Params : IcpOptions {
  int normal_neighbours = 20;
  double plane_variance_ratio = 0.001;
  double direction_balance = 0.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::integer("normal_neighbours", &Params::normal_neighbours, {3, 1000},
                          "The number of neighbours that a point's covariance is computed from."),
          params::number(
              "plane_variance_ratio", &Params::plane_variance_ratio, {1e-9, 1.0},
              "Variance across the surface over that along it, the epsilon of the paper."),
          params::number("direction_balance", &Params::direction_balance, {0.0, 1.0},
                         "Correspondences on n surfaces of about one direction weigh n to the "
                         "minus this: at 1 "
                         "every direction weighs the same, at 0 every point, as in the paper."),
      }
          .inherit(icp_table());
  return table;
}

/// The covariance of a point on a plane: `R diag(epsilon, 1, 1) R^T`, first axis along the normal.
Eigen::Matrix3d plane_covariance(const Eigen::Vector3d& normal, double epsilon) {
  return Eigen::Matrix3d::Identity() - (1.0 - epsilon) * (normal * normal.transpose());
}

class Gicp final : public Icp {
 public:
  explicit Gicp(Params params) : params_(std::move(params)) {}

  Registration align(const Cloud& target, const Cloud& source,
                     const RigidTransform& start) const override {
    CorrespondenceRule rule;
    rule.target_normals = params_.normal_neighbours;
    rule.source_normals = params_.normal_neighbours;
    if (params_.direction_balance > 0.0)
      rule.select = balanced_directions(params_.direction_balance);
    const double epsilon = params_.plane_variance_ratio;
    // Residual `R s + t - p` with information `(C_t + R C_s R^T)^-1` (Segal, eq. 2). Times 2
    // epsilon it weighs a distance across two planes that agree by one, so the kernel's width is in
    // metres.
    const Linearise linearise =
        for_each_correspondence([epsilon](const Correspondence& pair, const RobustKernel& kernel,
                                          NormalEquations& equations) {
          const Eigen::Matrix3d covariance = plane_covariance(pair.target_normal, epsilon) +
                                             plane_covariance(pair.source_normal, epsilon);
          const Eigen::Matrix3d Omega = 2.0 * epsilon * covariance.inverse();
          const double squared = pair.offset.dot(Omega * pair.offset);
          equations.add(point_jacobian(pair.arm), pair.offset, Omega, kernel.weight(squared));
        });
    return iterate_icp(target, source, start, params_, rule, linearise);
  }

 private:
  Params params_;
};

}  // namespace

StageEntry gicp() {
  return stage_entry<Gicp>("gicp",
                           "Plane-to-plane: each point is weighed by the surfaces on both sides.",
                           "Segal, Haehnel, Thrun: Generalized-ICP, RSS 2009", table());
}

}  // namespace croon::stages::icp
