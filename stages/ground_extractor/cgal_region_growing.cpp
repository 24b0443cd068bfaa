#include <CGAL/Point_set_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/exceptions.h>
#include <CGAL/version.h>

// CGAL 5.6 changed the interface of region growing.
#define CROON_CGAL_REGIONS_OF_5_6 (CGAL_VERSION_NR >= 1050600900)

#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#if CROON_CGAL_REGIONS_OF_5_6
#include <CGAL/Shape_detection/Region_growing/Point_set.h>
#else
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#endif

#include <algorithm>
#include <iterator>

#include "framework/base/error.hpp"
#include "framework/spatial/normals.hpp"
#include "framework/stage/ground_from_planes.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::ground_extractor {
namespace {

struct Params : GroundRule {
  double leaf_size_m = 0.2;
  int neighbours = 20;
  double max_angle_deg = 25.0;
  double min_region_ratio = 0.02;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::number("leaf_size_m", &Params::leaf_size_m, {1e-3, 10.0},
                         "Edge of the cubes; one point of each cube is used."),
          params::integer(
              "neighbours", &Params::neighbours, {3, 1000},
              "Number of neighbours to which regions grow and from which normals are computed."),
          params::number(
              "max_angle_deg", &Params::max_angle_deg, {0.0, 90.0},
              "Maximum angle between the normals of a region's points and of its plane."),
          params::number("min_region_ratio", &Params::min_region_ratio, {0.0, 1.0},
                         "Minimum size of a region, as a share of the points."),
      }
          .inherit(ground_rule_table());
  return table;
}

using Kernel = CGAL::Simple_cartesian<double>;
using PointSet = CGAL::Point_set_3<Kernel::Point_3, Kernel::Vector_3>;
using Region = std::vector<int>;

PointSet cgal_points(const OrientedPoints& oriented) {
  PointSet points(true);
  for (std::size_t i = 0; i < oriented.points.size(); ++i) {
    const Eigen::Vector3d p = oriented.points[i].cast<double>();
    const Eigen::Vector3d n = oriented.normals[i].cast<double>();
    points.insert(Kernel::Point_3(p.x(), p.y(), p.z()), Kernel::Vector_3(n.x(), n.y(), n.z()));
  }
  return points;
}

/// The regions of all sizes. CGAL's own minimum size is not used: CGAL grows a region that is too
/// small again from each of its points, which takes minutes if the minimum is high.
#if CROON_CGAL_REGIONS_OF_5_6
std::vector<Region> grown_regions(const PointSet& points, const Params& params) {
  namespace on_points = CGAL::Shape_detection::Point_set;
  using Neighbours = on_points::K_neighbor_query_for_point_set<PointSet>;
  using PlaneRegion = on_points::Least_squares_plane_fit_region_for_point_set<PointSet>;
  using Growing = CGAL::Shape_detection::Region_growing<Neighbours, PlaneRegion>;
  Neighbours neighbours = on_points::make_k_neighbor_query(
      points, CGAL::parameters::k_neighbors(static_cast<std::size_t>(params.neighbours)));
  PlaneRegion plane_region = on_points::make_least_squares_plane_fit_region(
      points, CGAL::parameters::maximum_distance(params.threshold_m)
                  .maximum_angle(params.max_angle_deg)
                  .minimum_region_size(std::size_t{1}));
  Growing growing(points, neighbours, plane_region);
  std::vector<Growing::Primitive_and_region> grown;
  growing.detect(std::back_inserter(grown));
  std::vector<Region> regions;
  for (const auto& primitive_and_region : grown) {
    Region region;
    for (const PointSet::Index index : primitive_and_region.second) {
      region.push_back(static_cast<int>(static_cast<std::size_t>(index)));
    }
    regions.push_back(std::move(region));
  }
  return regions;
}
#else
std::vector<Region> grown_regions(const PointSet& points, const Params& params) {
  namespace on_points = CGAL::Shape_detection::Point_set;
  using Neighbours = on_points::K_neighbor_query<Kernel, PointSet, PointSet::Point_map>;
  using PlaneRegion =
      on_points::Least_squares_plane_fit_region<Kernel, PointSet, PointSet::Point_map,
                                                PointSet::Vector_map>;
  using Growing = CGAL::Shape_detection::Region_growing<PointSet, Neighbours, PlaneRegion>;
  Neighbours neighbours(points, static_cast<std::size_t>(params.neighbours), points.point_map());
  PlaneRegion plane_region(points, params.threshold_m, params.max_angle_deg, 1, points.point_map(),
                           points.normal_map());
  Growing growing(points, neighbours, plane_region);
  std::vector<std::vector<std::size_t> > grown;
  growing.detect(std::back_inserter(grown));
  std::vector<Region> regions;
  for (const std::vector<std::size_t>& indices : grown) {
    regions.emplace_back(indices.begin(), indices.end());
  }
  return regions;
}
#endif

/// Region growing with CGAL: a region absorbs neighbours that lie on the plane fitted to it so far.
class CgalRegionGrowing final : public GroundExtractor {
 public:
  explicit CgalRegionGrowing(const Params& params) : params_(params) {}

  Ground extract(const PointCloud& cloud, Rng& rng) const override {
    return with_stage_errors<CGAL::Failure_exception>("CGAL",
                                                      [&] { return extracted(cloud.points, rng); });
  }

 private:
  Ground extracted(const Points& cloud, Rng& rng) const {
    const OrientedPoints oriented = oriented_sample(cloud, params_.leaf_size_m, params_.neighbours);
    return ground_from_planes(cloud, planes(oriented), params_, rng);
  }

  std::vector<Plane> planes(const OrientedPoints& oriented) const {
    std::vector<Plane> planes;
    if (oriented.points.empty()) return planes;
    const double smallest =
        std::max(3.0, params_.min_region_ratio * static_cast<double>(oriented.points.size()));
    for (const Region& region : grown_regions(cgal_points(oriented), params_)) {
      if (static_cast<double>(region.size()) < smallest) continue;
      try {
        planes.push_back(fit_plane(oriented.points, region));
      } catch (const StageError&) {
        // The points of the region are collinear.
      }
    }
    return planes;
  }

  Params params_;
};

}  // namespace

StageEntry cgal_region_growing() {
  return stage_entry<CgalRegionGrowing>("cgal_region_growing",
                                        "Grows planar regions from neighbour to neighbour with "
                                        "CGAL and chooses the plane with the most points.",
                                        "Lafarge and Mallet 2012, in CGAL (GPL)", table());
}

}  // namespace croon::stages::ground_extractor
