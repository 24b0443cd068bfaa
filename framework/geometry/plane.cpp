#include "framework/geometry/plane.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/base/error.hpp"

namespace croon {
namespace {

/// The points from which planes are drawn and on which inliers are counted.
class Sample {
 public:
  /// `count` points of the cloud, drawn without replacement; all points of a smaller cloud.
  Sample(const Points& cloud, int count, Rng& rng) : points_(cloud) {
    const std::size_t size = std::min(cloud.size(), static_cast<std::size_t>(count));
    // The front of a Fisher-Yates shuffle. Not every n-th point: the rings of a LiDAR alternate.
    for (std::size_t i = 0; i < size && size < points_.size(); ++i) {
      std::swap(points_[i], points_[i + rng.below(points_.size() - i)]);
    }
    points_.resize(size);
    for (const Eigen::Vector3f& point : points_) {
      x_.push_back(point.x());
      y_.push_back(point.y());
      z_.push_back(point.z());
    }
  }

  /// The number of points within `distance_m` of the plane. Axis by axis, so that the compiler can
  /// vectorise the loop.
  int count_within(const Plane& plane, double distance_m) const {
    const Eigen::Vector3f n = plane.normal.cast<float>();
    const float a = n.x(), b = n.y(), c = n.z();
    const float d = static_cast<float>(plane.offset_m);
    const float bound = static_cast<float>(distance_m);
    int count = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      count += std::abs(a * x_[i] + b * y_[i] + c * z_[i] + d) <= bound ? 1 : 0;
    }
    return count;
  }

  /// The plane through three points drawn at random; std::nullopt if they are collinear.
  std::optional<Plane> draw_plane(Rng& rng) const {
    constexpr double kMinSine = 1e-3;
    Eigen::Vector3d p[3];
    for (Eigen::Vector3d& point : p) point = points_[rng.below(points_.size())].cast<double>();
    const Eigen::Vector3d u = p[1] - p[0];
    const Eigen::Vector3d v = p[2] - p[0];
    const Eigen::Vector3d across = u.cross(v);
    if (!(across.norm() > kMinSine * u.norm() * v.norm())) return std::nullopt;
    const Eigen::Vector3d normal = across.normalized();
    return Plane{normal, -normal.dot(p[0])};
  }

  const Points& points() const { return points_; }

 private:
  Points points_;
  std::vector<float> x_, y_, z_;
};

/// Refits the plane to its inliers as long as that increases their number.
void optimise(const Sample& sample, const PlaneRansacOptions& options, Plane& plane, int& count) {
  for (int round = 0; round < options.local_rounds; ++round) {
    const Plane fitted =
        fit_plane(sample.points(), points_within(sample.points(), plane, options.threshold_m));
    const int fitted_count = sample.count_within(fitted, options.threshold_m);
    if (fitted_count <= count) return;
    plane = fitted;
    count = fitted_count;
  }
}

/// `log(1 - p) / log(1 - w^3)`: the number of draws after which, with probability p, one has
/// consisted of three points of a plane that contains the fraction w of the points.
double iterations_for(double confidence, int inliers, std::size_t points) {
  const double share = static_cast<double>(inliers) / static_cast<double>(points);
  return std::log1p(-confidence) / std::log1p(-share * share * share);
}

}  // namespace

Plane fit_plane(const Points& cloud, const std::vector<int>& indices) {
  if (indices.size() < 3) throw StageError("a plane needs three points");
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int i : indices) mean += cloud[i].cast<double>();
  mean /= static_cast<double>(indices.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const int i : indices) {
    const Eigen::Vector3d offset = cloud[i].cast<double>() - mean;
    scatter += offset * offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d variances = solver.eigenvalues();
  if (!(variances(1) > 1e-12 * variances(2))) throw StageError("the points lie on one line");
  const Eigen::Vector3d normal = solver.eigenvectors().col(0).normalized();
  return {normal, -normal.dot(mean)};
}

std::vector<int> points_within(const Points& cloud, const Plane& plane, double distance_m) {
  std::vector<int> indices;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (std::abs(plane.signed_distance(cloud[i].cast<double>())) <= distance_m) {
      indices.push_back(static_cast<int>(i));
    }
  }
  return indices;
}

Plane plane_ransac(const Points& cloud, const PlaneRansacOptions& options, Rng& rng) {
  if (cloud.size() < 3) throw StageError("a plane needs three points");
  const Sample sample(cloud, options.max_points, rng);
  std::optional<Plane> best;
  int max_count = 0;
  double iterations = options.max_iterations;
  for (int i = 0; i < iterations; ++i) {
    const std::optional<Plane> drawn = sample.draw_plane(rng);
    if (!drawn) continue;
    const int count = sample.count_within(*drawn, options.threshold_m);
    if (count <= max_count) continue;
    best = drawn;
    max_count = count;
    optimise(sample, options, *best, max_count);
    iterations =
        std::min(iterations, iterations_for(options.confidence, max_count, sample.points().size()));
  }
  if (!best) throw StageError("the points lie on one line");
  return *best;
}

}  // namespace croon
