#include "framework/spatial/kd_tree.hpp"

#include <limits>
#include <nanoflann.hpp>

namespace croon {
namespace {

/// What nanoflann wants to know of a cloud.
struct PointAccess {
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

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointAccess>,
                                                 PointAccess, 3, std::uint32_t>;

/// nanoflann's result set for one neighbour within a bound. Its own takes arrays and a count.
class NearestResult {
 public:
  explicit NearestResult(float bound) { best_.squared_distance_m2 = bound; }
  std::size_t size() const { return best_ ? 1 : 0; }
  bool full() const { return true; }
  bool addPoint(float squared_distance, std::uint32_t index) {
    if (squared_distance < best_.squared_distance_m2) {
      best_ = {static_cast<int>(index), squared_distance};
    }
    return true;
  }
  float worstDist() const { return best_.squared_distance_m2; }
  const Neighbour& best() const { return best_; }

 private:
  Neighbour best_;
};

/// The same for the nearest neighbour and the second.
class NearestAndRestResult {
 public:
  explicit NearestAndRestResult(float bound) {
    found_.nearest.squared_distance_m2 = bound;
    found_.rest_beyond_m2 = bound;
  }
  std::size_t size() const { return found_.nearest ? 1 : 0; }
  bool full() const { return true; }
  bool addPoint(float squared_distance, std::uint32_t index) {
    if (squared_distance < found_.nearest.squared_distance_m2) {
      found_.rest_beyond_m2 = found_.nearest.squared_distance_m2;
      found_.second = found_.nearest.index;
      found_.nearest = {static_cast<int>(index), squared_distance};
    } else if (squared_distance < found_.rest_beyond_m2) {
      found_.rest_beyond_m2 = squared_distance;
      found_.second = static_cast<int>(index);
    }
    return true;
  }
  float worstDist() const { return found_.rest_beyond_m2; }
  const NearestAndRest& found() const { return found_; }

 private:
  NearestAndRest found_;
};

/// The bound of a search to which a point at `max_distance_m` is within: the next float up.
float bound_of(float max_distance_m) {
  return std::nextafter(max_distance_m * max_distance_m, std::numeric_limits<float>::infinity());
}

constexpr std::size_t kPointsPerLeaf = 10;

}  // namespace

struct KdTree::Index {
  explicit Index(const Points& points)
      : access{points}, tree(3, access, nanoflann::KDTreeSingleIndexAdaptorParams(kPointsPerLeaf)) {
    tree.buildIndex();
  }
  PointAccess access;
  Tree tree;
};

KdTree::KdTree(const Points& points) : index_(std::make_unique<Index>(points)) {}
KdTree::~KdTree() = default;

Neighbour KdTree::nearest(const Eigen::Vector3f& query, float max_distance_m) const {
  NearestResult result(bound_of(max_distance_m));
  index_->tree.findNeighbors(result, query.data(), {});
  return result.best();
}

Neighbour KdTree::nearest(const Eigen::Vector3f& query) const {
  NearestResult result(std::numeric_limits<float>::infinity());
  index_->tree.findNeighbors(result, query.data(), {});
  return result.best();
}

NearestAndRest KdTree::nearest_and_rest(const Eigen::Vector3f& query, float reach_m) const {
  NearestAndRestResult result(bound_of(reach_m));
  index_->tree.findNeighbors(result, query.data(), {});
  return result.found();
}

void KdTree::nearest(const Eigen::Vector3f& query, int count,
                     std::vector<Neighbour>& neighbours) const {
  thread_local std::vector<std::uint32_t> indices;
  thread_local std::vector<float> squared_distances;
  indices.resize(static_cast<std::size_t>(count));
  squared_distances.resize(static_cast<std::size_t>(count));
  nanoflann::KNNResultSet<float, std::uint32_t> result(static_cast<std::size_t>(count));
  result.init(indices.data(), squared_distances.data());
  index_->tree.findNeighbors(result, query.data(), {});
  neighbours.clear();
  for (std::size_t i = 0; i < result.size(); ++i) {
    neighbours.push_back({static_cast<int>(indices[i]), squared_distances[i]});
  }
}

}  // namespace croon
