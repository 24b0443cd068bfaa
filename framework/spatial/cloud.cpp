#include "framework/spatial/cloud.hpp"

namespace croon {

const KdTree& Cloud::kd_tree() const {
  return *once<KdTree>("kd_tree", [this] { return std::make_shared<const KdTree>(points()); });
}

const Normals& Cloud::normals(int neighbours) const {
  return *once<Normals>("normals/" + std::to_string(neighbours), [this, neighbours] {
    return std::make_shared<const Normals>(points(), kd_tree(), neighbours);
  });
}

std::shared_ptr<const Cloud> Cloud::derived(PointCloud cloud, const std::string& purpose) const {
  return std::shared_ptr<const Cloud>(
      new Cloud(std::move(cloud), key_.with(purpose), log_, prefix_ + purpose + "/"));
}

std::shared_ptr<const Cloud> Cloud::derived_in_trial(PointCloud cloud,
                                                     const std::string& purpose) const {
  return std::shared_ptr<const Cloud>(new Cloud(std::move(cloud), key_.with(purpose), nullptr, ""));
}

}  // namespace croon
