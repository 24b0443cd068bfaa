#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "framework/geometry/dof.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/stage/rig_step.hpp"

namespace croon {

/// Upper bounds for a car's speed and rate of rotation; larger numbers indicate a wrong unit.
inline constexpr double kMaxSpeed_mps = 1000.0;
inline constexpr double kMaxTurnRate_degps = 3600.0;

/// The velocity of the car in one scene, as measured by another device.
struct GivenMotion {
  Twist velocity;
  /// Standard deviations: about the axes in rad/s, along them in m/s; std::nullopt if unknown.
  std::optional<Vector6d> stds;
};

/// The velocities by scene name.
using GivenMotions = std::map<std::string, GivenMotion>;

/// A step that corrects clouds with velocities of the reference's car, which may come from a file.
/// Steps do not read files: the caller reads it once, before the run, and passes on its content.
class GivenMotionStep : public RigStep {
 public:
  /// The file named in the experiment, and its SHA-256 if the experiment states one.
  struct File {
    std::string name;  ///< Empty if the velocity is a parameter.
    std::string sha256;
  };

  virtual File file() const = 0;

  /// A copy of the step that uses the content of its file.
  virtual std::shared_ptr<const Step> with(GivenMotions motions) const = 0;
};

}  // namespace croon
