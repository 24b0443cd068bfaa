#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/calibration/extrinsics.hpp"

namespace croon {

/// The pose of one frame in another, as stored in a file.
struct FrameLink {
  std::string parent;  ///< Empty if the file does not name it.
  std::string child;
  RigidTransform T_parent_child;
  std::string where = {};  ///< Position in the file, for errors.
  bool is_accepted = true;
  /// Whether the two frames are rigidly connected, unlike the wheels of a car.
  bool is_fixed = true;
  std::optional<PoseCovariance> covariance = {};
};

/// The poses of all frames in their common root, in the order of `links`; chains of links are
/// multiplied. Frames that are not fixed to the root are omitted. Throws InputError, naming `file`,
/// if a frame has two parents, or if the links do not form one tree.
Extrinsics joined_links(const std::vector<FrameLink>& links, const std::string& file);

}  // namespace croon
