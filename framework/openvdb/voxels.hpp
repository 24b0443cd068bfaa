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

/// The two functions by which croon uses OpenVDB (Museth 2013). voxels.cpp defines them by calls of
/// OpenVDB. Its library takes 0.06 s to load, so on_demand.cpp defines them for the program as
/// calls of a module that is loaded when it is first needed.
std::unique_ptr<const Tree> make_tree(const Indices& voxels);

/// The content of a .vdb file with a grid of bools, "occupancy", in which these voxels are true.
/// Voxel (i, j, k) is the cube from (i, j, k) to (i + 1, j + 1, k + 1) times `size_m`. Its UUID is
/// random.
std::string occupancy_file(const Indices& voxels, double size_m);

}  // namespace croon::voxels
