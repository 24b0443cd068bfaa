#include "framework/geometry/plane.hpp"
#include "framework/stage/ground_from_planes.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::ground_extractor {
namespace {

struct Params : GroundRule {
  double confidence = 0.9999;
  int max_iterations = 10000;
  int local_rounds = 4;
  int max_points = 5000;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::number(
              "confidence", &Params::confidence, {0.0, 0.999999999},
              "Probability of having drawn three ground points at which the search ends."),
          params::integer("max_iterations", &Params::max_iterations, {1, 10000000},
                          "Maximum number of planes that are drawn."),
          params::integer("local_rounds", &Params::local_rounds, {0, 100},
                          "Number of times that a new best plane is refitted to its points."),
          params::integer("max_points", &Params::max_points, {3, 1e9},
                          "Maximum number of points from which planes are drawn and on which they "
                          "are evaluated.")
              .formerly("sample_points"),
      }
          .inherit(ground_rule_table());
  return table;
}

/// RANSAC with local optimisation (Chum, Matas and Kittler 2003); plain RANSAC if `local_rounds` is
/// 0.
class Ransac final : public GroundExtractor {
 public:
  explicit Ransac(const Params& params) : params_(params) {}

  Ground extract(const PointCloud& cloud, Rng& rng) const override {
    const Plane plane =
        plane_ransac(cloud.points,
                     {params_.threshold_m, params_.confidence, params_.max_iterations,
                      params_.local_rounds, params_.max_points},
                     rng);
    return ground_from_planes(cloud.points, {plane}, params_, rng);
  }

 private:
  Params params_;
};

}  // namespace

StageEntry ransac() {
  return stage_entry<Ransac>(
      "ransac", "Draws planes through three points and chooses the one with the most inliers.",
      "CROON (arXiv 2203.03182), rough calibration; Fischler and Bolles 1981", table());
}

}  // namespace croon::stages::ground_extractor
