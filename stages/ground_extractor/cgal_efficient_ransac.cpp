#include <CGAL/Random.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/exceptions.h>
#include <CGAL/property_map.h>

#include <cmath>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/spatial/normals.hpp"
#include "framework/stage/ground_from_planes.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::ground_extractor {
namespace {

struct Params : GroundRule {
  double leaf_size_m = 0.2;
  int neighbours = 20;
  double max_angle_deg = 25.0;
  double cluster_distance_m = 2.0;
  double miss_probability = 0.01;
  double min_region_ratio = 0.02;
};

/// CGAL connects the points of a plane in a bitmap of its extent, with four bytes for each square
/// of the edge cluster_distance_m. It has at most so many squares along each side: 200 MB.
constexpr int kMostSquares = 7000;

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::number("leaf_size_m", &Params::leaf_size_m, {1e-3, 10.0},
                         "Planes are searched for among one point per cube of this size."),
          params::integer("neighbours", &Params::neighbours, {3, 1000},
                          "The number of nearest points that a normal is computed from."),
          params::number(
              "max_angle_deg", &Params::max_angle_deg, {0.0, 90.0},
              "The normals of a plane's points differ from the plane's by at most this."),
          params::number(
              "cluster_distance_m", &Params::cluster_distance_m, {1e-3, 1000.0},
              "The points of a plane are connected over gaps of about this size; a scan fails "
              "with a plane that is more than " +
                  std::to_string(kMostSquares) + " times as long."),
          params::number(
              "miss_probability", &Params::miss_probability, {1e-9, 0.999},
              "The search ends when the probability of having missed a plane is below this."),
          params::number("min_region_ratio", &Params::min_region_ratio, {0.0, 1.0},
                         "Planes of less than this share of the points are not searched for."),
      }
          .inherit(ground_rule_table());
  return table;
}

using Kernel = CGAL::Simple_cartesian<double>;
using PointWithNormal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using CgalPoints = std::vector<PointWithNormal>;
using Traits = CGAL::Shape_detection::Efficient_RANSAC_traits<
    Kernel, CgalPoints, CGAL::First_of_pair_property_map<PointWithNormal>,
    CGAL::Second_of_pair_property_map<PointWithNormal>>;
using Search = CGAL::Shape_detection::Efficient_RANSAC<Traits>;

/// A plane without a bitmap of too many squares: in its place, the search of this thread is to end.
/// If a shape threw, CGAL would not free the others.
class BoundedPlane final : public CGAL::Shape_detection::Plane<Traits> {
 public:
  /// The extent of a plane that is too large since this was 0.
  static double& refused_extent_m() {
    static thread_local double extent_m = 0.0;
    return extent_m;
  }

 protected:
  std::size_t connected_component(std::vector<std::size_t>& indices,
                                  double cluster_epsilon) override {
    if (indices.empty()) return 0;
    CGAL::Bbox_3 box;
    for (const std::size_t index : indices) box += point(index).bbox();
    const double extent_m = Eigen::Vector3d(box.x_span(), box.y_span(), box.z_span()).norm();
    if (extent_m <= kMostSquares * cluster_epsilon) {
      return CGAL::Shape_detection::Plane<Traits>::connected_component(indices, cluster_epsilon);
    }
    refused_extent_m() = extent_m;
    indices.clear();
    return 0;
  }
};

CgalPoints cgal_points(const OrientedPoints& oriented) {
  CgalPoints points;
  points.reserve(oriented.points.size());
  for (std::size_t i = 0; i < oriented.points.size(); ++i) {
    const Eigen::Vector3d p = oriented.points[i].cast<double>();
    const Eigen::Vector3d n = oriented.normals[i].cast<double>();
    points.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()),
                        Kernel::Vector_3(n.x(), n.y(), n.z()));
  }
  return points;
}

/// CGAL's Efficient RANSAC (Schnabel, Wahl, Klein 2007) for planes.
class CgalEfficientRansac final : public GroundExtractor {
 public:
  explicit CgalEfficientRansac(const Params& params) : params_(params) {}

  Ground extract(const PointCloud& cloud, Rng& rng) const override {
    return with_stage_errors<CGAL::Failure_exception>("CGAL",
                                                      [&] { return extracted(cloud.points, rng); });
  }

 private:
  Ground extracted(const Points& cloud, Rng& rng) const {
    const OrientedPoints oriented = oriented_sample(cloud, params_.leaf_size_m, params_.neighbours);
    return ground_from_planes(cloud, planes(oriented, rng), params_, rng);
  }

  std::vector<Plane> planes(const OrientedPoints& oriented, Rng& rng) const {
    // CGAL permutes its input and draws from the default generator of this thread, whose state
    // depends on earlier calls.
    CgalPoints points = cgal_points(oriented);
    CGAL::get_default_random() = CGAL::Random(static_cast<unsigned int>(rng.bits() >> 32));
    Search search;
    search.set_input(points);
    search.add_shape_factory<BoundedPlane>();
    BoundedPlane::refused_extent_m() = 0.0;
    search.detect(options(points.size()),
                  [](double) { return BoundedPlane::refused_extent_m() == 0.0; });
    if (const double extent_m = BoundedPlane::refused_extent_m(); extent_m > 0.0) {
      throw StageError("cluster_distance_m " + shortest_number(params_.cluster_distance_m) +
                       " is too small for a plane of " + fixed_number(extent_m, 0) + " m");
    }
    std::vector<Plane> found;
    for (const auto& shape : search.planes()) {
      const Kernel::Vector_3 n = shape->plane_normal();
      const double length = std::sqrt(n.squared_length());
      found.push_back({Eigen::Vector3d(n.x(), n.y(), n.z()) / length, shape->d() / length});
    }
    return found;
  }

  Search::Parameters options(std::size_t point_count) const {
    Search::Parameters options;
    options.probability = params_.miss_probability;
    options.min_points = static_cast<std::size_t>(
        std::ceil(params_.min_region_ratio * static_cast<double>(point_count)));
    options.epsilon = params_.threshold_m;
    options.cluster_epsilon = params_.cluster_distance_m;
    options.normal_threshold = std::cos(rad_from_deg(params_.max_angle_deg));
    return options;
  }

  Params params_;
};

}  // namespace

StageEntry cgal_efficient_ransac() {
  return stage_entry<CgalEfficientRansac>(
      "cgal_efficient_ransac",
      "Finds planes among points with normals by CGAL's Efficient RANSAC and takes the one with "
      "the most points.",
      "Schnabel, Wahl and Klein 2007, in CGAL (GPL)", table());
}

}  // namespace croon::stages::ground_extractor
