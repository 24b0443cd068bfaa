#include "framework/calibration/sensor_views.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_set>

#include "framework/base/rng.hpp"
#include "framework/base/statistics.hpp"
#include "framework/base/text.hpp"
#include "framework/spatial/evenly_spaced.hpp"
#include "framework/spatial/ground_candidates.hpp"

namespace croon {
namespace {

/// Minimum height of points above the ground.
constexpr float kAboveGround_m = 0.3F;

/// Maximum number of points from which extents are computed.
constexpr int kSampled = 5000;

/// The index of the half-metre cube that contains a point; std::nullopt if it is too far away.
std::optional<std::int64_t> cube_of(const Eigen::Vector3f& point) {
  constexpr float kCube_m = 0.5F;
  constexpr std::int64_t kHalfAxis = 1 << 19, kAxis = 2 * kHalfAxis;
  const Eigen::Vector3f cube = (point / kCube_m).array().floor();
  if (!(cube.cwiseAbs().maxCoeff() < static_cast<float>(kHalfAxis))) return std::nullopt;
  return (static_cast<std::int64_t>(cube.x()) * kAxis + static_cast<std::int64_t>(cube.y())) *
             kAxis +
         static_cast<std::int64_t>(cube.z());
}

/// One point per cube.
Points thinned(const Points& points) {
  constexpr int kThinned = 20000;
  std::unordered_set<std::int64_t> cubes;
  Points thinned;
  for (const Eigen::Vector3f& point : evenly_spaced(points, kThinned)) {
    const auto cube = cube_of(point);
    if (cube && cubes.insert(*cube).second) thinned.push_back(point);
  }
  return thinned;
}

/// The centre of a robust range of values, and half its width.
struct Extent {
  double middle = 0.0, half = 0.0;
};

Extent extent_of(const Points& points, int axis) {
  constexpr double kTail = 0.12;
  std::vector<double> values;
  for (const Eigen::Vector3f& point : points) values.push_back(static_cast<double>(point(axis)));
  if (values.empty()) return {};
  const double low = percentile(values, kTail), high = percentile(values, 1.0 - kTail);
  return {(low + high) / 2.0, (high - low) / 2.0};
}

/// Minimum distance from a sensor; nearer points may be on the car itself.
constexpr float kOwnBody_m = 2.5F;

/// The position along `axis` of the section in which the smaller of the two clouds' point counts is
/// largest.
double section_centre_m(const ShownPoints& shown, const CloudView& top, int axis,
                        double thickness_m) {
  const auto counts_of = [&](const Points& points) {
    std::map<int, int> counts;
    for (const Eigen::Vector3f& point : points) {
      const bool is_in_view = std::abs(point.x() - top.centre_m.x()) < top.half_width_m &&
                              std::abs(point.y() - top.centre_m.y()) < top.half_height_m;
      if (is_in_view) ++counts[static_cast<int>(std::floor(point(axis) / thickness_m))];
    }
    return counts;
  };
  std::map<int, int> of_reference = counts_of(shown.reference);
  int best = 0;
  int index = static_cast<int>(std::floor(top.centre_m(axis) / thickness_m));
  for (const auto& [i, count] : counts_of(shown.sensor)) {
    const int both = std::min(count, of_reference[i]);
    if (both <= best) continue;
    best = both;
    index = i;
  }
  return (index + 0.5) * thickness_m;
}

/// The section seen from `from`, at the scale of `top`.
PictureRow section(const CloudView& top, ViewFrom from, const ShownPoints& shown, bool has_ground) {
  constexpr double kThickness_m = 1.0;
  CloudView view = top;
  view.from = from;
  view.half_height_m = kSectionHeight_px * top.pixel_m / 2.0;
  view.half_depth_m = kThickness_m / 2.0;
  const int axis = view.axes().z();
  view.centre_m(axis) = section_centre_m(shown, top, axis, kThickness_m);
  const double below_ground_m = 0.2 * view.half_height_m;
  view.centre_m.z() = has_ground ? view.half_height_m - below_ground_m
                                 : extent_of(evenly_spaced(shown.sensor, kSampled), 2).middle;
  return {view, std::string(from == ViewFrom::front ? "from the front" : "from the side") +
                    ": section 1 m thick at " + (axis == 0 ? "x" : "y") + " = " +
                    fixed_number(view.centre_m(axis), 1) + " m"};
}

}  // namespace

LevelFrame level_frame(const Points& points) {
  // A plane steeper than 60° in the sensor's frame may be a wall.
  constexpr double kMinCosine = 0.5;
  GroundCandidateOptions options;
  options.planes = 4;
  Rng rng(StreamKey(1).with("level_frame"));
  for (const GroundCandidate& candidate : ground_candidates(thinned(points), options, rng)) {
    if (std::abs(candidate.plane.normal.z()) < kMinCosine) continue;
    LevelFrame level{{}, true};
    level.T_level_reference.rotation =
        rotation_between(candidate.plane.normal, Eigen::Vector3d::UnitZ());
    level.T_level_reference.translation.z() = candidate.plane.offset_m;
    return level;
  }
  return {};
}

Points above_ground(const Points& points, const LevelFrame& level) {
  constexpr double kFew = 0.05;
  if (!level.has_ground) return points;
  Points above;
  for (const Eigen::Vector3f& point : points) {
    if (point.z() > kAboveGround_m) above.push_back(point);
  }
  const bool is_few = static_cast<double>(above.size()) < kFew * static_cast<double>(points.size());
  return is_few ? points : above;
}

ShownPoints shown_points(const Points& reference, const Points& sensor,
                         const Eigen::Vector3f& reference_origin_m,
                         const Eigen::Vector3f& sensor_origin_m) {
  const auto away = [&](const Points& points) {
    Points kept;
    for (const Eigen::Vector3f& point : points) {
      const bool is_away = (point - reference_origin_m).norm() > kOwnBody_m &&
                           (point - sensor_origin_m).norm() > kOwnBody_m;
      if (is_away) kept.push_back(point);
    }
    return kept;
  };
  ShownPoints shown{away(reference), away(sensor), {}};
  std::unordered_set<std::int64_t> cubes;
  for (const Eigen::Vector3f& point : shown.reference) {
    if (const auto cube = cube_of(point)) cubes.insert(*cube);
  }
  for (const Eigen::Vector3f& point : shown.sensor) {
    const auto cube = cube_of(point);
    if (cube && cubes.count(*cube) > 0) shown.shared.push_back(point);
  }
  return shown;
}

std::array<PictureRow, 3> rows_of(const ShownPoints& shown, bool has_ground) {
  constexpr double kMinHalfWidth_m = 4.0, kMaxHalfWidth_m = 16.0;
  constexpr std::size_t kMinShared = 200;
  const Points sample =
      evenly_spaced(shown.shared.size() >= kMinShared ? shown.shared : shown.sensor, kSampled);
  const Extent x = extent_of(sample, 0), y = extent_of(sample, 1);
  constexpr double kAspect = static_cast<double>(kPanelWidth_px) / kTopHeight_px;
  CloudView top;
  top.half_width_m =
      std::clamp(std::max(x.half, y.half * kAspect), kMinHalfWidth_m, kMaxHalfWidth_m);
  top.half_height_m = top.half_width_m / kAspect;
  top.pixel_m = 2.0 * top.half_width_m / kPanelWidth_px;
  top.centre_m = {x.middle, y.middle, 0.0};
  return {PictureRow{top, has_ground ? "from above, without the ground" : "from above", false},
          section(top, ViewFrom::front, shown, has_ground),
          section(top, ViewFrom::side, shown, has_ground)};
}

}  // namespace croon
