#include "framework/registration/adaptive_voxels.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "framework/geometry/measured_points.hpp"
#include "framework/spatial/leaf_numbering.hpp"

namespace croon {
namespace {

/// A point in the common frame and in that of its sensor.
struct PlacedPoint {
  Eigen::Vector3f common;
  Eigen::Vector3f own;
  float time_s;
  float weight;
  int view;  ///< An index into the clouds.
};

/// Points sorted by cube, in the order in which points and cubes first occur. Cubes that only one
/// sensor sees have no points.
struct CubesOfPoints {
  std::vector<PlacedPoint> points;
  std::vector<LeafKey> cubes;
  std::vector<std::size_t> begins;  ///< Of each cube's points, and the end of all.
};

using Iterator = std::vector<PlacedPoint>::iterator;

class PatchSearch {
 public:
  PatchSearch(const std::vector<SensorCloud>& clouds, const VoxelOptions& options,
              std::vector<PlanePatch>& patches)
      : clouds_(clouds), options_(options), patches_(patches) {}

  /// Adds the patches of the cube around `centre` that contains these points.
  void search(Iterator begin, Iterator end, const Eigen::Vector3f& centre, double edge_m) {
    if (end - begin < options_.min_points || !is_seen_by_two(begin, end)) return;
    PointSums sums;
    // Relative to the centre, so that no digits are lost far from the sensor.
    for (Iterator point = begin; point != end; ++point) {
      sums.add((point->common - centre).cast<double>());
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> shape;
    shape.computeDirect(sums.scatter() / sums.weight);
    const Eigen::Vector3d& variances = shape.eigenvalues();
    if (variances(0) <= options_.max_thickness_ratio * variances(1)) {
      const Eigen::Vector3d mean = sums.sum / sums.weight;
      const double rms_m = std::sqrt(std::max(variances(0), 0.0));
      if (!may_be_cut(mean, shape.eigenvectors().col(0), rms_m, edge_m)) {
        add_patch(begin, end, rms_m);
      }
      return;
    }
    if (0.5 * edge_m < options_.voxels_m.back() * (1.0 - 1e-9)) return;
    cut(begin, end, centre, edge_m);
  }

 private:
  static bool is_seen_by_two(Iterator begin, Iterator end) {
    return std::any_of(begin, end,
                       [&](const PlacedPoint& point) { return point.view != begin->view; });
  }

  /// Whether the plane is within three times its RMS residual of a face of the cube, so that the
  /// face may cut its points.
  static bool may_be_cut(const Eigen::Vector3d& mean, const Eigen::Vector3d& normal, double rms_m,
                         double edge_m) {
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    return 0.5 * edge_m - std::abs(mean(axis)) < 3.0 * rms_m;
  }

  /// Searches the eight parts of a cube.
  void cut(Iterator begin, Iterator end, const Eigen::Vector3f& centre, double edge_m) {
    constexpr int kParts = 8;
    const auto part_of = [&](const PlacedPoint& point) {
      const Eigen::Vector3f& p = point.common;
      return 4 * static_cast<int>(!(p.x() < centre.x())) +
             2 * static_cast<int>(!(p.y() < centre.y())) + static_cast<int>(!(p.z() < centre.z()));
    };
    std::array<std::ptrdiff_t, kParts + 1> begins = {};
    for (Iterator point = begin; point != end; ++point) ++begins[part_of(*point) + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::array<std::ptrdiff_t, kParts + 1> places = begins;
    scratch_.assign(begin, end);
    for (const PlacedPoint& point : scratch_) *(begin + places[part_of(point)]++) = point;
    const auto quarter = static_cast<float>(0.25 * edge_m);
    for (int part = 0; part < kParts; ++part) {
      const Eigen::Vector3f towards((part & 4) != 0 ? 1.0F : -1.0F, (part & 2) != 0 ? 1.0F : -1.0F,
                                    (part & 1) != 0 ? 1.0F : -1.0F);
      search(begin + begins[part], begin + begins[part + 1], centre + quarter * towards,
             0.5 * edge_m);
    }
  }

  void add_patch(Iterator begin, Iterator end, double rms_m) {
    std::vector<PlanePatch::View> views(clouds_.size());
    std::vector<int> counts(clouds_.size());
    for (Iterator point = begin; point != end; ++point) {
      PlanePatch::View& view = views[point->view];
      ++counts[point->view];
      const Eigen::Vector3d own = point->own.cast<double>();
      const double weight = point->weight;
      view.sums.add(own, weight);
      const double time_s = point->time_s;
      if (time_s == 0.0) continue;
      view.timed.add(own, weight * time_s);
      view.timed_twice.add(own, weight * time_s * time_s);
    }
    constexpr double kMinNoise_m = 0.005;  // Standard deviation of a point across its plane.
    const double noise_m = std::max(rms_m, kMinNoise_m);
    PlanePatch patch;
    for (std::size_t k = 0; k < clouds_.size(); ++k) {
      const PlanePatch::View& view = views[k];
      const double count = counts[k];
      if (count < options_.min_sensor_points) continue;
      const double variance =
          noise_m * noise_m / count + options_.surface_std_m * options_.surface_std_m;
      const double weight = 1.0 / (variance * view.sums.weight);
      patch.views.push_back({clouds_[k].sensor, view.sums.scaled(weight), view.timed.scaled(weight),
                             view.timed_twice.scaled(weight)});
      patch.own_cost += min_eigenvalue(patch.views.back().sums.scatter());
    }
    if (patch.views.size() > 1) patches_.push_back(std::move(patch));
  }

  const std::vector<SensorCloud>& clouds_;
  const VoxelOptions& options_;
  std::vector<PlanePatch>& patches_;
  std::vector<PlacedPoint> scratch_;
};

std::vector<PlacedPoint> placed_points(const std::vector<SensorCloud>& clouds,
                                       const RigState& state, int stride) {
  std::vector<PlacedPoint> points;
  for (std::size_t view = 0; view < clouds.size(); ++view) {
    const RigidTransform& T = state.poses[clouds[view].sensor];
    const Points& own = clouds[view].cloud->points();
    const std::vector<double>& times_s = clouds[view].times_s;
    const std::vector<std::uint32_t> measured =
        measured_points(clouds[view].cloud->with_channels());
    std::optional<Twist> velocity;
    if (state.velocity && !times_s.empty()) velocity = velocity_in(T.inverse(), *state.velocity);
    for (std::size_t i = 0; i < own.size(); i += static_cast<std::size_t>(stride)) {
      const double time_s = times_s.empty() ? 0.0 : times_s.at(i);
      Eigen::Vector3d point = own[i].cast<double>();
      if (velocity) {
        point += time_s * (velocity->linear_mps + velocity->angular_radps.cross(point));
      }
      points.push_back({(T * point).cast<float>(), point.cast<float>(), static_cast<float>(time_s),
                        static_cast<float>(measured[i]), static_cast<int>(view)});
    }
  }
  return points;
}

/// Sorts points by the cubes of `grid`, to which they are shifted: a counting sort.
CubesOfPoints by_cube(const std::vector<PlacedPoint>& points, const LeafGrid& grid,
                      const Eigen::Vector3d& shift) {
  struct Cube {
    int first_view;
    bool is_seen_by_two;
    std::size_t size;
  };
  LeafNumbering numbering;
  std::vector<Cube> cubes;
  std::vector<int> number_of_point;
  number_of_point.reserve(points.size());
  for (const PlacedPoint& point : points) {
    const int number =
        numbering.number_of(leaf_key(grid.leaf_of(point.common.cast<double>() + shift)));
    number_of_point.push_back(number);
    if (number == static_cast<int>(cubes.size())) cubes.push_back({point.view, false, 0});
    cubes[number].is_seen_by_two |= point.view != cubes[number].first_view;
    ++cubes[number].size;
  }
  CubesOfPoints result = {{}, numbering.leaves(), {0}};
  for (const Cube& cube : cubes) {
    result.begins.push_back(result.begins.back() + (cube.is_seen_by_two ? cube.size : 0));
  }
  result.points.resize(result.begins.back());
  std::vector<std::size_t> places = result.begins;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int number = number_of_point[i];
    if (cubes[number].is_seen_by_two) result.points[places[number]++] = points[i];
  }
  return result;
}

}  // namespace

const params::Table<VoxelOptions>& voxel_table() {
  using O = VoxelOptions;
  static const params::Table<O> table = [] {
    params::Table<O> rows = {
        params::numbers("voxels_m", &O::voxels_m, {1e-3, 1e6},
                        "The maximum and the minimum edge of a voxel; a voxel whose points do not "
                        "form a plane is divided into eight."),
        params::number("max_thickness_ratio", &O::max_thickness_ratio, {0.0, 1.0},
                       "Maximum ratio of the variance across a plane to the middle variance of its "
                       "points."),
        params::integer("min_points", &O::min_points, {4, 1000000},
                        "Minimum number of points on a plane, over all sensors."),
        params::integer("min_sensor_points", &O::min_sensor_points, {1, 1000000},
                        "Minimum number of points of one sensor on a plane; a sensor with fewer is "
                        "ignored there."),
        params::number("surface_std_m", &O::surface_std_m, {0.0, 1e3},
                       "Standard deviation of a surface from a plane: no number of points makes a "
                       "plane more certain.")
            .formerly("surface_error_m"),
    };
    rows.require([](const O& o) { return o.voxels_m.size() == 2; },
                 "voxels_m must have two numbers");
    rows.require([](const O& o) { return o.voxels_m.front() >= o.voxels_m.back(); },
                 "the first of voxels_m must not be below the second");
    return rows;
  }();
  return table;
}

std::vector<PlanePatch> plane_patches(const std::vector<SensorCloud>& clouds, const RigState& state,
                                      int stride, const VoxelOptions& options) {
  std::vector<PlanePatch> patches;
  const std::vector<PlacedPoint> points = placed_points(clouds, state, stride);
  const LeafGrid grid(options.voxels_m.front());
  for (const double share : {0.0, 1.0 / 3.0}) {
    const Eigen::Vector3d shift = Eigen::Vector3d::Constant(share * options.voxels_m.front());
    CubesOfPoints sorted = by_cube(points, grid, shift);
    PatchSearch search(clouds, options, patches);
    for (std::size_t i = 0; i < sorted.cubes.size(); ++i) {
      const auto [x, y, z] = sorted.cubes[i];
      const Eigen::Vector3d centre =
          (Eigen::Array3d(x, y, z) + 0.5) * options.voxels_m.front() - shift.array();
      const auto begin = sorted.points.begin();
      search.search(begin + static_cast<std::ptrdiff_t>(sorted.begins[i]),
                    begin + static_cast<std::ptrdiff_t>(sorted.begins[i + 1]), centre.cast<float>(),
                    options.voxels_m.front());
    }
  }
  return patches;
}

}  // namespace croon
