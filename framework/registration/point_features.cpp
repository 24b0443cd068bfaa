#include "framework/registration/point_features.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/base/angles.hpp"

namespace croon {
namespace {

constexpr int kBins = 11;
constexpr int kAngles = 3;
using Shares = std::array<double, kAngles * kBins>;

/// The bin of a fraction in [0, 1] of an angle's range.
int bin_of(double share) { return std::clamp(static_cast<int>(share * kBins), 0, kBins - 1); }

/// The bins of the three angles between two points with normals (equation 1). Returns false if the
/// points or the directions coincide.
bool pair_bins(const Eigen::Vector3d& offset, Eigen::Vector3d first, Eigen::Vector3d second,
               std::array<int, kAngles>& bins) {
  const double distance_m = offset.norm();
  if (!(distance_m > 0.0)) return false;
  Eigen::Vector3d along = offset / distance_m;
  // The source of the pair is the point whose normal is closer to the line between them.
  if (std::abs(first.dot(along)) < std::abs(second.dot(along))) {
    std::swap(first, second);
    along = -along;
  }
  const Eigen::Vector3d across = first.cross(along);
  const double sine = across.norm();
  if (!(sine > 1e-6)) return false;
  const Eigen::Vector3d v = across / sine;
  const Eigen::Vector3d w = first.cross(v);
  const double theta_rad = std::atan2(w.dot(second), first.dot(second));
  bins = {bin_of(0.5 * (v.dot(second) + 1.0)), bin_of(0.5 * (first.dot(along) + 1.0)),
          bin_of(0.5 * (theta_rad / kPi + 1.0))};
  return true;
}

/// A cloud with normals, and the neighbours that describe each point.
struct Surface {
  Points points;
  Points normals;
  std::vector<std::vector<Neighbour>> neighbours;  ///< Without the point itself.
};

Surface surface_of(const Cloud& cloud, const FeatureOptions& options) {
  const Normals& all = cloud.normals(options.normal_neighbours);
  Surface surface;
  for (std::size_t i = 0; i < cloud.points().size(); ++i) {
    const Eigen::Vector3f normal = all.at(static_cast<int>(i)).normal;
    if (normal.isZero()) continue;
    surface.points.push_back(cloud.points()[i]);
    surface.normals.push_back(normal);
  }
  if (surface.points.empty()) return surface;
  const KdTree tree(surface.points);
  const auto radius_m2 = static_cast<float>(options.radius_m * options.radius_m);
  surface.neighbours.resize(surface.points.size());
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    std::vector<Neighbour>& near = surface.neighbours[i];
    tree.nearest(surface.points[i], options.max_neighbours + 1, near);
    near.erase(std::remove_if(near.begin(), near.end(),
                              [&](const Neighbour& neighbour) {
                                return neighbour.index == static_cast<int>(i) ||
                                       neighbour.squared_distance_m2 > radius_m2;
                              }),
               near.end());
    // Sums over neighbours are in the order of the points, not in that of the search.
    std::sort(near.begin(), near.end(),
              [](const Neighbour& a, const Neighbour& b) { return a.index < b.index; });
  }
  return surface;
}

/// The histogram over the pairs of a point and each of its neighbours, normalised to 1 per angle
/// (simplified point feature histogram).
Shares simplified(const Surface& surface, std::size_t index) {
  Shares shares{};
  int pairs = 0;
  std::array<int, kAngles> bins{};
  for (const Neighbour& neighbour : surface.neighbours[index]) {
    const Eigen::Vector3f offset = surface.points[neighbour.index] - surface.points[index];
    if (!pair_bins(offset.cast<double>(), surface.normals[index].cast<double>(),
                   surface.normals[neighbour.index].cast<double>(), bins)) {
      continue;
    }
    for (int k = 0; k < kAngles; ++k) shares[k * kBins + bins[k]] += 1.0;
    ++pairs;
  }
  for (double& share : shares) share /= std::max(1, pairs);
  return shares;
}

/// Equation 3: a point's histogram and the mean of its neighbours', weighted by inverse distance.
Shares weighted(const Surface& surface, const std::vector<Shares>& simple, std::size_t index) {
  Shares around{};
  double weights = 0.0;
  for (const Neighbour& neighbour : surface.neighbours[index]) {
    if (!(neighbour.squared_distance_m2 > 0.0F)) continue;
    const double weight = 1.0 / std::sqrt(static_cast<double>(neighbour.squared_distance_m2));
    for (std::size_t k = 0; k < around.size(); ++k) {
      around[k] += weight * simple[static_cast<std::size_t>(neighbour.index)][k];
    }
    weights += weight;
  }
  Shares shares = simple[index];
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (weights > 0.0) shares[k] = 0.5 * (shares[k] + around[k] / weights);
  }
  return shares;
}

FeatureHistogram whole_numbers(const Shares& shares) {
  constexpr double kScale = 1000.0;
  FeatureHistogram histogram{};
  for (std::size_t k = 0; k < shares.size(); ++k) {
    histogram[k] = static_cast<std::int16_t>(std::lround(kScale * std::sqrt(shares[k])));
  }
  return histogram;
}

int squared_distance(const FeatureHistogram& a, const FeatureHistogram& b) {
  int sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const int difference = a[k] - b[k];
    sum += difference * difference;
  }
  return sum;
}

/// The histogram of a point on a plane: all normals are parallel, and perpendicular to all lines.
FeatureHistogram plane_histogram() {
  Shares shares{};
  for (int k = 0; k < kAngles; ++k) shares[k * kBins + kBins / 2] = 1.0;
  return whole_numbers(shares);
}

/// Indices of the `count` histograms that differ most from a plane's, in their order.
std::vector<std::size_t> most_distinct(const std::vector<FeatureHistogram>& histograms,
                                       std::size_t count) {
  const FeatureHistogram plane = plane_histogram();
  std::vector<int> distances;
  for (const FeatureHistogram& histogram : histograms) {
    distances.push_back(squared_distance(histogram, plane));
  }
  std::vector<std::size_t> order(histograms.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return distances[a] > distances[b]; });
  if (order.size() > count) order.resize(count);
  std::sort(order.begin(), order.end());
  return order;
}

std::vector<double> ranges_of(const PointFeatures& features) {
  std::vector<double> ranges_m;
  for (const Eigen::Vector3f& point : features.points) {
    ranges_m.push_back(point.cast<double>().norm());
  }
  return ranges_m;
}

/// The features most similar to one feature; in case of ties those that were added first.
class MostSimilar {
 public:
  explicit MostSimilar(int count) : count_(static_cast<std::size_t>(count)) {}
  void add(int index, int distance) {
    if (distances_.size() == count_) {
      if (distance >= distances_.back()) return;
      distances_.pop_back();
      indices_.pop_back();
    }
    const auto at = std::upper_bound(distances_.begin(), distances_.end(), distance);
    indices_.insert(indices_.begin() + (at - distances_.begin()), index);
    distances_.insert(at, distance);
  }
  /// The indices of these features, most similar first.
  const std::vector<int>& indices() const { return indices_; }

 private:
  std::size_t count_;
  std::vector<int> distances_;
  std::vector<int> indices_;
};

}  // namespace

PointFeatures point_features(const Cloud& cloud, const FeatureOptions& options) {
  PointFeatures features;
  const Surface surface = surface_of(cloud, options);
  if (surface.points.empty()) return features;
  std::vector<Shares> simple;
  for (std::size_t i = 0; i < surface.points.size(); ++i) simple.push_back(simplified(surface, i));
  std::vector<FeatureHistogram> histograms;
  std::vector<std::size_t> described;
  constexpr std::size_t kMinNeighbours = 5;  // Fewer neighbours do not describe a surface.
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    if (surface.neighbours[i].size() < kMinNeighbours) continue;
    histograms.push_back(whole_numbers(weighted(surface, simple, i)));
    described.push_back(i);
  }
  if (histograms.empty()) return features;
  for (const std::size_t i :
       most_distinct(histograms, static_cast<std::size_t>(options.max_features))) {
    features.points.push_back(surface.points[described[i]]);
    features.normals.push_back(surface.normals[described[i]]);
    features.histograms.push_back(histograms[i]);
  }
  return features;
}

std::vector<FeatureMatch> mutual_matches(const PointFeatures& target, const PointFeatures& source,
                                         const MatchOptions& options) {
  const std::vector<double> target_ranges_m = ranges_of(target);
  const std::vector<double> source_ranges_m = ranges_of(source);
  std::vector<MostSimilar> of_target(target.points.size(), MostSimilar(options.candidates));
  std::vector<MostSimilar> of_source(source.points.size(), MostSimilar(options.candidates));
  for (std::size_t i = 0; i < target.points.size(); ++i) {
    for (std::size_t j = 0; j < source.points.size(); ++j) {
      if (std::abs(target_ranges_m[i] - source_ranges_m[j]) > options.max_sensor_distance_m)
        continue;
      const int distance = squared_distance(target.histograms[i], source.histograms[j]);
      of_target[i].add(static_cast<int>(j), distance);
      of_source[j].add(static_cast<int>(i), distance);
    }
  }
  std::vector<FeatureMatch> matches;
  for (std::size_t i = 0; i < of_target.size(); ++i) {
    for (const int j : of_target[i].indices()) {
      const std::vector<int>& back = of_source[static_cast<std::size_t>(j)].indices();
      if (std::find(back.begin(), back.end(), static_cast<int>(i)) != back.end()) {
        matches.push_back({static_cast<int>(i), j});
      }
    }
  }
  return matches;
}

}  // namespace croon
