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
                          "Degrees of freedom that are searched together; at least two."),
          params::number("translation_range_m", &Params::translation_range_m, {1e-6, 100.0},
                         "Half range of the search in x, y and z."),
          params::number("rotation_range_deg", &Params::rotation_range_deg, {1e-6, 90.0},
                         "Half range of the search in roll, pitch and yaw."),
          params::number("first_step_ratio", &Params::first_step_ratio, {1e-6, 1.0},
                         "Initial steps as a share of the ranges; over such a step the cost should "
                         "change by more than its noise."),
          params::number("tolerance_ratio", &Params::tolerance_ratio, {1e-9, 1.0},
                         "Steps, as a share of the ranges, at which the search ends."),
          params::number("min_decrease_ratio", &Params::min_decrease_ratio, {0.0, 1.0},
                         "Minimum relative decrease of the cost for the result to be accepted."),
          params::integer("max_evaluations", &Params::max_evaluations, {20, 1000000},
                          "Maximum number of evaluations."),
      }
          .require([](const Params& p) { return p.dofs.size() >= 2; },
                   "dofs must list at least two degrees of freedom")
          .require([](const Params& p) { return p.tolerance_ratio <= p.first_step_ratio; },
                   "tolerance_ratio must not exceed first_step_ratio");
  return table;
}

/// One search over poses around the initial one, in coordinates that scale each range to [-1, 1].
class Search {
 public:
  Search(const Params& params, const PoseCost& cost, const RigidTransform& start)
      : params_(params), cost_(cost), start_(start), best_{start, cost(start), 1} {}

  /// The cost at the offsets `u`, one per degree of freedom. An exception ends the search and is
  /// rethrown by best().
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

/// The data of NLopt's callback.
struct Call {
  Search* search;
  nlopt_opt optimiser;
};

double cost_at(unsigned, const double* u, double*, void* data) {
  const auto* const call = static_cast<const Call*>(data);
  return (*call->search)(u, call->optimiser);
}

/// Powell's trust-region search: a quadratic through 2 n + 1 poses, for n degrees of freedom, is
/// minimised within a trust region, which shrinks when the model predicts no further decrease.
class Bobyqa final : public PoseSearch {
 public:
  explicit Bobyqa(Params params) : params_(std::move(params)) {}

  PoseMinimum minimise(const PoseCost& cost, const RigidTransform& start) const override {
    Search search(params_, cost,
                  start);  // Evaluates the initial pose, which NLopt evaluates again.
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
    double min_cost = 0.0;
    const nlopt_result result = is_set ? nlopt_optimize(optimiser.get(), u.data(), &min_cost)  //
                                       : NLOPT_INVALID_ARGS;
    PoseMinimum found = search.best();
    // A search may also end because its steps are below the rounding of the cost.
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
