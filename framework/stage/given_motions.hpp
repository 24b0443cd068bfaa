#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "framework/geometry/dof.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/stage/rig_step.hpp"

namespace croon {

/// No car is faster, nor does it turn faster: larger numbers have another unit.
inline constexpr double kFastest_mps = 1000.0;
inline constexpr double kFastest_degps = 3600.0;

/// What another device measured of the velocity of the car in one scene.
struct GivenMotion {
  Twist velocity;
  /// Standard deviations: about the axes in rad/s, along them in m/s. None if they are not known.
  std::optional<Vector6d> stds;
};

/// By the name of the scene.
using GivenMotions = std::map<std::string, GivenMotion>;

/// A step that corrects clouds by velocities of the reference's car, which may be in a file. Steps
/// read no files: who runs an experiment reads it once, before the run, and hands its content over.
class GivenMotionStep : public RigStep {
 public:
  /// The file as the experiment names it, and its SHA-256 if the experiment gives one.
  struct File {
    std::string name;  ///< Empty if the velocity is a parameter.
    std::string sha256;
  };

  virtual File file() const = 0;

  /// The same step with the content of its file.
  virtual std::shared_ptr<const Step> with(GivenMotions motions) const = 0;
};

}  // namespace croon
