#include "framework/openvdb/voxels.hpp"
#include "framework/spatial/leaf_grid.hpp"
#include "framework/stage/leaf_scorer.hpp"

namespace croon::stages::volume_scorer {
namespace {

voxels::Indices leaves_of(const LeafGrid& grid, const PointColumns& points,
                          const RigidTransform& T_grid_points) {
  voxels::Indices leaves;
  leaves.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    leaves.push_back(grid.leaf_of(T_grid_points * points.point(i)));
  }
  return leaves;
}

class OpenvdbGrid final : public LeafSet {
 public:
  static constexpr const char* kName = "openvdb_grid";

  OpenvdbGrid(const LeafGrid& grid, const PointColumns& target, const RigidTransform& T_grid_target)
      : grid_(grid), target_(voxels::make_tree(leaves_of(grid, target, T_grid_target))) {}

  std::int64_t leaves_with(const PointColumns& source,
                           const RigidTransform& T_grid_source) const override {
    return target_->count_with(leaves_of(grid_, source, T_grid_source));
  }

 private:
  LeafGrid grid_;
  std::unique_ptr<const voxels::Tree> target_;
};

}  // namespace

StageEntry openvdb_grid() {
  return leaf_scorer_entry<OpenvdbGrid>("Counts the voxels of a sparse grid that contain points.",
                                        "OpenVDB (Museth 2013)");
}

}  // namespace croon::stages::volume_scorer
