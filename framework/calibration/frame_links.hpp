#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/calibration/extrinsics.hpp"

namespace croon {

/// The pose of one frame in another one, as a file has it.
struct FrameLink {
  std::string parent;  ///< Empty if the file does not name it.
  std::string child;
  RigidTransform T_parent_child;
  std::string where = {};  ///< Position in the file, for errors.
  bool is_accepted = true;
  /// Whether the two frames are fixed to each other: the wheels of a car are not.
  bool is_fixed = true;
  std::optional<PoseCovariance> covariance = {};
};

/// The poses of all frames in their common root, in the order of `links`; chains of links are
/// multiplied. Frames that are not fixed to the root are left out. Throws InputError, naming
/// `file`, if a frame has two parents, or if the links are not one tree.
Extrinsics joined_links(const std::vector<FrameLink>& links, const std::string& file);

}  // namespace croon
