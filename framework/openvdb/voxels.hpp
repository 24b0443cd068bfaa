#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace croon::voxels {

/// Integer indices of voxels, in any order; one may stand there more than once.
using Indices = std::vector<Eigen::Vector3i>;

/// The set of some voxels as a sparse tree of bits. Thread-safe.
class Tree {
 public:
  Tree() = default;
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
  virtual ~Tree() = default;

  /// How many voxels are in the tree or among `others`.
  virtual std::int64_t count_with(const Indices& others) const = 0;
};

/// What croon uses of OpenVDB (Museth 2013), whose library has 66 000 names to bind and so takes a
/// third of a tenth of a second to load. Two libraries define these functions: croon_openvdb
/// calls OpenVDB; croon_openvdb_on_demand loads the first as a module at the first call, for a
/// program that starts often and seldom calls them.
std::unique_ptr<const Tree> make_tree(const Indices& voxels);

/// The content of a .vdb file with a grid of bools, "occupancy", in which these voxels are true.
/// Voxel (i, j, k) is the cube from (i, j, k) to (i + 1, j + 1, k + 1) times `size_m`. Its UUID is
/// random.
std::string occupancy_file(const Indices& voxels, double size_m);

}  // namespace croon::voxels
