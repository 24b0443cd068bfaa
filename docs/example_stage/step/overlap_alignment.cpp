#include <cmath>
#include <set>

#include "framework/base/error.hpp"
#include "framework/params/values.hpp"
#include "framework/pipeline/step_options.hpp"
#include "framework/spatial/leaf_grid.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"
#include "overlap.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  double range_m = 1.0;
  double cell_m = 0.2;
  PointSelection points = PointSelection::non_ground;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::number("range_m", &Params::range_m, {0.0, 10.0},
                     "The largest shift along x and along y, rounded to whole cells."),
      params::number("cell_m", &Params::cell_m, {0.05, 10.0}, "Edge of a cell."),
      params::choice("points", &Params::points, kPointsWords, "Which points occupy cells."),
  };
  return table;
}

/// The (x, y) indices of the cells that the points occupy, seen from above in the target frame.
using Cells = std::set<std::pair<int, int>>;

Cells occupied_cells(const Points& cloud, const RigidTransform& T_target_cloud, double cell_m) {
  const LeafGrid grid(cell_m);
  Cells cells;
  for (const Eigen::Vector3f& point : cloud) {
    const Eigen::Vector3i leaf = grid.leaf_of(T_target_cloud * point.cast<double>());
    cells.emplace(leaf.x(), leaf.y());
  }
  return cells;
}

/// How many cells of `source`, moved by (dx, dy) cells, are cells of `target`.
int common_cells(const Cells& target, const Cells& source, int dx, int dy) {
  int common = 0;
  for (const auto& [x, y] : source) common += static_cast<int>(target.count({x + dx, y + dy}));
  return common;
}

/// Tries all shifts within a range. A cell counts once, however many points it holds, so the dense
/// points near a sensor do not outweigh the others.
class OverlapAlignment final : public Step {
 public:
  explicit OverlapAlignment(const Params& params) : params_(params) {}

  static params::DataFlow data_flow(const Params&) { return gives(kOverlap); }

  Estimate advance(Estimate estimate, Rng&) const override {
    const SelectedClouds clouds = selected_clouds(estimate, params_.points);
    const auto target = cells_of_target(*clouds.target);
    const Cells source =
        occupied_cells(clouds.source->points(), estimate.T_target_source, params_.cell_m);
    const int reach = static_cast<int>(std::lround(params_.range_m / params_.cell_m));
    int most = common_cells(*target, source, 0, 0);
    Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
    for (int dx = -reach; dx <= reach; ++dx) {
      for (int dy = -reach; dy <= reach; ++dy) {
        const int common = common_cells(*target, source, dx, dy);
        if (common <= most) continue;
        most = common;
        shift_m = params_.cell_m * Eigen::Vector3d(dx, dy, 0.0);
      }
    }
    if (most == 0) throw StageError("the two clouds share no cell at any shift within range_m");
    const RigidTransform& T = estimate.T_target_source;
    estimate.set_pose({T.rotation, T.translation + shift_m});
    const double overlap_ratio = static_cast<double>(most) / source.size();
    estimate.extras.put(kOverlap, overlap_ratio);
    estimate.diagnostics = {{"overlap_ratio", overlap_ratio}, {"shift_m", shift_m.norm()}};
    return estimate;
  }

 private:
  /// They do not depend on the start, so all trials share them.
  std::shared_ptr<const Cells> cells_of_target(const Cloud& target) const {
    return target.once<Cells>("overlap_cells", params::value_json(params_.cell_m), [&] {
      return std::make_shared<const Cells>(
          occupied_cells(target.points(), RigidTransform{}, params_.cell_m));
    });
  }

  Params params_;
};

}  // namespace

StageEntry overlap_alignment() {
  return stage_entry<OverlapAlignment>(
      "overlap_alignment",
      "Moves the sensor along the reference's x and y to the largest overlap of occupied cells.",
      "after Olson, Real-time correlative scan matching, 2009", table());
}

}  // namespace croon::stages::step
