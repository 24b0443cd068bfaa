#include "framework/calibration/ground_pose.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/geometry/plane.hpp"
#include "framework/spatial/evenly_spaced.hpp"
#include "framework/spatial/ground_candidates.hpp"

namespace croon {
namespace {

constexpr double kMaxGroundRange_m = 15.0;
constexpr double kCell_m = 1.0;
constexpr int kMinCellPoints = 3;
constexpr std::size_t kBlocks = 8;
constexpr std::size_t kMinCells = 40;

/// One point per cube, so that numbers of points measure area.
Points one_per_cube(const Points& points) {
  constexpr double kCube_m = 0.25;
  constexpr int kMaxPoints = 60000;
  std::set<std::array<long, 3>> taken;
  Points thinned;
  for (const Eigen::Vector3f& point : evenly_spaced(points, kMaxPoints)) {
    std::array<long, 3> cube{};
    for (int i = 0; i < 3; ++i) cube.at(i) = std::lround(std::floor(point(i) / kCube_m));
    if (taken.insert(cube).second) thinned.push_back(point);
  }
  return thinned;
}

/// The ground plane, with its normal towards the sensor; std::nullopt if there is none.
std::optional<Plane> rough_ground(const Points& points, Rng& rng) {
  constexpr double kMinCosTilt = 0.5;
  const std::vector<GroundCandidate> candidates =
      ground_candidates(one_per_cube(points), GroundCandidateOptions{}, rng);
  // The ceiling of a room is as good a plane as its floor, but an upright sensor is more likely.
  constexpr double kMaxGap = 0.15;
  std::optional<Plane> upside_down;
  double upside_down_score = 0.0;
  for (const GroundCandidate& candidate : candidates) {
    const double up = candidate.plane.normal.z();
    if (std::abs(up) < kMinCosTilt) continue;
    if (up > 0.0 && (!upside_down || candidate.score >= upside_down_score - kMaxGap)) {
      return candidate.plane;
    }
    if (up < 0.0 && !upside_down) {
      upside_down = candidate.plane;
      upside_down_score = candidate.score;
    }
  }
  return upside_down;
}

/// The ground relative to a rough plane: one point per square cell, ordered by direction.
struct GroundCells {
  Eigen::Matrix3d R_level_sensor;  ///< z is along the normal of the rough plane.
  std::vector<Eigen::Vector3d> points;
};

/// The means of the ground points in each cell, in a frame whose z axis is the plane's normal.
GroundCells ground_cells(const Points& points, const Plane& plane, double threshold_m) {
  GroundCells cells;
  cells.R_level_sensor = rotation_between(plane.normal, Eigen::Vector3d::UnitZ());
  struct Sum {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
  };
  std::map<std::pair<long, long>, Sum> sums;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d level = cells.R_level_sensor * point.cast<double>();
    if (std::abs(level.z() + plane.offset_m) > threshold_m) continue;
    if (level.head<2>().norm() > kMaxGroundRange_m) continue;
    Sum& sum = sums[{std::lround(std::floor(level.x() / kCell_m)),
                     std::lround(std::floor(level.y() / kCell_m))}];
    sum.sum += level;
    ++sum.count;
  }
  for (const auto& [cell, sum] : sums) {
    if (sum.count >= kMinCellPoints) cells.points.push_back(sum.sum / sum.count);
  }
  std::stable_sort(cells.points.begin(), cells.points.end(), [](const auto& a, const auto& b) {
    return std::atan2(a.y(), a.x()) < std::atan2(b.y(), b.x());
  });
  return cells;
}

/// The block of neighbouring directions to which cell `i` of `count` belongs.
std::size_t block_of(std::size_t i, std::size_t count) { return i * kBlocks / count; }

/// (a, b, c) of the plane z = a x + b y + c through the majority of the cells: the road rather than
/// the pavement. std::nullopt if they are collinear.
std::optional<Eigen::Vector3d> most_common_heights(const std::vector<Eigen::Vector3d>& cells,
                                                   Rng& rng) {
  Points points;
  for (const Eigen::Vector3d& cell : cells) points.push_back(cell.cast<float>());
  PlaneRansacOptions options;
  options.threshold_m = 0.04;
  try {
    const Plane plane = plane_ransac(points, options, rng);
    return Eigen::Vector3d(-plane.normal.x(), -plane.normal.y(), -plane.offset_m) /
           plane.normal.z();
  } catch (const StageError&) {
    return std::nullopt;
  }
}

/// The plane `abc` refitted to all cells except the block `without` (Tukey's biweight).
Eigen::Vector3d fitted_heights(const std::vector<Eigen::Vector3d>& cells, Eigen::Vector3d abc,
                               std::size_t without) {
  constexpr int kRounds = 10;
  constexpr double kScale_m = 0.06;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (block_of(i, cells.size()) == without) continue;
      const Eigen::Vector3d row(cells[i].x(), cells[i].y(), 1.0);
      const double residual = (cells[i].z() - row.dot(abc)) / kScale_m;
      const double root = std::max(0.0, 1.0 - residual * residual);
      A += root * root * row * row.transpose();
      b += root * root * cells[i].z() * row;
    }
    abc = A.ldlt().solve(b);
  }
  return abc;
}

/// The variances of roll, pitch and height that a jackknife misses if the ground is visible on one
/// side of the sensor only, where it may all be crossfall, pavement or verge.
Eigen::Vector3d one_sided_variance(const std::vector<Eigen::Vector3d>& cells) {
  constexpr double kTilt_rad = rad_from_deg(4.0);
  Eigen::Vector2d directions = Eigen::Vector2d::Zero(), mean_m = Eigen::Vector2d::Zero();
  for (const Eigen::Vector3d& cell : cells) {
    directions += cell.head<2>().normalized() / static_cast<double>(cells.size());
    mean_m += cell.head<2>() / static_cast<double>(cells.size());
  }
  // The squared norm is 0 if the ground surrounds the sensor, 1 if it lies in one direction.
  const double tilt_rad = kTilt_rad * directions.squaredNorm();
  const Eigen::Vector3d deviations(tilt_rad, tilt_rad, tilt_rad * mean_m.norm());
  return deviations.cwiseAbs2();
}

/// (roll, pitch, height) of the sensor above the plane `abc` in the level frame.
Eigen::Vector3d pose_over(const Eigen::Vector3d& abc, const Eigen::Matrix3d& R_level_sensor) {
  const double length = std::sqrt(1.0 + abc.head<2>().squaredNorm());
  const Eigen::Vector3d normal =
      R_level_sensor.transpose() * Eigen::Vector3d(-abc.x(), -abc.y(), 1.0) / length;
  return {std::atan2(normal.y(), normal.z()),
          std::atan2(-normal.x(), std::hypot(normal.y(), normal.z())), -abc.z() / length};
}

/// `angle_rad` plus the multiple of 2 pi that brings it nearest to `near_rad`.
double unwrapped(double angle_rad, double near_rad) {
  return near_rad + std::remainder(angle_rad - near_rad, 2.0 * kPi);
}

/// An estimate of roll, pitch and height with its variances.
struct SceneGround {
  Eigen::Vector3d value;
  Eigen::Vector3d variance;
};

std::optional<SceneGround> ground_of_scene(const Points& points, Rng& rng) {
  std::optional<Plane> plane = rough_ground(points, rng);
  if (!plane) return std::nullopt;
  constexpr double kThreshold_m = 0.2;
  const GroundCells cells = ground_cells(points, *plane, kThreshold_m);
  if (cells.points.size() < kMinCells) return std::nullopt;
  SceneGround ground;
  const std::optional<Eigen::Vector3d> start = most_common_heights(cells.points, rng);
  if (!start) return std::nullopt;
  ground.value = pose_over(fitted_heights(cells.points, *start, kBlocks), cells.R_level_sensor);
  // Jackknife: the change from leaving out each block of directions.
  ground.variance = one_sided_variance(cells.points);
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Eigen::Vector3d change =
        pose_over(fitted_heights(cells.points, *start, block), cells.R_level_sensor) - ground.value;
    for (const int i : {0, 1}) change(i) = std::remainder(change(i), 2.0 * kPi);
    ground.variance += (kBlocks - 1.0) / kBlocks * change.cwiseAbs2();
  }
  if (!ground.value.allFinite() || !ground.variance.allFinite()) return std::nullopt;
  return ground;
}

/// A mean and its variance.
struct Combined {
  double value;
  double variance;
};

/// The random-effects mean of estimates that may differ by more than their variances (DerSimonian
/// and Laird 1986).
Combined combined(const std::vector<double>& values, const std::vector<double>& variances) {
  const auto weighted = [&](double between) {
    Combined mean{0.0, 0.0};
    double weights = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double weight = 1.0 / (variances[i] + between);
      weights += weight;
      mean.value += weight * values[i];
    }
    return Combined{mean.value / weights, 1.0 / weights};
  };
  const Combined fixed = weighted(0.0);
  double q = 0.0, weights = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double weight = 1.0 / variances[i];
    q += weight * std::pow(values[i] - fixed.value, 2);
    weights += weight;
    squares += weight * weight;
  }
  const double excess = q - static_cast<double>(values.size() - 1);
  if (values.size() < 2 || excess <= 0.0) return fixed;
  return weighted(excess / (weights - squares / weights));
}

/// The mean, over all scenes, of roll, pitch or height (`of` = 0, 1, 2).
Combined combined(const std::vector<SceneGround>& scenes, int of, bool is_angle) {
  constexpr double kMinVariance = 1e-12;
  std::vector<double> values, variances;
  for (const SceneGround& scene : scenes) {
    const double value = scene.value(of);
    values.push_back(is_angle ? unwrapped(value, scenes.front().value(of)) : value);
    variances.push_back(std::max(scene.variance(of), kMinVariance));
  }
  Combined result = combined(values, variances);
  if (is_angle) result.value = std::remainder(result.value, 2.0 * kPi);
  return result;
}

/// The direction of travel in one scene.
struct SceneHeading {
  double yaw_rad;
  double variance;
};

std::optional<SceneHeading> heading_of_scene(const SceneMotionEstimate& motion,
                                             const Eigen::Matrix3d& R_road_reference) {
  constexpr double kMinSpeed_mps = 1.0;
  // Assumed maximum distance of the reference from the axle without side slip.
  constexpr double kLever_m = 2.0;
  constexpr double kMaxSlip_rad = rad_from_deg(2.0);
  // Standard deviation between a car's heading and its direction of travel, from camber and side
  // wind.
  constexpr double kScene_rad = rad_from_deg(0.2);
  const Eigen::Vector3d v = R_road_reference * motion.velocity.linear_mps;
  const double speed_mps = v.head<2>().norm();
  const Eigen::Vector3d turn = R_road_reference * motion.velocity.angular_radps;
  if (!(speed_mps >= kMinSpeed_mps)) return std::nullopt;
  const double slip_rad = std::abs(turn.z()) * kLever_m / speed_mps;
  if (!(slip_rad <= kMaxSlip_rad)) return std::nullopt;
  const Eigen::Vector3d across =
      R_road_reference.transpose() * Eigen::Vector3d(-v.y(), v.x(), 0.0) / (speed_mps * speed_mps);
  const Eigen::Matrix3d covariance = motion.covariance.bottomRightCorner<3, 3>();
  const double variance = across.dot(covariance * across);
  constexpr double kMaxStd_rad = rad_from_deg(10.0);
  if (!(variance >= 0.0) || variance > kMaxStd_rad * kMaxStd_rad) return std::nullopt;
  return SceneHeading{std::atan2(v.y(), v.x()),
                      variance + slip_rad * slip_rad + kScene_rad * kScene_rad};
}

}  // namespace

std::optional<GroundPose> ground_pose(const std::vector<const Points*>& scenes, Rng& rng) {
  std::vector<SceneGround> grounds;
  for (const Points* points : scenes) {
    if (auto ground = ground_of_scene(*points, rng)) grounds.push_back(*ground);
  }
  if (grounds.empty()) return std::nullopt;
  const Combined roll = combined(grounds, 0, true);
  const Combined pitch = combined(grounds, 1, true);
  const Combined height = combined(grounds, 2, false);
  return GroundPose{roll.value,
                    pitch.value,
                    height.value,
                    std::sqrt(roll.variance),
                    std::sqrt(pitch.variance),
                    std::sqrt(height.variance)};
}

RigidTransform road_from_reference(const GroundPose& ground) {
  return {rotation_from_rpy({ground.roll_rad, ground.pitch_rad, 0.0}), {0.0, 0.0, ground.height_m}};
}

std::optional<HeadingOfTravel> heading_of_travel(const std::vector<SceneMotionEstimate>& motion,
                                                 const std::optional<GroundPose>& ground) {
  const Eigen::Matrix3d R_road_reference =
      ground ? road_from_reference(*ground).rotation : Eigen::Matrix3d::Identity();
  std::vector<SceneHeading> headings;
  for (const SceneMotionEstimate& scene : motion) {
    if (auto heading = heading_of_scene(scene, R_road_reference)) headings.push_back(*heading);
  }
  if (headings.empty()) return std::nullopt;
  const auto is_forward = [&](const SceneHeading& heading, double yaw_rad) {
    return std::cos(heading.yaw_rad - yaw_rad) > 0.0;
  };
  const auto forwards = std::count_if(headings.begin(), headings.end(), [&](const auto& heading) {
    return is_forward(heading, headings.front().yaw_rad);
  });
  double ahead_rad = headings.front().yaw_rad;
  if (2 * forwards < static_cast<long>(headings.size())) ahead_rad += kPi;
  std::vector<double> values, variances;
  for (const SceneHeading& heading : headings) {
    const double backwards_rad = is_forward(heading, ahead_rad) ? 0.0 : kPi;
    values.push_back(unwrapped(heading.yaw_rad + backwards_rad, ahead_rad));
    variances.push_back(heading.variance);
  }
  const Combined yaw = combined(values, variances);
  return HeadingOfTravel{std::remainder(yaw.value, 2.0 * kPi), std::sqrt(yaw.variance),
                         headings.size()};
}

}  // namespace croon
