#include <nlopt.h>

#include <cmath>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/stage/dof_words.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::pose_search {
namespace {

struct Params {
  std::vector<Dof> dofs = {Dof::roll, Dof::pitch, Dof::yaw, Dof::x, Dof::y, Dof::z};
  double translation_range_m = 0.1;
  double rotation_range_deg = 1.0;
  double first_step_ratio = 0.2;
  double tolerance_ratio = 0.002;
  double min_decrease_ratio = 0.0;
  int max_evaluations = 500;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::choices("dofs", &Params::dofs, dof_words(),
                          "The degrees of freedom that are searched together; at least two."),
          params::number("translation_range_m", &Params::translation_range_m, {1e-6, 100.0},
                         "How far to each side x, y and z are searched."),
          params::number("rotation_range_deg", &Params::rotation_range_deg, {1e-6, 90.0},
                         "How far roll, pitch and yaw are."),
          params::number("first_step_ratio", &Params::first_step_ratio, {1e-6, 1.0},
                         "The first steps are this share of the ranges; costs of poses that are "
                         "nearer to each other should differ by more than chance."),
          params::number("tolerance_ratio", &Params::tolerance_ratio, {1e-9, 1.0},
                         "The search ends when its steps are this share of the ranges."),
          params::number("min_decrease_ratio", &Params::min_decrease_ratio, {0.0, 1.0},
                         "The pose found is taken only if it lowers the cost by more than this "
                         "share of it."),
          params::integer("max_evaluations", &Params::max_evaluations, {20, 1000000},
                          "At most this many evaluations."),
      }
          .require([](const Params& p) { return p.dofs.size() >= 2; },
                   "dofs must list at least two degrees of freedom")
          .require([](const Params& p) { return p.tolerance_ratio <= p.first_step_ratio; },
                   "tolerance_ratio must not exceed first_step_ratio");
  return table;
}

/// One search: the poses around the start, in coordinates in which each range is [-1, 1].
class Search {
 public:
  Search(const Params& params, const PoseCost& cost, const RigidTransform& start)
      : params_(params), cost_(cost), start_(start), best_{start, cost(start), 1} {}

  /// The cost at the offsets `u`, one for each degree of freedom. An exception ends the search.
  double operator()(const double* u, nlopt_opt optimiser) {
    try {
      const RigidTransform pose = moved(start_, offset(u));
      const double pose_cost = cost_(pose);
      ++best_.evaluations;
      if (pose_cost < best_.cost) {
        best_.pose = pose;
        best_.cost = pose_cost;
      }
      return pose_cost;
    } catch (...) {
      exception_ = std::current_exception();
      nlopt_force_stop(optimiser);
      return 0.0;
    }
  }

  const PoseMinimum& best() const {
    if (exception_) std::rethrow_exception(exception_);
    return best_;
  }

 private:
  Vector6d offset(const double* u) const {
    Vector6d offset = Vector6d::Zero();
    for (std::size_t i = 0; i < params_.dofs.size(); ++i) {
      const Dof dof = params_.dofs[i];
      offset(static_cast<Eigen::Index>(dof)) =
          u[i] * (is_rotation(dof) ? rad_from_deg(params_.rotation_range_deg)
                                   : params_.translation_range_m);
    }
    return offset;
  }

  const Params& params_;
  const PoseCost& cost_;
  const RigidTransform& start_;
  PoseMinimum best_;
  std::exception_ptr exception_;
};

/// What the library calls back needs.
struct Call {
  Search* search;
  nlopt_opt optimiser;
};

double cost_at(unsigned, const double* u, double*, void* data) {
  const auto* const call = static_cast<const Call*>(data);
  return (*call->search)(u, call->optimiser);
}

/// Powell's model-based search: a quadratic through 2 n + 1 poses, of n degrees of freedom, is
/// minimised inside of a region of trust, which shrinks when the model promises no more.
class Bobyqa final : public PoseSearch {
 public:
  explicit Bobyqa(Params params) : params_(std::move(params)) {}

  PoseMinimum minimise(const PoseCost& cost, const RigidTransform& start) const override {
    Search search(params_, cost, start);  // It has evaluated the start; the library does it again.
    const PoseMinimum before = search.best();
    const auto n = static_cast<unsigned>(params_.dofs.size());
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(
        nlopt_create(NLOPT_LN_BOBYQA, n), nlopt_destroy);
    Call call{&search, optimiser.get()};
    const bool is_set = nlopt_set_min_objective(optimiser.get(), cost_at, &call) > 0 &&
                        nlopt_set_lower_bounds1(optimiser.get(), -1.0) > 0 &&
                        nlopt_set_upper_bounds1(optimiser.get(), 1.0) > 0 &&
                        nlopt_set_initial_step1(optimiser.get(), params_.first_step_ratio) > 0 &&
                        nlopt_set_xtol_abs1(optimiser.get(), params_.tolerance_ratio) > 0 &&
                        nlopt_set_maxeval(optimiser.get(), params_.max_evaluations - 1) > 0;
    std::vector<double> u(n, 0.0);
    double least = 0.0;
    const nlopt_result result = is_set ? nlopt_optimize(optimiser.get(), u.data(), &least)  //
                                       : NLOPT_INVALID_ARGS;
    PoseMinimum found = search.best();
    // Steps below the rounding of costs end a search as others do.
    if (result < 0 && result != NLOPT_ROUNDOFF_LIMITED) {
      throw std::logic_error("bobyqa: " + std::string(nlopt_result_to_string(result)));
    }
    if (!(before.cost - found.cost > params_.min_decrease_ratio * std::abs(before.cost))) {
      found.pose = before.pose;
      found.cost = before.cost;
    }
    return found;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry bobyqa() {
  return stage_entry<Bobyqa>(
      "bobyqa",
      "Searches all degrees of freedom together, with a quadratic model of the cost and without "
      "derivatives.",
      "BOBYQA (Powell 2009), NLopt", table());
}

}  // namespace croon::stages::pose_search
