#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/geometry/point_cloud.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/picture/image.hpp"

namespace croon {

/// One sensor's cloud in one scene, read on demand, with the known poses `T_reference_sensor`.
struct SensorScan {
  std::string sensor;  ///< The sensor's name, "front".
  std::string file;    ///< For messages and digests; empty without a file.
  /// Throws InputError if the file is damaged, UnavailableFile if it cannot be read at the moment.
  std::function<LoadedCloud()> load;
  std::optional<RigidTransform> truth;    ///< Ground truth.
  std::optional<RigidTransform> nominal;  ///< The pose according to the rig's design.
  std::optional<RigidTransform> initial;  ///< The initial pose in the recording.
  /// The channels of the cloud; std::nullopt if they are unknown before it is read.
  std::optional<std::vector<std::string>> channels = {};
  /// The sensor's true velocity during the scan, constant and in its own frame; empty if unknown.
  std::function<Twist()> velocity = {};
};

/// A pose in a file for a sensor that the scene lacks: not recorded, or misspelt.
struct UnusedPose {
  std::string file;
  std::string sensor;
};

/// One recording of the rig: the reference LiDAR and the sensors to be calibrated to it.
struct Scene {
  std::string name;
  std::string kind;  ///< The type of scene, "urban"; empty if unknown.
  SensorScan reference;
  std::vector<SensorScan> sensors;
  /// Of the files of true and nominal poses, for messages; empty without files.
  std::vector<UnusedPose> unused_truth = {}, unused_nominal = {};
  /// Draws the scene from behind and above the car; empty if the dataset cannot draw.
  std::function<Image()> draw = {};
};

/// The scenes of a rig.
class Dataset {
 public:
  using Kind = Dataset;
  static constexpr const char* kKind = "dataset";
  static constexpr const char* kKindSummary =
      "The scenes of a rig: named clouds, with ground truth and initial poses if they are known.";
  static constexpr int kKindOrder = 10;
  virtual ~Dataset() = default;

  /// The scenes, in a fixed order. Relative paths are resolved below `data_root` and must stay in
  /// it. Checks that every file exists and has a valid header, but loads no cloud.
  /// Throws InputError.
  virtual std::vector<Scene> scenes(const std::filesystem::path& data_root) const = 0;
};

}  // namespace croon
