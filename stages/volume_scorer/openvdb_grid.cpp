#include <openvdb/tools/Count.h>
#include <openvdb/tree/LeafNodeMask.h>
#include <openvdb/tree/Tree.h>
#include <openvdb/tree/ValueAccessor.h>

#include "framework/params/values.hpp"
#include "framework/spatial/leaf_grid.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/volume_scorer.hpp"

namespace croon::stages::volume_scorer {
namespace {

struct Params {
  double leaf_size_m = 0.05;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::number("leaf_size_m", &Params::leaf_size_m, {1e-3, 1e3},
                     "Edge of the voxels that are counted."),
  };
  return table;
}

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

class OpenvdbGrid final : public VolumeScorer {
 public:
  explicit OpenvdbGrid(const Params& params) : leaf_size_m_(params.leaf_size_m) {}

  VolumeFunction bind(std::shared_ptr<const Cloud> target,
                      std::shared_ptr<const Cloud> source) const override {
    const LeafGrid grid(leaf_size_m_);
    const std::string leaf_size = params::value_json(leaf_size_m_);
    const auto target_tree = target->once<Tree>("volume_scorer/openvdb_grid", leaf_size, [&] {
      const auto tree = std::make_shared<Tree>();
      Accessor<Tree> voxels(*tree);
      for (const Eigen::Vector3f& point : target->points()) {
        voxels.setValueOn(coord(grid.leaf_of(point.cast<double>())));
      }
      return tree;
    });
    const std::int64_t target_leaves = leaves(*target_tree);
    return {[grid, target_tree, target_leaves, source](const RigidTransform& T_target_source) {
              Tree added;
              Accessor<Tree> added_voxels(added);
              const Accessor<const Tree> target_voxels(*target_tree);
              for (const Eigen::Vector3f& point : source->points()) {
                const openvdb::Coord voxel =
                    coord(grid.leaf_of(T_target_source * point.cast<double>()));
                if (!target_voxels.isValueOn(voxel)) added_voxels.setValueOn(voxel);
              }
              return OccupiedVolume{target_leaves + leaves(added), grid.leaf_size_m()};
            },
            Poses::in_parallel};
  }

 private:
  double leaf_size_m_;
};

}  // namespace

StageEntry openvdb_grid() {
  return stage_entry<OpenvdbGrid>("openvdb_grid",
                                  "Counts the voxels of a sparse grid that hold points.",
                                  "OpenVDB (Museth 2013)", table());
}

}  // namespace croon::stages::volume_scorer
