#include "test/stages/volume_scorer/scorers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "framework/spatial/leaf_grid.hpp"
#include "test/support/leaf_scorers.hpp"

namespace croon::test {

LeafOptions leaves_of(double leaf_size_m) {
  LeafOptions options;
  options.leaf_size_m = leaf_size_m;
  return options;
}

std::vector<std::pair<std::string, params::Slot<VolumeScorer>>> all_scorers(
    const LeafOptions& options) {
  std::vector<std::pair<std::string, params::Slot<VolumeScorer>>> scorers;
  for (const std::string& name : leaf_scorer_names()) {
    scorers.emplace_back(name, stage<VolumeScorer>(leaf_table().json(
                                   options, {{"type", params::value_json(name)}})));
  }
  return scorers;
}

std::shared_ptr<const Cloud> cloud_of(Points points) {
  return std::make_shared<const Cloud>(std::move(points), StreamKey(1));
}

namespace {

/// The leaves that hold at least `min_points` of the points, on a lattice with this origin.
std::set<LeafKey> occupied(const Points& points, const RigidTransform& T, double leaf_size_m,
                           const Eigen::Vector3d& origin_m, int min_points) {
  RigidTransform pose = T;
  pose.translation -= origin_m;
  std::map<LeafKey, int> counts;
  for (const Eigen::Vector3f& point : points) {
    ++counts[leaf_key(LeafGrid(leaf_size_m).leaf_of(pose * point.cast<double>()))];
  }
  std::set<LeafKey> leaves;
  for (const auto& [leaf, count] : counts) {
    if (count >= min_points) leaves.insert(leaf);
  }
  return leaves;
}

}  // namespace

std::int64_t leaves_by_set(const Points& target, const Points& source,
                           const RigidTransform& T_target_source, double leaf_size_m) {
  return volume_by_sets(target, source, T_target_source, leaves_of(leaf_size_m)).leaves;
}

OccupiedVolume volume_by_sets(const Points& target, const Points& source,
                              const RigidTransform& T_target_source, const LeafOptions& options) {
  double root = 1.2;  // Of x^4 = x + 1.
  for (int i = 0; i < 20; ++i) root -= (std::pow(root, 4) - root - 1) / (4 * std::pow(root, 3) - 1);
  OccupiedVolume volume;
  double leaf_size_m = options.leaf_size_m;
  for (int size = 0; size < options.leaf_sizes; ++size, leaf_size_m *= 2) {
    for (int k = 0; k < options.lattices; ++k) {
      Eigen::Vector3d origin_m;
      for (int axis = 0; axis < 3; ++axis) {
        const double share = k / std::pow(root, axis + 1);
        origin_m(axis) =
            leaf_size_m * (options.lattice_offset_ratio[axis] + share - std::floor(share));
      }
      std::set<LeafKey> leaves = occupied(target, {}, leaf_size_m, origin_m, options.min_points);
      leaves.merge(occupied(source, T_target_source, leaf_size_m, origin_m, options.min_points));
      const auto count = static_cast<std::int64_t>(leaves.size());
      volume.leaves += count;
      volume.m3 += static_cast<double>(count) * std::pow(leaf_size_m, 3);
    }
  }
  volume.m3 /= options.leaf_sizes * options.lattices;
  return volume;
}

void expect_equal_counts(const Points& target, const Points& source,
                         const std::vector<RigidTransform>& poses, const LeafOptions& options) {
  const auto target_cloud = cloud_of(target);
  const auto source_cloud = cloud_of(source);
  for (const auto& [name, scorer] : all_scorers(options)) {
    SCOPED_TRACE(name + ", " + leaf_table().json(options));
    const VolumeFunction volume = scorer->bind(target_cloud, source_cloud);
    for (const RigidTransform& pose : poses) {
      const OccupiedVolume occupied = volume(pose);
      const OccupiedVolume expected = volume_by_sets(target, source, pose, options);
      EXPECT_EQ(occupied.leaves, expected.leaves);
      EXPECT_DOUBLE_EQ(occupied.m3, expected.m3);
    }
  }
}

}  // namespace croon::test
