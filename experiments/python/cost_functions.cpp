#include "experiments/python/cost_functions.hpp"

#include <cmath>

#include "experiments/python/arrays.hpp"

namespace croon::python {
namespace {

/// A cost function that becomes invalid when the call for which it was made returns.
template <class Cost>
struct BorrowedCost {
  explicit BorrowedCost(const Cost& function) : cost(&function) {}

  template <class Argument>
  double operator()(const Argument& argument) {
    const Cost* const now = cost;
    if (now == nullptr) {
      throw std::runtime_error("the search of this cost function has already returned");
    }
    ++evaluations;
    const WithoutGil no_gil;
    return (*now)(argument);
  }

  std::atomic<const Cost*> cost;
  std::atomic<int> evaluations{0};
};

}  // namespace

struct CallableYawCost::State : BorrowedCost<YawCost> {
  using BorrowedCost::BorrowedCost;
};

CallableYawCost::CallableYawCost(const YawCost& cost) : state_(std::make_shared<State>(cost)) {
  function_ = py::cpp_function([state = state_](double yaw_rad) {
    if (!std::isfinite(yaw_rad)) throw InputError("", "yaw_rad", "expected a finite number");
    return (*state)(yaw_rad);
  });
}

CallableYawCost::~CallableYawCost() { state_->cost = nullptr; }

YawMinimum CallableYawCost::minimum(const py::object& result) const {
  const double yaw_rad =
      PyNumber_Check(result.ptr()) != 0 ? py::cast<double>(py::float_(result)) : std::nan("");
  if (!std::isfinite(yaw_rad)) {
    throw InputError("", "minimise", "expected a finite yaw, found " + text_of(py::repr(result)));
  }
  const double cost = (*state_)(yaw_rad);
  return {yaw_rad, cost, state_->evaluations};
}

struct CallablePoseCost::State : BorrowedCost<PoseCost> {
  using BorrowedCost::BorrowedCost;
};

CallablePoseCost::CallablePoseCost(const PoseCost& cost, const RigidTransform& start)
    : state_(std::make_shared<State>(cost)), start_(start) {
  function_ = py::cpp_function(
      [state = state_](const py::object& pose) { return (*state)(pose_from(pose, "pose")); });
}

CallablePoseCost::~CallablePoseCost() { state_->cost = nullptr; }

PoseMinimum CallablePoseCost::minimum(const py::object& result) const {
  const RigidTransform pose = pose_from(result, "minimise");
  const double cost = (*state_)(pose);
  const double start_cost = (*state_)(start_);
  const int evaluations = state_->evaluations;
  if (start_cost < cost) return {start_, start_cost, evaluations};
  return {pose, cost, evaluations};
}

}  // namespace croon::python
