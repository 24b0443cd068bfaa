#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/geometry/point_cloud.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "framework/picture/image.hpp"

namespace croon {

/// One sensor's cloud in one scene, read when it is needed, with the poses `T_reference_sensor`
/// that are known.
struct SensorScan {
  std::string sensor;                   ///< The sensor's name, "front".
  std::string file;                     ///< For messages and digests; empty where there is no file.
  std::function<LoadedCloud()> load;    ///< Throws InputError where the file is not what it says.
  std::optional<RigidTransform> truth;  ///< Ground truth.
  std::optional<RigidTransform> nominal;  ///< The pose on the rig's drawing.
  std::optional<RigidTransform> initial;  ///< The start that the recording came with.
  /// The same points with all that the sensor tells of them; empty where the dataset only reads
  /// clouds.
  std::function<MeasuredCloud()> measure = {};
  /// Datasets leave these empty. Where the engine calibrates one sensor to another, the names of
  /// the two: the points are `source`'s, the poses `T_target_source`.
  std::string source = {}, target = {};
};

/// One recording of the rig: the reference LiDAR and the sensors to be calibrated to it.
struct Scene {
  std::string name;
  std::string kind;  ///< "urban", "narrow"; empty where the dataset tells none.
  SensorScan reference;
  std::vector<SensorScan> sensors;
  /// A picture of the place from behind and above the car; empty where the dataset cannot draw.
  std::function<Image()> draw = {};
};

/// The scenes of a rig.
class Dataset {
 public:
  using Kind = Dataset;
  static constexpr const char* kKind = "dataset";
  static constexpr const char* kKindSummary =
      "The scenes of a rig: named clouds, with truth and starts where they are known.";
  static constexpr int kKindOrder = 10;
  virtual ~Dataset() = default;

  /// The scenes, in a fixed order. Relative paths are resolved below `data_root` and must stay in
  /// it. Looks at every file (that it is there, that its header is whole) but loads no cloud.
  /// Throws InputError.
  virtual std::vector<Scene> scenes(const std::filesystem::path& data_root) const = 0;
};

}  // namespace croon
