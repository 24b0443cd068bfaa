#include <openvdb/tools/Count.h>
#include <openvdb/tree/LeafNodeMask.h>
#include <openvdb/tree/Tree.h>
#include <openvdb/tree/ValueAccessor.h>

#include "framework/spatial/leaf_grid.hpp"
#include "framework/stage/leaf_scorer.hpp"

namespace croon::stages::volume_scorer {
namespace {

/// A sparse grid of bits. Its nodes are 64 voxels wide (those of MaskTree: 4096), because a cloud
/// fills little of the space around it and a node's memory is cleared for every pose.
using Tree = openvdb::tree::Tree3<openvdb::ValueMask, 3, 3>::Type;

/// Not registered with its tree: no tree here loses nodes while it is read.
template <class T>
using Accessor = openvdb::tree::ValueAccessor<T, false>;

openvdb::Coord coord(const Eigen::Vector3i& leaf) { return {leaf.x(), leaf.y(), leaf.z()}; }

/// Counts on one thread: a thread that waits inside a trial must not start the work of another
/// trial.
std::int64_t leaves(const Tree& tree) {
  return static_cast<std::int64_t>(openvdb::tools::countActiveVoxels(tree, false));
}

class OpenvdbGrid final : public LeafSet {
 public:
  static constexpr const char* kName = "openvdb_grid";

  OpenvdbGrid(const LeafGrid& grid, const PointColumns& target, const RigidTransform& T_grid_target)
      : grid_(grid) {
    Accessor<Tree> voxels(tree_);
    for (std::size_t i = 0; i < target.size(); ++i) {
      voxels.setValueOn(coord(grid_.leaf_of(T_grid_target * target.point(i))));
    }
    leaves_ = leaves(tree_);
  }

  std::int64_t leaves_with(const PointColumns& source,
                           const RigidTransform& T_grid_source) const override {
    Tree added;
    Accessor<Tree> added_voxels(added);
    const Accessor<const Tree> voxels(tree_);
    for (std::size_t i = 0; i < source.size(); ++i) {
      const openvdb::Coord voxel = coord(grid_.leaf_of(T_grid_source * source.point(i)));
      if (!voxels.isValueOn(voxel)) added_voxels.setValueOn(voxel);
    }
    return leaves_ + leaves(added);
  }

 private:
  LeafGrid grid_;
  Tree tree_;
  std::int64_t leaves_ = 0;
};

}  // namespace

StageEntry openvdb_grid() {
  return leaf_scorer_entry<OpenvdbGrid>("Counts the voxels of a sparse grid that hold points.",
                                        "OpenVDB (Museth 2013)");
}

}  // namespace croon::stages::volume_scorer
