// Stages of each kind that call Python.
#include "experiments/python/stage_adapters.hpp"

#include <cmath>

#include "experiments/python/arrays.hpp"
#include "experiments/python/cost_functions.hpp"
#include "experiments/python/estimates.hpp"
#include "framework/stage/ground_extractor.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/volume_scorer.hpp"
#include "framework/stage/yaw_search.hpp"

namespace croon::python {
namespace {

/// A stage that calls methods of a Python object.
class Caller {
 public:
  explicit Caller(ObjectRef instance) : instance_(std::move(instance)) {}

 protected:
  /// Requires the interpreter's lock.
  template <class... Arguments>
  py::object call(const char* method, Arguments&&... arguments) const {
    return instance_.get().attr(method)(std::forward<Arguments>(arguments)...);
  }

 private:
  ObjectRef instance_;
};

std::shared_ptr<Cloud> python_cloud(const std::shared_ptr<const Cloud>& cloud) {
  return std::const_pointer_cast<Cloud>(cloud);
}

/// A copy that Python may keep; `cloud` itself is only valid during the call.
std::shared_ptr<Cloud> copied(const Cloud& cloud) {
  return std::make_shared<Cloud>(cloud.with_channels(), StreamKey(0));
}

class PythonStep final : public Step, Caller {
 public:
  using Caller::Caller;
  Estimate advance(Estimate estimate, Rng& rng) const override {
    return in_python([&] {
      const py::object result = call("advance", estimate, PythonRng{rng});
      return estimate_from(result, std::move(estimate));
    });
  }
};

class PythonRigStep final : public RigStep, Caller {
 public:
  using Caller::Caller;
  void adjust(std::vector<RigEstimate>& rig, Rng& rng) const override {
    in_python([&] {
      py::list list;
      for (const RigEstimate& estimate : rig) list.append(py::cast(estimate));
      const py::tuple kept(list);  // Independent of changes to the list.
      const py::object result = call("adjust", list, PythonRng{rng});
      if (!result.is_none()) {
        throw InputError("", "adjust",
                         "expected changes in place and None, found " + type_words(result));
      }
      for (std::size_t i = 0; i < rig.size(); ++i) rig[i] = py::cast<RigEstimate>(kept[i]);
    });
  }
};

class PythonYawSearch final : public YawSearch, Caller {
 public:
  using Caller::Caller;
  YawMinimum minimise(const YawCost& cost) const override {
    return in_python([&] {
      CallableYawCost callable(cost);
      return callable.minimum(call("minimise", callable.function()));
    });
  }
};

class PythonPoseSearch final : public PoseSearch, Caller {
 public:
  using Caller::Caller;
  PoseMinimum minimise(const PoseCost& cost, const RigidTransform& start) const override {
    return in_python([&] {
      CallablePoseCost callable(cost, start);
      return callable.minimum(call("minimise", callable.function(), array_from(start)));
    });
  }
};

class PythonPreprocessor final : public Preprocessor, Caller {
 public:
  using Caller::Caller;
  PointCloud apply(const PointCloud& cloud) const override {
    return in_python([&] {
      const py::object result = call("apply", structured_array(cloud));
      if (py::isinstance<py::array_t<bool>>(result)) return kept(cloud, result);
      return cloud_or_empty_from(result, "apply");
    });
  }

 private:
  static PointCloud kept(const PointCloud& cloud, const py::object& result) {
    const py::array_t<bool> mask(result);
    if (mask.ndim() != 1 || static_cast<std::size_t>(mask.size()) != cloud.size()) {
      throw InputError("", "apply", "expected a cloud, or true or false for each point");
    }
    return filtered(cloud, [&](std::size_t i) { return mask.at(static_cast<py::ssize_t>(i)); });
  }
};

class PythonGroundExtractor final : public GroundExtractor, Caller {
 public:
  using Caller::Caller;
  Ground extract(const PointCloud& cloud, Rng& rng) const override {
    return in_python([&] {
      const py::object stream = py::cast(PythonRng{rng});
      const py::object result = call("extract", structured_array(cloud), stream);
      rng = py::cast<const PythonRng&>(stream).rng;
      return ground_from(result, cloud.size());
    });
  }

 private:
  static Ground ground_from(const py::object& result, std::size_t points) {
    if (!py::isinstance<py::tuple>(result) || py::len(result) != 3) {
      throw InputError(
          "", "extract",
          "expected a normal, an offset and a mask of the points, found " + type_words(result));
    }
    const py::tuple parts = result;
    Ground ground;
    ground.plane.normal = vector_from(parts[0], "extract: the normal");
    const double length = ground.plane.normal.norm();
    if (!(length > 0.0)) throw InputError("", "extract", "expected a normal, found a zero vector");
    ground.plane.normal /= length;
    ground.plane.offset_m = py::cast<double>(py::float_(parts[1])) / length;
    const py::array_t<bool, py::array::forcecast> mask(parts[2]);
    if (mask.ndim() != 1 || static_cast<std::size_t>(mask.size()) != points) {
      throw InputError("", "extract", "expected true or false for each point");
    }
    if (!std::isfinite(ground.plane.offset_m)) {
      throw InputError("", "extract", "expected a finite offset");
    }
    for (py::ssize_t i = 0; i < mask.size(); ++i) ground.is_ground.push_back(mask.at(i) ? 1 : 0);
    return ground;
  }
};

class PythonIcp final : public Icp, Caller {
 public:
  using Caller::Caller;
  Registration align(const Cloud& target, const Cloud& source,
                     const RigidTransform& start) const override {
    return in_python([&] {
      return registration_from(
          call("align", python_copy(target), python_copy(source), array_from(start)));
    });
  }

 private:
  /// The same object for the same cloud, so that derived data are computed once.
  static py::object python_copy(const Cloud& cloud) {
    const auto copy = [&] {
      const WithoutGil no_gil;
      return cloud.once<std::shared_ptr<Cloud>>("python/cloud", [&] {
        return std::make_shared<const std::shared_ptr<Cloud>>(copied(cloud));
      });
    }();
    return py::cast(*copy);
  }

  static Registration registration_from(const py::object& result) {
    const py::object type = py::module_::import("croon._stages").attr("Registration");
    Registration registration;
    if (!py::isinstance(result, type)) {
      registration.T_target_source = pose_from(result, "align");
      return registration;
    }
    registration.T_target_source = pose_from(result.attr("pose"), "align");
    registration.rmse_m = py::cast<double>(result.attr("rmse_m"));
    registration.inlier_ratio = py::cast<double>(result.attr("inlier_ratio"));
    registration.correspondences = py::cast<int>(result.attr("correspondences"));
    registration.iterations = py::cast<int>(result.attr("iterations"));
    registration.converged = py::cast<bool>(result.attr("converged"));
    const py::object information = result.attr("information");
    if (!information.is_none()) {
      registration.information = matrix6_from(information, "align: the information");
    }
    return registration;
  }
};

class PythonVolumeScorer final : public VolumeScorer, Caller {
 public:
  using Caller::Caller;
  VolumeFunction bind(std::shared_ptr<const Cloud> target,
                      std::shared_ptr<const Cloud> source) const override {
    return in_python([&]() -> VolumeFunction {
      const py::object result = call("bind", python_cloud(target), python_cloud(source));
      if (!py::isinstance<py::tuple>(result) || py::len(result) != 2) {
        throw InputError("", "bind",
                         "expected a function and a leaf size, found " + type_words(result));
      }
      const py::tuple parts = result;
      const ObjectRef function{py::object(parts[0])};
      const double leaf_size_m = py::cast<double>(py::float_(parts[1]));
      if (!(leaf_size_m > 0.0) || !std::isfinite(leaf_size_m)) {
        throw InputError("", "bind", "expected a leaf size, found " + text_of(parts[1]));
      }
      return [function, leaf_size_m](const RigidTransform& T_target_source) {
        return in_python([&] {
          return OccupiedVolume::of_leaves(leaves_from(function.get()(array_from(T_target_source))),
                                           leaf_size_m);
        });
      };
    });
  }

 private:
  static std::int64_t leaves_from(const py::object& result) {
    const double leaves = py::cast<double>(py::float_(result));
    constexpr double kMaxExactDouble = 9007199254740992.0;  // 2^53
    if (!(leaves >= 0.0 && leaves <= kMaxExactDouble)) {
      throw InputError("", "bind", "expected a number of leaves, found " + text_of(result));
    }
    return static_cast<std::int64_t>(leaves);
  }
};

/// The stage that calls `instance`, of the one class of `Stages` that is of `kind`; null if none
/// is.
template <class... Stages>
std::shared_ptr<const void> made(const std::string& kind, const ObjectRef& instance) {
  std::shared_ptr<const void> stage;
  const auto make_if = [&](auto* of_class) {
    using Stage = std::remove_pointer_t<decltype(of_class)>;
    using Kind = typename Stage::Kind;
    if (kind == Kind::kKind) {
      stage = std::shared_ptr<const Kind>(std::make_shared<const Stage>(instance));
    }
  };
  (make_if(static_cast<Stages*>(nullptr)), ...);
  return stage;
}

}  // namespace

std::shared_ptr<const void> python_stage(const std::string& kind, bool is_rig_step,
                                         const ObjectRef& instance) {
  if (is_rig_step) return made<PythonRigStep>(kind, instance);
  return made<PythonStep, PythonYawSearch, PythonPoseSearch, PythonPreprocessor,
              PythonGroundExtractor, PythonIcp, PythonVolumeScorer>(kind, instance);
}

}  // namespace croon::python
