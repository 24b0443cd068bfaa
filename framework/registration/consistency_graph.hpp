#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// Correspondences by index: `target[i]` corresponds to `source[i]`, both with a unit normal.
struct OrientedPairs {
  Points target;
  Points target_normals;
  Points source;
  Points source_normals;

  std::size_t size() const { return target.size(); }
};

/// Tolerances for two correspondences to be consistent with one pose.
struct ConsistencyOptions {
  double tolerance_m = 0.4;        ///< Of the distance between the two points.
  double normal_tolerance = 0.35;  ///< Of the products of the normals with each other and with the
                                   ///< line between the points; 2: normals are ignored.
};

/// The pairwise consistency of correspondences: no motion changes the distance of two points, nor
/// the angles between their normals and the line between them. Correct correspondences are all
/// mutually consistent, so they form a clique. After Yang, Shi and Carlone, TEASER, T-RO 2021
/// (distances), and Lusk, Fathian and How, CLIPPER, ICRA 2021 (normals).
class ConsistencyGraph {
 public:
  /// Maximum number of correspondences: one bit per pair of them, 300 MB.
  static constexpr std::size_t kMaxVertices = 50000;

  /// Throws StageError if there are more.
  ConsistencyGraph(const OrientedPairs& pairs, const ConsistencyOptions& options);

  /// The core number of each vertex: the largest k such that the vertex belongs to a subgraph in
  /// which every vertex has at least k neighbours (Matula and Beck 1983). A clique of n vertices is
  /// in the (n-1)-core (Shi et al., ROBIN, ICRA 2021).
  std::vector<int> core_numbers() const;

  /// A maximal clique that contains `seed`, grown greedily: among the vertices that are consistent
  /// with all members, the one with the most neighbours is added next (the first in case of ties).
  /// Neighbours are recounted each time half of the vertices have dropped out.
  std::vector<int> clique(int seed) const;

  int size() const { return size_; }

 private:
  using Bits = std::vector<std::uint64_t>;
  std::size_t word(int row, int column) const {
    return static_cast<std::size_t>(row) * words_ + static_cast<std::size_t>(column) / 64;
  }
  /// The neighbours of a vertex.
  Bits neighbours(int vertex) const;
  /// The number of elements of `set` that are neighbours of a vertex.
  int common(int vertex, const Bits& set) const;
  std::vector<int> members(const Bits& set) const;
  /// The members of `set`, those with the most neighbours in it first.
  std::vector<int> by_neighbours(const Bits& set) const;

  int size_;
  std::size_t words_;  ///< Of a row.
  Bits rows_;          ///< Bit b of row a: a and b are consistent; unset for a = b.
};

}  // namespace croon
