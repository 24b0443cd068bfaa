#include "framework/stage/leaf_scorer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace croon {
namespace {

/// A grid of leaves and the position of its origin in the target's frame.
struct Lattice {
  LeafGrid grid;
  Eigen::Vector3d origin_m;

  /// Converts a pose from the target's frame to the grid's.
  RigidTransform from_target(RigidTransform T_target_points) const {
    T_target_points.translation -= origin_m;
    return T_target_points;
  }
};

/// The offset of lattice `k` as fractions of a leaf: `k` times powers of 1 / 1.2207, the root of
/// x^4 = x + 1, modulo 1. Any number of these fills the leaf evenly, also along each axis (Roberts,
/// The unreasonable effectiveness of quasirandom sequences, 2018).
Eigen::Vector3d evenly_spread(int k) {
  const Eigen::Array3d steps(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
  const Eigen::Array3d shares = k * steps;
  return shares - shares.floor();
}

std::vector<Lattice> lattices_of(const LeafOptions& options) {
  const Eigen::Vector3d offset(options.lattice_offset_ratio.values.data());
  std::vector<Lattice> lattices;
  for (int size = 0; size < options.leaf_sizes; ++size) {
    const double leaf_size_m = std::ldexp(options.leaf_size_m, size);
    for (int k = 0; k < options.lattices; ++k) {
      lattices.push_back({LeafGrid(leaf_size_m), leaf_size_m * (offset + evenly_spread(k))});
    }
  }
  return lattices;
}

/// The points in leaves that contain at least `min_points` of them, in any order.
PointColumns in_full_leaves(const PointColumns& points, const RigidTransform& T_grid_points,
                            const LeafGrid& grid, int min_points) {
  std::vector<std::pair<LeafKey, std::size_t>> by_leaf;
  by_leaf.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    by_leaf.emplace_back(leaf_key(grid.leaf_of(T_grid_points * points.point(i))), i);
  }
  std::sort(by_leaf.begin(), by_leaf.end());
  Points kept;
  for (auto first = by_leaf.begin(); first != by_leaf.end();) {
    const auto last = std::find_if(first, by_leaf.end(),
                                   [&](const auto& other) { return other.first != first->first; });
    if (last - first >= min_points) {
      for (; first != last; ++first) kept.push_back(points.point(first->second).cast<float>());
    }
    first = last;
  }
  return PointColumns(kept);
}

/// The leaves of a target in one lattice.
struct BoundLattice {
  Lattice lattice;
  std::shared_ptr<const LeafSet> target;

  std::int64_t leaves(const PointColumns& source, const RigidTransform& T_target_source,
                      int min_points) const {
    const RigidTransform pose = lattice.from_target(T_target_source);
    if (min_points == 1) return target->leaves_with(source, pose);
    return target->leaves_with(in_full_leaves(source, pose, lattice.grid, min_points), pose);
  }
};

}  // namespace

const params::Table<LeafOptions>& leaf_table() {
  using params::integer;
  static const params::Table<LeafOptions> table = {
      params::number("leaf_size_m", &LeafOptions::leaf_size_m, {1e-3, 1e3}, "Leaf size."),
      integer("leaf_sizes", &LeafOptions::leaf_sizes, {1, 10},
              "Number of leaf sizes, each twice the previous one; the volume is their mean."),
      integer("lattices", &LeafOptions::lattices, {1, 64},
              "Number of evenly spread lattices of leaves; the volume is their mean. Averages out "
              "aliasing at leaf borders; cost grows linearly."),
      params::per_axis("lattice_offset_ratio", &LeafOptions::lattice_offset_ratio, {0.0, 1.0},
                       "Offset of the lattices along x, y and z, as a share of the leaf size."),
      integer("min_points", &LeafOptions::min_points, {1, 10000},
              "Minimum number of points of a cloud in an occupied leaf. Values above 1 make a pose "
              "several times as expensive."),
  };
  return table;
}

VolumeFunction LeafScorer::bind(std::shared_ptr<const Cloud> target,
                                std::shared_ptr<const Cloud> source) const {
  std::vector<BoundLattice> bound;
  for (const Lattice& lattice : lattices_of(options_)) {
    const auto make = [&] {
      const RigidTransform T_grid_target = lattice.from_target({});
      const PointColumns points(target->points());
      if (options_.min_points == 1) return set_of(lattice.grid, points, T_grid_target);
      return set_of(lattice.grid,
                    in_full_leaves(points, T_grid_target, lattice.grid, options_.min_points),
                    T_grid_target);
    };
    const Eigen::Vector3d& origin_m = lattice.origin_m;
    const std::vector<double> parameters = {lattice.grid.leaf_size_m(), origin_m.x(), origin_m.y(),
                                            origin_m.z(), static_cast<double>(options_.min_points)};
    bound.push_back({lattice, target->once<LeafSet>(std::string("volume_scorer/") + name(),
                                                    params::value_json(parameters), make)});
  }
  const auto points = source->once<PointColumns>(
      "volume_scorer/columns", [&] { return std::make_shared<PointColumns>(source->points()); });
  return {[bound = std::move(bound), points,
           min_points = options_.min_points](const RigidTransform& T_target_source) {
            OccupiedVolume sum;
            for (const BoundLattice& lattice : bound) {
              const std::int64_t leaves = lattice.leaves(*points, T_target_source, min_points);
              const double leaf_size_m = lattice.lattice.grid.leaf_size_m();
              sum.m3 += OccupiedVolume::of_leaves(leaves, leaf_size_m).m3;
              sum.leaves += leaves;
            }
            return OccupiedVolume{sum.m3 / static_cast<double>(bound.size()), sum.leaves};
          },
          Poses::in_parallel};
}

}  // namespace croon
