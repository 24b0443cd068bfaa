#include "framework/calibration/frame_links.hpp"

#include <map>
#include <set>

#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

using LinksByChild = std::map<std::string, const FrameLink*>;

LinksByChild links_by_child(const std::vector<FrameLink>& links, const std::string& file) {
  LinksByChild by_child;
  for (const FrameLink& link : links) {
    if (link.child == link.parent) {
      throw InputError(file, link.where,
                       "the frame " + in_quotes(link.child) + " is its own parent");
    }
    const auto [first, is_new] = by_child.emplace(link.child, &link);
    if (is_new) continue;
    const std::string& other = first->second->where;
    throw InputError(file, link.where,
                     "the sensor " + in_quotes(link.child) + " has a duplicate pose" +
                         (other.empty() || other == link.where ? "" : "; the first one: " + other));
  }
  return by_child;
}

/// A frame's pose in its root.
struct RootPose {
  std::string root;
  RigidTransform T_root_frame;
  bool is_fixed = true;
};

RootPose root_pose(const FrameLink& link, const LinksByChild& by_child, const std::string& file) {
  RootPose pose{link.parent, link.T_parent_child, link.is_fixed};
  std::set<std::string> visited = {link.child};
  for (auto at = by_child.find(pose.root); at != by_child.end(); at = by_child.find(pose.root)) {
    const FrameLink& above = *at->second;
    if (!visited.insert(above.child).second) {
      throw InputError(
          file, link.where,
          "the frame " + in_quotes(link.child) + " is its own ancestor: the frames form a loop");
    }
    pose = {above.parent, above.T_parent_child * pose.T_root_frame,
            above.is_fixed && pose.is_fixed};
  }
  return pose;
}

}  // namespace

Extrinsics joined_links(const std::vector<FrameLink>& links, const std::string& file) {
  if (links.empty()) throw InputError(file, "", "expected the pose of a sensor, found none");
  const LinksByChild by_child = links_by_child(links, file);
  Extrinsics extrinsics;
  extrinsics.parent = root_pose(links.front(), by_child, file).root;
  for (const FrameLink& link : links) {
    const RootPose pose = root_pose(link, by_child, file);
    if (pose.root != extrinsics.parent) {
      throw InputError(file, link.where,
                       "expected the pose of " + in_quotes(link.child) + " in " +
                           in_quotes(extrinsics.parent) + ", like the preceding sensors, found " +
                           "one in " + in_quotes(pose.root) +
                           " and no pose that links the two frames");
    }
    if (!pose.is_fixed) continue;
    // The covariance of a product requires the covariance of every factor.
    const bool is_direct = link.parent == pose.root;
    extrinsics.poses.push_back({link.child, pose.T_root_frame, link.is_accepted,
                                is_direct ? link.covariance : std::nullopt});
  }
  return extrinsics;
}

}  // namespace croon
