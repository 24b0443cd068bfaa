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

/// Maximum number of squares along each side of the bitmap in which CGAL connects the points of a
/// plane: 200 MB at four bytes per square of the edge cluster_distance_m.
constexpr int kMaxSquares = 7000;

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::number("leaf_size_m", &Params::leaf_size_m, {1e-3, 10.0},
                         "Edge of the cubes; one point of each cube is used."),
          params::integer("neighbours", &Params::neighbours, {3, 1000},
                          "Number of neighbours from which a normal is computed."),
          params::number("max_angle_deg", &Params::max_angle_deg, {0.0, 90.0},
                         "Maximum angle between the normals of a plane's points and of the plane."),
          params::number("cluster_distance_m", &Params::cluster_distance_m, {1e-3, 1000.0},
                         "Maximum size, approximately, of gaps between connected points of a "
                         "plane; the stage fails if a plane is more than " +
                             std::to_string(kMaxSquares) + " times as long as this."),
          params::number("miss_probability", &Params::miss_probability, {1e-9, 0.999},
                         "Probability of having missed a plane below which the search ends."),
          params::number("min_region_ratio", &Params::min_region_ratio, {0.0, 1.0},
                         "Minimum size of a plane, as a share of the points."),
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

/// A plane that limits the size of its bitmap: if it is too large, the search of this thread ends.
/// An exception from a shape would leak the other shapes of CGAL.
class BoundedPlane final : public CGAL::Shape_detection::Plane<Traits> {
 public:
  /// The extent of a plane that was too large, or 0.
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
    if (extent_m <= kMaxSquares * cluster_epsilon) {
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
  return stage_entry<CgalEfficientRansac>("cgal_efficient_ransac",
                                          "Finds planes with CGAL's Efficient RANSAC over points "
                                          "with normals and chooses the one with the most points.",
                                          "Schnabel, Wahl and Klein 2007, in CGAL (GPL)", table());
}

}  // namespace croon::stages::ground_extractor
