#include "framework/openvdb/voxels.hpp"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Count.h>
#include <openvdb/tree/LeafNodeMask.h>
#include <openvdb/tree/Tree.h>
#include <openvdb/tree/ValueAccessor.h>

#include <sstream>

namespace croon::voxels {
namespace {

/// A sparse grid of bits. Its nodes are 64 voxels wide (4096 in MaskTree), because a cloud occupies
/// little of the space around it and a node's memory is cleared for every pose.
using Bits = openvdb::tree::Tree3<openvdb::ValueMask, 3, 3>::Type;

/// Accessors need not be registered with their tree: no tree here loses nodes while it is read.
template <class T>
using Accessor = openvdb::tree::ValueAccessor<T, false>;

openvdb::Coord coord(const Eigen::Vector3i& voxel) { return {voxel.x(), voxel.y(), voxel.z()}; }

/// Counts on one thread: a thread that waits inside a trial must not start working on another
/// trial.
std::int64_t count(const Bits& bits) {
  return static_cast<std::int64_t>(openvdb::tools::countActiveVoxels(bits, false));
}

class OpenvdbTree final : public Tree {
 public:
  explicit OpenvdbTree(const Indices& voxels) {
    Accessor<Bits> bits(bits_);
    for (const Eigen::Vector3i& voxel : voxels) bits.setValueOn(coord(voxel));
    count_ = count(bits_);
  }

  std::int64_t count_with(const Indices& others) const override {
    Bits added;
    Accessor<Bits> added_bits(added);
    const Accessor<const Bits> bits(bits_);
    for (const Eigen::Vector3i& voxel : others) {
      if (!bits.isValueOn(coord(voxel))) added_bits.setValueOn(coord(voxel));
    }
    return count_ + count(added);
  }

 private:
  Bits bits_;
  std::int64_t count_ = 0;
};

}  // namespace

std::unique_ptr<const Tree> make_tree(const Indices& voxels) {
  return std::make_unique<const OpenvdbTree>(voxels);
}

std::string occupancy_file(const Indices& voxels, double size_m) {
  openvdb::initialize();
  // The active voxels are true; most viewers can draw bool grids.
  const openvdb::BoolGrid::Ptr grid = openvdb::BoolGrid::create(false);
  openvdb::BoolGrid::Accessor values = grid->getAccessor();
  for (const Eigen::Vector3i& voxel : voxels) values.setValueOn(coord(voxel), true);
  // OpenVDB's voxels are centred at their indices, ours half a voxel beyond.
  const openvdb::math::Transform::Ptr transform =
      openvdb::math::Transform::createLinearTransform(size_m);
  transform->postTranslate(openvdb::Vec3d(0.5 * size_m));
  grid->setTransform(transform);
  grid->setName("occupancy");
  std::ostringstream stream(std::ios_base::binary);
  openvdb::io::Stream(stream).write(openvdb::GridCPtrVec{grid});
  return stream.str();
}

}  // namespace croon::voxels
