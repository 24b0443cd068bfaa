#include "framework/spatial/normals.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <set>
#include <vector>

#include "framework/spatial/kd_tree.hpp"
#include "framework/spatial/leaf_grid.hpp"

namespace croon {
namespace {

/// Rounds offsets within a radius to 21 bits, so that sums of their products are exact: double
/// precision has 53 bits, which leaves room for 2^11 products.
class OffsetRounding {
 public:
  explicit OffsetRounding(float radius) {
    constexpr int kBits = 21, kSinglePrecision = 24;
    int exponent = 0;
    std::frexp(radius, &exponent);
    // A float of this size cannot represent anything below the radius over 2^21.
    shift_ = std::ldexp(1.5F, exponent - kBits + kSinglePrecision - 1);
  }
  double operator()(float offset) const { return (offset + shift_) - shift_; }

 private:
  float shift_;
};

/// The distance of the farthest neighbour, m.
float radius_m(const std::vector<Neighbour>& neighbours) {
  float farthest_m2 = 0.0F;
  for (const Neighbour& neighbour : neighbours) {
    farthest_m2 = std::max(farthest_m2, neighbour.squared_distance_m2);
  }
  return std::sqrt(farthest_m2);
}

/// The covariance of the neighbours, summed relative to `centre` so that no digits are lost far
/// from the sensor. The sums are exact, so the order of the neighbours does not matter.
Eigen::Matrix3d covariance(const Points& points, const Eigen::Vector3f& centre,
                           const std::vector<Neighbour>& neighbours, float radius_m) {
  const OffsetRounding rounded(radius_m);
  double x = 0.0, y = 0.0, z = 0.0, xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  for (const Neighbour& neighbour : neighbours) {
    const Eigen::Vector3f offset = points[neighbour.index] - centre;
    const double dx = rounded(offset.x()), dy = rounded(offset.y()), dz = rounded(offset.z());
    x += dx;
    y += dy;
    z += dz;
    xx += dx * dx;
    xy += dx * dy;
    xz += dx * dz;
    yy += dy * dy;
    yz += dy * dz;
    zz += dz * dz;
  }
  Eigen::Matrix3d products;
  products << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const double count = static_cast<double>(neighbours.size());
  const Eigen::Vector3d mean = Eigen::Vector3d(x, y, z) / count;
  return products / count - mean * mean.transpose();
}

/// Predicts the radius of a point's neighbourhood from that of the previous point: consecutive
/// queries are mostly near each other, and the old radius plus the distance between the points
/// contains as many neighbours. A radius from another cloud costs time but changes no result.
class ExpectedRadius {
 public:
  /// In metres; 0 if unknown.
  float at(const Eigen::Vector3f& point) const {
    return radius_m_ > 0.0F ? radius_m_ + (point - last_).norm() : 0.0F;
  }
  void set(const Eigen::Vector3f& point, float radius_m) {
    last_ = point;
    constexpr float kMoreThanRounding = 1.001F;
    radius_m_ = kMoreThanRounding * radius_m;
  }

 private:
  Eigen::Vector3f last_ = Eigen::Vector3f::Zero();
  float radius_m_ = 0.0F;
};

Points first_points(const Points& cloud, double leaf_size_m) {
  const LeafGrid grid(leaf_size_m);
  std::set<LeafKey> leaves;
  Points points;
  for (const Eigen::Vector3f& point : cloud) {
    const LeafKey leaf = leaf_key(grid.leaf_of(point.cast<double>()));
    if (leaves.insert(leaf).second) points.push_back(point);
  }
  return points;
}

}  // namespace

Normals::Normals(const Points& points, const KdTree& tree, int neighbours)
    : points_(points),
      tree_(tree),
      neighbours_(neighbours),
      states_(new std::atomic<unsigned char>[points.size()]),
      shapes_(points.size()) {
  for (std::size_t i = 0; i < points.size(); ++i)
    states_[i].store(kEmpty, std::memory_order_relaxed);
}

LocalShape Normals::first_at(int index) const {
  std::atomic<unsigned char>& state = states_[index];
  const LocalShape shape = computed(index);
  unsigned char expected = kEmpty;
  if (state.compare_exchange_strong(expected, kBeingWritten, std::memory_order_acq_rel)) {
    shapes_[index] = shape;
    state.store(kReady, std::memory_order_release);
  }
  return shape;
}

LocalShape Normals::computed(int index) const {
  thread_local std::vector<Neighbour> neighbours;
  thread_local ExpectedRadius expected;
  const Eigen::Vector3f& point = points_[index];
  tree_.nearest(point, neighbours_, neighbours, expected.at(point));
  const float radius = radius_m(neighbours);
  expected.set(point, radius);
  LocalShape shape;
  if (neighbours.size() < 3) return shape;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance(points_, point, neighbours, radius));
  const Eigen::Vector3d variances = solver.eigenvalues().cwiseMax(0.0);
  // Collinear neighbours have no normal; the closed form is accurate to about 1e-8 of the maximum
  // eigenvalue.
  if (!(variances(1) > 1e-6 * variances(2))) return shape;
  const Eigen::Vector3f normal = solver.eigenvectors().col(0).normalized().cast<float>();
  shape.normal = normal.dot(point) > 0.0F ? Eigen::Vector3f(-normal) : normal;
  shape.surface_variation = static_cast<float>(variances(0) / variances.sum());
  shape.length_m = static_cast<float>(std::sqrt(variances(2)));
  shape.breadth_m = static_cast<float>(std::sqrt(variances(1)));
  return shape;
}

OrientedPoints oriented_sample(const Points& cloud, double leaf_size_m, int neighbours) {
  OrientedPoints oriented;
  const Points points = first_points(cloud, leaf_size_m);
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
