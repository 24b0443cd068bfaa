#pragma once

#include <nanoflann.hpp>
#include <vector>

#include "framework/spatial/kd_tree.hpp"

namespace croon::benchmarks {

/// nanoflann with its own result set and leaf size, as its examples use it. It shares no code with
/// KdTree, so that changes there do not affect the comparison.
class NanoflannPeer {
 public:
  explicit NanoflannPeer(const Points& points) : points_{points}, tree_(3, points_) {
    tree_.buildIndex();
  }
  Neighbour nearest(const Eigen::Vector3f& query, float max_distance_m) const {
    std::uint32_t index = 0;
    float squared_distance = 0.0F;
    const bool any = tree_.knnSearch(query.data(), 1, &index, &squared_distance) > 0;
    if (!any || squared_distance > max_distance_m * max_distance_m) return {};
    return {static_cast<int>(index), squared_distance};
  }
  void nearest(const Eigen::Vector3f& query, int count, std::vector<Neighbour>& neighbours) const {
    std::vector<std::uint32_t> indices(static_cast<std::size_t>(count));
    std::vector<float> squared_distances(indices.size());
    indices.resize(
        tree_.knnSearch(query.data(), indices.size(), indices.data(), squared_distances.data()));
    neighbours.clear();
    for (std::size_t i = 0; i < indices.size(); ++i) {
      neighbours.push_back({static_cast<int>(indices[i]), squared_distances[i]});
    }
  }

 private:
  struct PointList {
    const Points& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    float kdtree_get_pt(std::size_t index, std::size_t axis) const {
      return points[index][static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  PointList points_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointList>, PointList, 3,
                                      std::uint32_t>
      tree_;
};

}  // namespace croon::benchmarks
