#include "test/stages/volume_scorer/scorers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "framework/params/values.hpp"
#include "framework/spatial/leaf_grid.hpp"
#include "test/support/stages.hpp"

namespace croon::test {

std::vector<std::pair<std::string, params::Slot<VolumeScorer>>> all_scorers(double leaf_size_m) {
  std::vector<std::pair<std::string, params::Slot<VolumeScorer>>> scorers;
  const std::string leaf_size = params::value_json(leaf_size_m);
  for (const std::string& name : registry().names(VolumeScorer::kKind)) {
    const std::string json = R"({"type": ")" + name + R"(", "leaf_size_m": )" + leaf_size + "}";
    scorers.emplace_back(name, stage<VolumeScorer>(json));
  }
  return scorers;
}

std::shared_ptr<const Cloud> cloud_of(Points points) {
  return std::make_shared<const Cloud>(std::move(points), StreamKey(1));
}

std::int64_t leaves_by_set(const Points& target, const Points& source,
                           const RigidTransform& T_target_source, double leaf_size_m) {
  const LeafGrid grid(leaf_size_m);
  std::set<std::array<int, 3>> leaves;
  const auto occupy = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3i leaf = grid.leaf_of(point);
    leaves.insert({leaf.x(), leaf.y(), leaf.z()});
  };
  for (const Eigen::Vector3f& point : target) occupy(point.cast<double>());
  for (const Eigen::Vector3f& point : source) occupy(T_target_source * point.cast<double>());
  return static_cast<std::int64_t>(leaves.size());
}

void expect_equal_counts(const Points& target, const Points& source,
                         const std::vector<RigidTransform>& poses, double leaf_size_m) {
  const auto target_cloud = cloud_of(target);
  const auto source_cloud = cloud_of(source);
  for (const auto& [name, scorer] : all_scorers(leaf_size_m)) {
    SCOPED_TRACE(name + ", leaf size " + std::to_string(leaf_size_m));
    const VolumeFunction volume = scorer->bind(target_cloud, source_cloud);
    for (const RigidTransform& pose : poses) {
      const OccupiedVolume occupied = volume(pose);
      EXPECT_EQ(occupied.leaves, leaves_by_set(target, source, pose, leaf_size_m));
      EXPECT_EQ(occupied.leaf_size_m, leaf_size_m);
    }
  }
}

}  // namespace croon::test
