#pragma once

#include <atomic>
#include <memory>

#include "experiments/python/interpreter.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/yaw_search.hpp"

namespace croon::python {

/// The cost function of a search as a Python function, valid while this object lives; a later call
/// raises RuntimeError. It counts its calls. Requires the interpreter's lock.
class CallableYawCost {
 public:
  explicit CallableYawCost(const YawCost& cost);
  ~CallableYawCost();
  CallableYawCost(const CallableYawCost&) = delete;
  CallableYawCost& operator=(const CallableYawCost&) = delete;

  py::object function() const { return function_; }
  /// The minimum at the yaw returned by the search. Throws InputError if it is not a finite number.
  YawMinimum minimum(const py::object& result) const;

 private:
  struct State;
  std::shared_ptr<State> state_;
  py::object function_;
};

/// The same for a function of pose.
class CallablePoseCost {
 public:
  CallablePoseCost(const PoseCost& cost, const RigidTransform& start);
  ~CallablePoseCost();
  CallablePoseCost(const CallablePoseCost&) = delete;
  CallablePoseCost& operator=(const CallablePoseCost&) = delete;

  py::object function() const { return function_; }
  /// The minimum at the pose returned by the search, or at the start if that has a lower cost.
  /// Throws InputError if the result is not a pose.
  PoseMinimum minimum(const py::object& result) const;

 private:
  struct State;
  std::shared_ptr<State> state_;
  RigidTransform start_;
  py::object function_;
};

}  // namespace croon::python
