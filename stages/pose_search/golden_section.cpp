#include <cmath>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/stage/dof_words.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::pose_search {
namespace {

struct Params {
  std::vector<Dof> dofs = {Dof::x, Dof::y};
  double translation_range_m = 0.045;
  double rotation_range_deg = 0.9;
  double translation_tolerance_m = 0.001;
  double rotation_tolerance_deg = 0.02;
  double min_decrease_ratio = 1e-3;
  int sweeps = 1;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::choices("dofs", &Params::dofs, dof_words(),
                      "Degrees of freedom that are searched, in this order."),
      params::number("translation_range_m", &Params::translation_range_m, {1e-6, 100.0},
                     "Half range of the search in x, y and z."),
      params::number("rotation_range_deg", &Params::rotation_range_deg, {1e-6, 180.0},
                     "Half range of the search in roll, pitch and yaw."),
      params::number("translation_tolerance_m", &Params::translation_tolerance_m, {1e-9, 100.0},
                     "Interval length at which the search in x, y or z ends."),
      params::number("rotation_tolerance_deg", &Params::rotation_tolerance_deg, {1e-9, 180.0},
                     "The same for roll, pitch and yaw."),
      params::number("min_decrease_ratio", &Params::min_decrease_ratio, {0.0, 1.0},
                     "Minimum relative decrease of the cost for a pose to be accepted."),
      params::integer(
          "sweeps", &Params::sweeps, {1, 1000},
          "Maximum number of passes over the list; a pass without a change is the last."),
  };
  return table;
}

/// An offset along one degree of freedom, and the cost there.
struct Probe {
  double offset;
  double cost;
};

/// Searches one degree of freedom after the other for the minimum cost in an interval around the
/// pose; each evaluation shortens the interval by the golden ratio (Kiefer, Sequential minimax
/// search for a maximum, 1953). The cost is assumed to be unimodal.
class GoldenSection final : public PoseSearch {
 public:
  explicit GoldenSection(Params params) : params_(std::move(params)) {}

  PoseMinimum minimise(const PoseCost& cost, const RigidTransform& start) const override {
    PoseMinimum best{start, cost(start), 1};
    for (int i = 0; i < params_.sweeps; ++i) {
      bool is_lower = false;
      for (const Dof dof : params_.dofs) is_lower = search(cost, dof, best) || is_lower;
      if (!is_lower) break;
    }
    return best;
  }

 private:
  /// Searches one degree of freedom from the best pose. Returns whether a better one was found.
  bool search(const PoseCost& cost, Dof dof, PoseMinimum& best) const {
    const bool turns = is_rotation(dof);
    const double range =
        turns ? rad_from_deg(params_.rotation_range_deg) : params_.translation_range_m;
    const double tolerance =
        turns ? rad_from_deg(params_.rotation_tolerance_deg) : params_.translation_tolerance_m;
    const RigidTransform origin = best.pose;
    const auto pose_at = [&](double offset) {
      Vector6d step = Vector6d::Zero();
      step(static_cast<Eigen::Index>(dof)) = offset;
      return moved(origin, step);
    };
    const double golden = (std::sqrt(5.0) - 1.0) / 2.0;
    double low = -range;
    double high = range;
    Probe left{high - golden * (high - low), 0.0};
    Probe right{low + golden * (high - low), 0.0};
    const std::vector<double> costs = cost.at({pose_at(left.offset), pose_at(right.offset)});
    left.cost = costs[0];
    right.cost = costs[1];
    best.evaluations += 2;
    while (high - low > tolerance) {
      if (left.cost <= right.cost) {
        high = right.offset;
        right = left;
        left.offset = high - golden * (high - low);
        left.cost = cost(pose_at(left.offset));
      } else {
        low = left.offset;
        left = right;
        right.offset = low + golden * (high - low);
        right.cost = cost(pose_at(right.offset));
      }
      ++best.evaluations;
    }
    const Probe& found = left.cost <= right.cost ? left : right;
    if (!(best.cost - found.cost > params_.min_decrease_ratio * std::abs(best.cost))) return false;
    best.pose = pose_at(found.offset);
    best.cost = found.cost;
    return true;
  }

  Params params_;
};

}  // namespace

StageEntry golden_section() {
  return stage_entry<GoldenSection>(
      "golden_section", "Searches one degree of freedom after the other by golden section.",
      "Kiefer 1953", table());
}

}  // namespace croon::stages::pose_search
