#include <algorithm>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/params/values.hpp"
#include "framework/pipeline/shared_view.hpp"
#include "framework/registration/layered_map.hpp"
#include "framework/registration/pose_evidence.hpp"
#include "framework/spatial/ground_candidates.hpp"
#include "framework/stage/hypotheses.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"

namespace croon::stages::step {
namespace {

struct Params : LayeredMapOptions {
  params::Slot<Preprocessor> thinning;
  params::Slot<Icp> icp;
  int ground_candidates = 3;
  int peaks = 10;
  int hypotheses = 16;
  bool use_start = false;
  double max_rotation_deg = 45.0;
  double max_translation_m = 0.5;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::slot("thinning", &Params::thinning,
                       R"({"type": "voxel_downsample", "leaf_size_m": 0.25})",
                       "Makes the clouds even, so that numbers of points are areas."),
          params::slot("icp", &Params::icp,
                       R"({"type": "point_to_plane", "max_distances_m": [1.5, 0.8, 0.4], )"
                       R"("max_iterations": 8, "coarse_points": 300, "normal_neighbours": 10, )"
                       R"("rotation_tolerance_deg": 0.05, "translation_tolerance_m": 0.005})",
                       "Refines each hypothesis before they are compared."),
          params::integer("ground_candidates", &Params::ground_candidates, {1, 20},
                          "How many planes of each cloud are tried as its ground."),
          params::integer("peaks", &Params::peaks, {1, 1000},
                          "How many poses of each pair of planes are hypotheses."),
          params::integer("hypotheses", &Params::hypotheses, {1, 1000},
                          "How many hypotheses are refined: the best of each pair of planes, then "
                          "the best of the others."),
          params::boolean("use_start", &Params::use_start,
                          "Poses beyond max_rotation_deg or max_translation_m from the start are "
                          "dropped; without it the start does not matter."),
          params::number("max_rotation_deg", &Params::max_rotation_deg, {0.0, 180.0},
                         "See use_start."),
          params::number("max_translation_m", &Params::max_translation_m, {0.0, 1e6},
                         "See use_start."),
      }
          .inherit(layered_map_table());
  return table;
}

/// The rotation and shift that put a plane to z = 0 with its normal up.
RigidTransform levelling(const Plane& plane) {
  return {rotation_between(plane.normal, Eigen::Vector3d::UnitZ()), {0.0, 0.0, plane.offset_m}};
}

/// A cloud above one of its planes.
struct Levelled {
  RigidTransform T_level_cloud;
  Points points;
};

/// What is known of one cloud alone.
struct Scan {
  std::shared_ptr<const SensorView> view;
  std::shared_ptr<const Cloud> sample;  ///< The points that hypotheses are refined with.
  std::vector<Levelled> levels;         ///< Above each plane that may be the ground.
};

void sort_by_score(std::vector<Hypothesis>& poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
}

/// The best poses that are not near a better one.
std::vector<Hypothesis> apart(std::vector<Hypothesis> poses) {
  sort_by_score(poses);
  std::vector<Hypothesis> kept;
  for (const Hypothesis& pose : poses) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Hypothesis& other) {
      return agree(pose.T_target_source, other.T_target_source, kSameHypothesis);
    });
    if (is_new) kept.push_back(pose);
  }
  return kept;
}

class GlobalAlignment final : public Step {
 public:
  explicit GlobalAlignment(Params params) : params_(std::move(params)) {}

  static params::DataFlow data_flow(const Params& params) {
    params::DataFlow flow = params.thinning.flow();
    flow.add(params.icp.flow());
    flow.gives.push_back(kHypotheses.doc());
    return flow;
  }

  Estimate advance(Estimate estimate, Rng&) const override {
    const auto target = scan_of(*estimate.target, "reference");
    const auto source = scan_of(*estimate.source, "sensor");
    std::vector<Hypothesis> poses =
        judged(proposed(*estimate.target, *target, *source), *target, *source);
    if (params_.use_start) poses = near_start(poses, estimate.T_target_source);
    if (poses.empty()) throw StageError("no pose was found at which the clouds agree");
    estimate.T_target_source = poses.front().T_target_source;
    estimate.diagnostics = {{"score", poses.front().score},
                            {"hypotheses", static_cast<double>(poses.size())}};
    if (poses.size() > 1) estimate.diagnostics.emplace_back("next_score", poses[1].score);
    estimate.extras.put(kHypotheses, std::move(poses));
    return estimate;
  }

 private:
  std::shared_ptr<const Scan> scan_of(const Cloud& cloud, const char* whose) const {
    if (cloud.empty()) throw StageError(std::string("the ") + whose + " cloud is empty");
    const std::string what = "global_alignment";
    const std::string parameters =
        params_.thinning.resolved() + " " + std::to_string(params_.ground_candidates);
    const auto scan = cloud.once<Scan>(what, parameters, [&] {
      constexpr int kPoints = 400;
      Scan made{shared_view(cloud, params_.thinning), nullptr, {}};
      const Cloud& thinned = *made.view->thinned;
      Points sample;
      for (const int i : balanced_sample(thinned, made.view->normal_neighbours, kPoints)) {
        sample.push_back(thinned.points()[i]);
      }
      made.sample = thinned.derived(std::move(sample), "sample");
      GroundCandidateOptions options;
      options.candidates = params_.ground_candidates;
      Rng rng = cloud.rng(what);
      for (const auto& ground : croon::ground_candidates(thinned.points(), options, rng)) {
        const RigidTransform T_level_cloud = levelling(ground.plane);
        made.levels.push_back({T_level_cloud, transformed(thinned.points(), T_level_cloud)});
      }
      return std::make_shared<const Scan>(std::move(made));
    });
    if (scan->levels.empty()) {
      throw StageError(std::string("the ") + whose + " cloud has no plane that may be the ground");
    }
    return scan;
  }

  /// The poses at which the maps above a pair of planes coincide, of all pairs; those that are
  /// to be refined.
  std::vector<Hypothesis> proposed(const Cloud& cloud, const Scan& target,
                                   const Scan& source) const {
    std::vector<Hypothesis> first;
    std::vector<Hypothesis> others;
    for (std::size_t k = 0; k < target.levels.size(); ++k) {
      const auto view = cloud.once<LayeredMap>("layered_map", map_key(k), [&] {
        return std::make_shared<const LayeredMap>(target.levels[k].points, params_);
      });
      const RigidTransform T_target_level = target.levels[k].T_level_cloud.inverse();
      for (const Levelled& above : source.levels) {
        const std::vector<MapPeak> peaks = view->match(above.points, params_.peaks);
        for (std::size_t i = 0; i < peaks.size(); ++i) {
          const RigidTransform T_level_level{
              rotation_exp(peaks[i].yaw_rad * Eigen::Vector3d::UnitZ()),
              {peaks[i].x_m, peaks[i].y_m, 0.0}};
          (i == 0 ? first : others)
              .push_back({T_target_level * T_level_level * above.T_level_cloud, peaks[i].score});
        }
      }
    }
    if (first.empty()) {
      // Nothing stands on the ground in both clouds: the planes alone give roll, pitch and z.
      first.push_back(
          {target.levels.front().T_level_cloud.inverse() * source.levels.front().T_level_cloud,
           0.0});
    }
    sort_by_score(first);
    sort_by_score(others);
    first.insert(first.end(), others.begin(), others.end());
    first.resize(std::min(first.size(), static_cast<std::size_t>(params_.hypotheses)));
    return first;
  }

  /// The poses refined, with their evidence, best first, apart from each other.
  std::vector<Hypothesis> judged(const std::vector<Hypothesis>& poses, const Scan& target,
                                 const Scan& source) const {
    std::vector<Hypothesis> refined;
    for (const Hypothesis& pose : poses) {
      try {
        const RigidTransform T =
            params_.icp->align(*target.view->thinned, *source.sample, pose.T_target_source)
                .T_target_source;
        refined.push_back({T, pose_evidence(*target.view, *source.view, T, {}).score()});
      } catch (const StageError&) {
        continue;  // Too few points correspond.
      }
    }
    return apart(std::move(refined));
  }

  std::vector<Hypothesis> near_start(const std::vector<Hypothesis>& poses,
                                     const RigidTransform& start) const {
    const PoseBounds bounds{rad_from_deg(params_.max_rotation_deg), params_.max_translation_m};
    std::vector<Hypothesis> near;
    for (const Hypothesis& pose : poses) {
      if (agree(pose.T_target_source, start, bounds)) near.push_back(pose);
    }
    return near;
  }

  /// All that the target's map above plane `index` depends on.
  std::string map_key(std::size_t index) const {
    return std::to_string(index) + " " + params_.thinning.resolved() + " " +
           std::to_string(params_.ground_candidates) + " " +
           layered_map_table().members_json(params_);
  }

  Params params_;
};

}  // namespace

StageEntry global_alignment() {
  return stage_entry<GlobalAlignment>(
      "global_alignment",
      "Finds the pose without a start: planes of both clouds propose the ground, a correlation of "
      "maps from above over all yaws proposes poses, overlap and free space choose between them.",
      "croon; correlation after Olson, Real-time correlative scan matching, 2009", table());
}

}  // namespace croon::stages::step
