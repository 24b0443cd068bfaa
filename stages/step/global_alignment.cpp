#include <algorithm>
#include <functional>
#include <limits>

#include "framework/base/error.hpp"
#include "framework/pipeline/hypothesis_choice.hpp"
#include "framework/registration/layered_map.hpp"
#include "framework/spatial/ground_candidates.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::step {
namespace {

struct Params : LayeredMapOptions, HypothesisChoice {
  int ground_candidates = 3;
  int peaks = 10;
  int hypotheses = 16;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::integer("ground_candidates", &Params::ground_candidates, {1, 20},
                          "Number of planes of each cloud that are tried as its ground."),
          params::integer("peaks", &Params::peaks, {1, 1000},
                          "Number of hypotheses for each pair of planes."),
          params::integer("hypotheses", &Params::hypotheses, {1, 1000},
                          "Number of hypotheses that are refined: the best of each pair of planes, "
                          "then the best of the others."),
      }
          .inherit(hypothesis_choice_table())
          .inherit(layered_map_table());
  return table;
}

/// The transform that moves a plane to z = 0 with its normal up.
RigidTransform levelling(const Plane& plane) {
  return {rotation_between(plane.normal, Eigen::Vector3d::UnitZ()), {0.0, 0.0, plane.offset_m}};
}

/// A cloud in the frame of one of its planes.
struct Levelled {
  RigidTransform T_level_cloud;
  Points points;
};

/// A cloud in the frame of each of its ground candidates.
using Levels = std::vector<Levelled>;

class GlobalAlignment final : public Step {
 public:
  explicit GlobalAlignment(Params params) : params_(std::move(params)) {}

  static params::DataFlow data_flow(const Params& params) { return params.flow(); }

  Estimate advance(Estimate estimate, Rng&) const override {
    const auto target = levels_of(*estimate.target, "reference");
    const auto source = levels_of(*estimate.source, "sensor");
    const std::vector<Hypothesis> poses = proposed(*estimate.target, *target, *source);
    return at_best(std::move(estimate), poses, params_);
  }

 private:
  std::shared_ptr<const Levels> levels_of(const Cloud& cloud, const char* whose) const {
    const auto view = view_of(cloud, params_, whose);
    const std::string what = "global_alignment";
    const std::string parameters =
        params_.thinning.resolved() + " " + std::to_string(params_.ground_candidates);
    const auto levels = cloud.once<Levels>(what, parameters, [&] {
      const Points& thinned = view->thinned->points();
      GroundCandidateOptions options;
      options.candidates = params_.ground_candidates;
      Rng rng = cloud.rng(what);
      Levels made;
      for (const auto& ground : croon::ground_candidates(thinned, options, rng)) {
        const RigidTransform T_level_cloud = levelling(ground.plane);
        made.push_back({T_level_cloud, transformed(thinned, T_level_cloud)});
      }
      return std::make_shared<const Levels>(std::move(made));
    });
    if (levels->empty()) {
      throw StageError(std::string("the ") + whose + " cloud has no plausible ground plane");
    }
    return levels;
  }

  /// The hypotheses to be refined: the poses at which the maps above each pair of planes match.
  std::vector<Hypothesis> proposed(const Cloud& cloud, const Levels& target,
                                   const Levels& source) const {
    std::vector<Hypothesis> first;
    std::vector<Hypothesis> others;
    std::vector<TurnedCells> cells;
    for (const Levelled& above : source) cells.emplace_back(above.points, params_);
    for (std::size_t k = 0; k < target.size(); ++k) {
      const auto view = cloud.once<LayeredMap>("layered_map", map_key(k), [&] {
        return std::make_shared<const LayeredMap>(target[k].points,
                                                  target[k].T_level_cloud.translation.z(), params_);
      });
      const RigidTransform T_target_level = target[k].T_level_cloud.inverse();
      for (std::size_t n = 0; n < source.size(); ++n) {
        const std::vector<MapPeak> peaks =
            view->match(cells[n], params_.peaks, min_score(others, first.size() + 1));
        for (std::size_t i = 0; i < peaks.size(); ++i) {
          const RigidTransform T_level_level{
              rotation_exp(peaks[i].yaw_rad * Eigen::Vector3d::UnitZ()),
              {peaks[i].x_m, peaks[i].y_m, 0.0}};
          (i == 0 ? first : others)
              .push_back(
                  {T_target_level * T_level_level * source[n].T_level_cloud, peaks[i].score});
        }
      }
    }
    if (first.empty()) {
      // The clouds have no objects above the ground in common: the planes alone determine roll,
      // pitch and z.
      first.push_back({target.front().T_level_cloud.inverse() * source.front().T_level_cloud, 0.0});
    }
    sort_by_score(first);
    sort_by_score(others);
    first.insert(first.end(), others.begin(), others.end());
    first.resize(std::min(first.size(), static_cast<std::size_t>(params_.hypotheses)));
    return first;
  }

  /// The score that the next of the `others` must reach to be refined, as far as is known.
  double min_score(const std::vector<Hypothesis>& others, std::size_t firsts) const {
    const auto all = static_cast<std::size_t>(params_.hypotheses);
    if (firsts >= all) return std::numeric_limits<double>::infinity();
    if (others.size() < all - firsts) return 0.0;
    std::vector<double> scores;
    for (const Hypothesis& pose : others) scores.push_back(pose.score);
    const auto last = scores.begin() + static_cast<std::ptrdiff_t>(all - firsts - 1);
    std::nth_element(scores.begin(), last, scores.end(), std::greater<>());
    return *last;
  }

  /// Identifies everything that the target's map above plane `index` depends on.
  std::string map_key(std::size_t index) const {
    return std::to_string(index) + " " + params_.thinning.resolved() + " " +
           std::to_string(params_.ground_candidates) + " " + layered_map_table().json(params_);
  }

  Params params_;
};

}  // namespace

StageEntry global_alignment() {
  return stage_entry<GlobalAlignment>(
      "global_alignment",
      "Finds the pose without an initial guess: selects ground candidates in both clouds, "
      "correlates their bird's-eye maps over all yaws, and chooses among the poses by overlap and "
      "free space.",
      "croon; correlation after Olson, Real-time correlative scan matching, 2009", table(), 3);
}

}  // namespace croon::stages::step
