#include "framework/registration/icp_loop.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::icp {
namespace {

struct Params : IcpOptions {
  int normal_neighbours = 40;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::integer("normal_neighbours", &Params::normal_neighbours, {3, 1000},
                          "Number of neighbours from which a normal of the target is computed.")}
          .inherit(icp_table());
  return table;
}

class PointToPlane final : public Icp {
 public:
  explicit PointToPlane(Params params) : params_(std::move(params)) {}

  Registration align(const Cloud& target, const Cloud& source,
                     const RigidTransform& start) const override {
    CorrespondenceRule rule;
    rule.target_normals = params_.normal_neighbours;
    return iterate_icp(target, source, start, params_, rule, point_to_plane_linearisation());
  }

 private:
  Params params_;
};

}  // namespace

StageEntry point_to_plane() {
  return stage_entry<PointToPlane>(
      "point_to_plane",
      "Minimises the distances of points from the planes through their nearest neighbours.",
      "Chen, Medioni: Object modelling by registration of multiple range images, IVC 1992",
      table());
}

}  // namespace croon::stages::icp
