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
                          "Number of neighbours from which a point's covariance is computed."),
          params::number(
              "plane_variance_ratio", &Params::plane_variance_ratio, {1e-9, 1.0},
              "Variance across a surface relative to the variance along it, epsilon in the paper."),
          params::number(
              "direction_balance", &Params::direction_balance, {0.0, 1.0},
              "Each of n correspondences with similar normals is weighted by n^-k, k being this: "
              "at 1 every direction has the same weight, at 0 every point, as in the paper."),
      }
          .inherit(icp_table());
  return table;
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
    // A distance across two parallel planes has weight one, so the kernel's width is in metres.
    const Linearise linearise =
        for_each_correspondence([epsilon](const Correspondence& pair, const RobustKernel& kernel,
                                          NormalEquations& equations) {
          const Eigen::Matrix3d Omega =
              plane_to_plane_information(pair.target_normal, pair.source_normal, epsilon);
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
  return stage_entry<Gicp>(
      "gicp", "Plane-to-plane: residuals are weighted by the covariances of both surfaces.",
      "Segal, Haehnel, Thrun: Generalized-ICP, RSS 2009", table(), 2);
}

}  // namespace croon::stages::icp
