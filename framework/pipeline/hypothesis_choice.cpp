#include "framework/pipeline/hypothesis_choice.hpp"

#include <algorithm>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/pipeline/shared_view.hpp"
#include "framework/registration/pose_evidence.hpp"

namespace croon {
namespace {

/// The points of the cloud that are used to refine its poses.
std::shared_ptr<const Cloud> refinement_sample(const Cloud& cloud, const HypothesisChoice& choice) {
  return cloud.once<Cloud>("refinement_sample", choice.thinning.resolved(), [&] {
    constexpr int kPoints = 400;
    const auto view = shared_view(cloud, choice.thinning);
    const Cloud& thinned = *view->thinned;
    Points sample;
    for (const int i : balanced_sample(thinned, view->normal_neighbours, kPoints)) {
      sample.push_back(thinned.points()[i]);
    }
    return thinned.derived(std::move(sample), "sample");
  });
}

/// The poses that are not near a better one, best first.
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

PoseBounds bounds_of(const HypothesisChoice& choice) {
  return {rad_from_deg(choice.max_rotation_deg), choice.max_translation_m};
}

/// The refined poses with their scores, best first, no two near each other.
std::vector<Hypothesis> judged(const std::vector<Hypothesis>& poses, const Estimate& estimate,
                               const HypothesisChoice& choice) {
  const auto target = shared_view(*estimate.target, choice.thinning);
  const auto source = shared_view(*estimate.source, choice.thinning);
  const auto sample = refinement_sample(*estimate.source, choice);
  std::vector<Hypothesis> refined;
  const PoseBounds bounds = bounds_of(choice);
  for (const Hypothesis& pose : poses) {
    try {
      const RigidTransform T =
          choice.icp->align(*target->thinned, *sample, pose.T_target_source).T_target_source;
      if (choice.use_start && !agree(T, estimate.T_target_source, bounds)) continue;
      refined.push_back({T, pose_evidence(*target, *source, T).score()});
    } catch (const StageError&) {
      continue;  // Too few points correspond.
    }
  }
  return apart(std::move(refined));
}

}  // namespace

params::DataFlow HypothesisChoice::flow() const {
  params::DataFlow flow = thinning.flow();
  flow.add(icp.flow());
  flow.add(use_start ? gives(kHypotheses, kSearchRegion) : gives(kHypotheses));
  return flow;
}

const params::Table<HypothesisChoice>& hypothesis_choice_table() {
  static const params::Table<HypothesisChoice> table = {
      params::slot("thinning", &HypothesisChoice::thinning,
                   R"({"type": "voxel_downsample", "leaf_size_m": 0.25})",
                   "Thins the clouds evenly, so that numbers of points measure area."),
      params::slot("icp", &HypothesisChoice::icp,
                   R"({"type": "point_to_plane", "max_distances_m": [1.5, 0.8, 0.4], )"
                   R"("max_iterations": 8, "max_coarse_points": 300, "normal_neighbours": 10, )"
                   R"("rotation_tolerance_deg": 0.05, "translation_tolerance_m": 0.005})",
                   "Refines each hypothesis before the comparison."),
      params::boolean("use_start", &HypothesisChoice::use_start,
                      "Whether poses beyond max_rotation_deg or max_translation_m from the start "
                      "are discarded; otherwise the start is ignored."),
      params::number("max_rotation_deg", &HypothesisChoice::max_rotation_deg, {0.0, 180.0},
                     "Maximum rotation from the start, see use_start."),
      params::number("max_translation_m", &HypothesisChoice::max_translation_m, {0.0, 1e6},
                     "Maximum translation from the start, see use_start."),
  };
  return table;
}

void sort_by_score(std::vector<Hypothesis>& poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
}

void require_points(const Cloud& cloud, const char* whose) {
  if (cloud.empty()) throw StageError(std::string("the ") + whose + " cloud is empty");
}

std::shared_ptr<const SensorView> view_of(const Cloud& cloud, const HypothesisChoice& choice,
                                          const char* whose) {
  require_points(cloud, whose);
  return shared_view(cloud, choice.thinning);
}

Estimate at_best(Estimate estimate, const std::vector<Hypothesis>& proposed,
                 const HypothesisChoice& choice) {
  std::vector<Hypothesis> candidates = proposed;
  // Along a periodic street, all proposals may be elsewhere.
  if (choice.use_start) candidates.push_back({estimate.T_target_source, 0.0});
  std::vector<Hypothesis> poses = judged(candidates, estimate, choice);
  if (poses.empty()) throw StageError("no pose was found at which the clouds agree");
  if (choice.use_start) {
    estimate.extras.put(kSearchRegion, {estimate.T_target_source, bounds_of(choice)});
  }
  estimate.set_pose(poses.front().T_target_source);
  estimate.diagnostics = {{"score", poses.front().score},
                          {"hypotheses", static_cast<double>(poses.size())}};
  if (poses.size() > 1) estimate.diagnostics.emplace_back("next_score", poses[1].score);
  estimate.extras.put(kHypotheses, std::move(poses));
  return estimate;
}

}  // namespace croon
