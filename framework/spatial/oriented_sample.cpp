#include "framework/spatial/oriented_sample.hpp"

#include <array>
#include <set>

#include "framework/spatial/kd_tree.hpp"
#include "framework/spatial/leaf_grid.hpp"
#include "framework/spatial/normals.hpp"

namespace croon {
namespace {

PointCloud first_points(const PointCloud& cloud, double leaf_size_m) {
  const LeafGrid grid(leaf_size_m);
  std::set<std::array<int, 3>> leaves;
  PointCloud points;
  for (const Eigen::Vector3f& point : cloud) {
    const Eigen::Vector3i leaf = grid.leaf_of(point.cast<double>());
    if (leaves.insert({leaf.x(), leaf.y(), leaf.z()}).second) points.push_back(point);
  }
  return points;
}

}  // namespace

OrientedPoints oriented_sample(const PointCloud& cloud, double leaf_size_m, int neighbours) {
  OrientedPoints oriented;
  const PointCloud points = first_points(cloud, leaf_size_m);
  if (points.empty()) return oriented;
  const KdTree tree(points);
  const Normals normals(points, tree, neighbours);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f normal = normals.at(static_cast<int>(i)).normal;
    if (normal.isZero()) continue;
    oriented.points.push_back(points[i]);
    oriented.normals.push_back(normal);
  }
  return oriented;
}

}  // namespace croon
