#include <cmath>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/params/choice.hpp"
#include "framework/stage/dof_words.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::pose_search {
namespace {

/// When a scan to one side ends.
enum class Stop { first_rise, never };

struct Params {
  std::vector<Dof> dofs = {Dof::x, Dof::y};
  double translation_step_m = 0.005;
  double rotation_step_deg = 0.1;
  int max_steps = 9;
  double min_decrease_ratio = 1e-3;
  Stop stop = Stop::first_rise;
  int sweeps = 1;
  int halvings = 0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::choices("dofs", &Params::dofs, dof_words(),
                      "Degrees of freedom that are scanned, in this order."),
      params::number("translation_step_m", &Params::translation_step_m, {1e-6, 100.0},
                     "Step along x, y and z; 0.02 in the authors' code."),
      params::number("rotation_step_deg", &Params::rotation_step_deg, {1e-6, 180.0},
                     "Step of roll, pitch and yaw."),
      params::integer("max_steps", &Params::max_steps, {1, 10000},
                      "Maximum number of steps to each side in one scan."),
      params::number("min_decrease_ratio", &Params::min_decrease_ratio, {0.0, 1.0},
                     "Minimum relative decrease of the cost for a step to be accepted; 0.0001 in "
                     "the authors' code."),
      params::choice("stop", &Params::stop,
                     {{"first_rise", Stop::first_rise}, {"never", Stop::never}},
                     "first_rise: on each side, plus first, the scan ends at the first step that "
                     "does not lower the cost; never: both sides are scanned up to max_steps and "
                     "the best pose is chosen."),
      params::integer(
          "sweeps", &Params::sweeps, {1, 1000},
          "Maximum number of passes over the list; a pass without a change is the last."),
      params::integer("halvings", &Params::halvings, {0, 30},
                      "Number of times that the steps are halved and the passes repeated."),
  };
  return table;
}

/// One search: the best pose so far and the moves that improve it.
class Scan {
 public:
  Scan(const Params& params, const PoseCost& cost, const RigidTransform& start)
      : params_(params), cost_(cost), best_{start, cost(start), 1} {}

  const PoseMinimum& best() const { return best_; }

  /// Scans every degree of freedom once; true if one of them lowered the cost.
  bool pass(double step_scale) {
    bool lower = false;
    for (const Dof dof : params_.dofs) {
      const double step = step_scale * (is_rotation(dof) ? rad_from_deg(params_.rotation_step_deg)
                                                         : params_.translation_step_m);
      const RigidTransform origin = best_.pose;
      if (params_.stop == Stop::never) {
        lower = scan_range(origin, dof, step) || lower;
      } else {
        // Both first steps are always needed, so they are evaluated together.
        const std::vector<double> first_costs =
            cost_.at({stepped(origin, dof, 1, step), stepped(origin, dof, -1, step)});
        lower = descend(origin, dof, step, first_costs[0]) || lower;
        lower = descend(origin, dof, -step, first_costs[1]) || lower;
      }
    }
    return lower;
  }

 private:
  /// `pose` moved by `count` steps along `dof`.
  static RigidTransform stepped(const RigidTransform& pose, Dof dof, int count, double step) {
    Vector6d offset = Vector6d::Zero();
    offset(static_cast<Eigen::Index>(dof)) = count * step;
    return moved(pose, offset);
  }

  /// Steps in one direction from `origin` while each step lowers the minimum cost so far.
  bool descend(const RigidTransform& origin, Dof dof, double step, double first_cost) {
    for (int i = 1; i <= params_.max_steps; ++i) {
      const RigidTransform pose = stepped(origin, dof, i, step);
      if (!take_if_lower(pose, i == 1 ? first_cost : cost_(pose))) return i > 1;
    }
    return true;
  }

  /// Evaluates the whole range, the nearest poses first, and chooses the best.
  bool scan_range(const RigidTransform& origin, Dof dof, double step) {
    std::vector<RigidTransform> poses;
    for (int i = 1; i <= params_.max_steps; ++i) {
      poses.push_back(stepped(origin, dof, i, step));
      poses.push_back(stepped(origin, dof, -i, step));
    }
    const std::vector<double> costs = cost_.at(poses);
    bool lower = false;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      lower = take_if_lower(poses[i], costs[i]) || lower;
    }
    return lower;
  }

  /// Counts an evaluation, and makes `pose` the best one if its cost is sufficiently lower.
  bool take_if_lower(const RigidTransform& pose, double pose_cost) {
    ++best_.evaluations;
    const bool lower = best_.cost - pose_cost > params_.min_decrease_ratio * std::abs(best_.cost);
    if (lower) {
      best_.pose = pose;
      best_.cost = pose_cost;
    }
    return lower;
  }

  const Params& params_;
  const PoseCost& cost_;
  PoseMinimum best_;
};

/// Scans one degree of freedom after the other, like the volume search of the authors' code: x,
/// then y, each to the plus side while the cost falls, then to the minus side.
class CoordinateScan final : public PoseSearch {
 public:
  explicit CoordinateScan(Params params) : params_(std::move(params)) {}

  PoseMinimum minimise(const PoseCost& cost, const RigidTransform& start) const override {
    Scan scan(params_, cost, start);
    for (int halving = 0; halving <= params_.halvings; ++halving) {
      const double step_scale = std::ldexp(1.0, -halving);
      for (int i = 0; i < params_.sweeps && scan.pass(step_scale); ++i) {
      }
    }
    return scan.best();
  }

 private:
  Params params_;
};

}  // namespace

StageEntry coordinate_scan() {
  return stage_entry<CoordinateScan>(
      "coordinate_scan", "Steps along one degree of freedom after the other while the cost falls.",
      "CROON (arXiv 2203.03182), refinement; scheme of its public code (lidar2lidar, commit "
      "c0e1e2b), with our default steps and limits",
      table());
}

}  // namespace croon::stages::pose_search
