#include "framework/registration/icp_loop.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::icp {
namespace {

struct Params : IcpOptions {
  Params() { max_iterations = 50; }
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = params::Table<Params>().inherit(icp_table());
  return table;
}

class PointToPoint final : public Icp {
 public:
  explicit PointToPoint(Params params) : params_(std::move(params)) {}

  Registration align(const Cloud& target, const Cloud& source,
                     const RigidTransform& start) const override {
    // Residual `R s + t - p`.
    const Linearise linearise = for_each_correspondence(
        [](const Correspondence& pair, const RobustKernel& kernel, NormalEquations& equations) {
          equations.add(point_jacobian(pair.arm), pair.offset, Eigen::Matrix3d::Identity(),
                        kernel.weight(pair.offset.squaredNorm()));
        });
    return iterate_icp(target, source, start, params_, {}, linearise);
  }

 private:
  Params params_;
};

}  // namespace

StageEntry point_to_point() {
  return stage_entry<PointToPoint>(
      "point_to_point",
      "Minimises the distances between nearest neighbours; slides along surfaces that the two "
      "sensors sample at different points.",
      "Besl, McKay: A method for registration of 3-D shapes, PAMI 1992", table(), 2);
}

}  // namespace croon::stages::icp
