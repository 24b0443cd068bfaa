#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace croon::voxels {

/// Integer indices of voxels, in any order, possibly with duplicates.
using Indices = std::vector<Eigen::Vector3i>;

/// A set of voxels as a sparse tree of bits. Thread-safe.
class Tree {
 public:
  Tree() = default;
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
  virtual ~Tree() = default;

  /// The number of distinct voxels in the tree or in `others`.
  virtual std::int64_t count_with(const Indices& others) const = 0;
};

/// The two functions through which croon uses OpenVDB (Museth 2013). voxels.cpp implements them
/// with OpenVDB. Since its library takes 0.06 s to load, on_demand.cpp implements them for the
/// program by calling a module that is loaded on first use.
std::unique_ptr<const Tree> make_tree(const Indices& voxels);

/// The content of a .vdb file with a grid of bools, "occupancy", in which these voxels are true.
/// Voxel (i, j, k) is the cube from (i, j, k) to (i + 1, j + 1, k + 1) times `size_m`. Its UUID is
/// random.
std::string occupancy_file(const Indices& voxels, double size_m);

}  // namespace croon::voxels
