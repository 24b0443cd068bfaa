#include "experiments/report/volume_chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

#include "experiments/report/panels.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/spatial/evenly_spaced.hpp"
#include "framework/spatial/leaf_window.hpp"

namespace croon::experiments {
namespace {

constexpr double kVolumeLeaf_m = 0.1;
// The leaves of the target are computed once, those of the source for each offset.
constexpr int kMaxTargetPoints = 100000;
constexpr int kMaxSourcePoints = 15000;
constexpr int kStepsToEachSide = 15;

/// The end of the axis of a panel, in deg or m.
double max_offset(Dof dof) { return is_rotation(dof) ? 2.0 : 0.5; }

/// The keys of the points' leaves, sorted, without duplicates; std::nullopt if a point is outside
/// the window.
std::optional<std::vector<std::uint64_t>> occupied_leaves(const LeafWindow& window,
                                                          const PointColumns& points,
                                                          const RigidTransform& T_window_points) {
  std::vector<std::uint64_t> leaves;
  leaves.reserve(points.size());
  const auto add = [&](const std::uint64_t* keys, std::size_t count) {
    leaves.insert(leaves.end(), keys, keys + count);
  };
  try {
    if (!window.for_each_block(points, T_window_points, add).empty()) return std::nullopt;
  } catch (const StageError&) {
    return std::nullopt;
  }
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

/// The axis of the volumes of all panels.
Axis volume_axis(const VolumeCurves& curves) {
  constexpr double kMinHeight_m3 = 0.1;
  std::vector<double> volumes_m3;
  for (const VolumeCurve& curve : curves) {
    std::copy_if(curve.volumes_m3.begin(), curve.volumes_m3.end(), std::back_inserter(volumes_m3),
                 [](double volume_m3) { return !std::isnan(volume_m3); });
  }
  if (volumes_m3.empty()) return round_axis(0.0, kMinHeight_m3, 4);
  const auto [low, high] = std::minmax_element(volumes_m3.begin(), volumes_m3.end());
  return round_axis(*low, std::max(*high, *low + kMinHeight_m3), 4);
}

}  // namespace

VolumeCurves volume_curves(const Points& target, const Points& source,
                           const RigidTransform& T_target_source) {
  const LeafWindow window(LeafGrid(kVolumeLeaf_m), Eigen::Vector3d::Zero());
  // With leaves along the axes, the whole ground would enter the next layer of leaves at once.
  const RigidTransform T_grid_target{rotation_from_rpy({0.4, 0.6, 0.5}), Eigen::Vector3d::Zero()};
  const double leaf_m3 = kVolumeLeaf_m * kVolumeLeaf_m * kVolumeLeaf_m;
  const auto target_leaves =
      occupied_leaves(window, PointColumns(evenly_spaced(target, kMaxTargetPoints)), T_grid_target);
  const PointColumns points(evenly_spaced(source, kMaxSourcePoints));
  const auto volume_m3 = [&](const RigidTransform& T) {
    const auto leaves = occupied_leaves(window, points, T_grid_target * T);
    if (!target_leaves || !leaves) return std::numeric_limits<double>::quiet_NaN();
    std::vector<std::uint64_t> all;
    all.reserve(target_leaves->size() + leaves->size());
    std::set_union(target_leaves->begin(), target_leaves->end(), leaves->begin(), leaves->end(),
                   std::back_inserter(all));
    return leaf_m3 * static_cast<double>(all.size());
  };
  VolumeCurves curves;
  for_each_in_parallel(curves.size(), [&](std::size_t k) {
    const auto dof = static_cast<Dof>(k);
    for (int step = -kStepsToEachSide; step <= kStepsToEachSide; ++step) {
      const double offset = max_offset(dof) * step / kStepsToEachSide;
      Vector6d move = Vector6d::Zero();
      move[static_cast<Eigen::Index>(k)] = is_rotation(dof) ? rad_from_deg(offset) : offset;
      curves[k].offsets.push_back(offset);
      curves[k].volumes_m3.push_back(volume_m3(moved(T_target_source, move)));
    }
  });
  return curves;
}

Drawing volume_chart(const VolumeCurves& curves, const std::optional<Vector6d>& truth_offset,
                     const Sheet& sheet) {
  const Axis y = volume_axis(curves);
  Sheet untitled = sheet;  // The report has a caption.
  untitled.has_title = false;
  std::vector<std::string> labels = {"occupied volume"};
  if (truth_offset) labels.emplace_back("ground truth");
  auto [grid, drawing] =
      panel_figure(untitled, "Occupied volume around the result",
                   "In m3, over the offset from the result in each degree of freedom",
                   curves.size(), is_wide(sheet) ? 3 : 2, 0.6, labels);
  const double text = sheet.small();
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const auto dof = static_cast<Dof>(k);
    const double limit = max_offset(dof);
    const Plot plot = plot_of(grid, k, {-limit, limit}, {y.low, y.high});
    for (const double tick : y.ticks) {
      plot.draw_y_tick(drawing, tick, fixed_number(tick, y.decimals), 0.5 * text);
    }
    for (const double tick : {-limit, -0.5 * limit, 0.0, 0.5 * limit, limit}) {
      plot.draw_x_tick(drawing, tick, shortest_number(tick), 1.4 * text);
    }
    // Clang 14 does not capture a structured binding by itself.
    const auto draw_upright = [&plot, &drawing = drawing](double offset, const std::string& style) {
      const double x = plot.x(offset);
      drawing.polyline({{x, plot.top}, {x, plot.top + plot.height}}, style);
    };
    draw_upright(0.0, "zero");
    draw_parts(drawing, plot, curves[k].offsets, curves[k].volumes_m3, 0);
    if (truth_offset) {
      const double truth = (*truth_offset)[static_cast<Eigen::Index>(k)];
      const double offset = is_rotation(dof) ? deg_from_rad(truth) : truth;
      if (std::abs(offset) <= limit) draw_upright(offset, "curve " + series_style(1));
    }
    draw_panel_texts(drawing, plot, kDofNames.at(k),
                     is_rotation(dof) ? "offset, deg" : "offset, m");
  }
  draw_panel_legend(drawing, grid, labels);
  return drawing;
}

}  // namespace croon::experiments
