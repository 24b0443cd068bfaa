#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/pipeline/shared_view.hpp"
#include "framework/registration/constraint.hpp"
#include "framework/registration/pose_evidence.hpp"
#include "framework/registration/rival_poses.hpp"
#include "framework/stage/hypotheses.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/reasons.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  params::Slot<Preprocessor> thinning;
  params::Slot<Icp> icp;
  double min_overlap_ratio = 0.15;
  double max_violation_ratio = 0.05;
  double max_violation_ratio_at_rest = 0.05;
  double min_lead = 6.0;
  double max_shift_m = 10.0;
  double min_constraint_ratio = 0.01;
  double max_split_rotation_deg = 0.5;
  double max_split_translation_m = 0.1;
  double split_offset_m = 0.2;
  int split_directions = 2;
  bool split_overlap = false;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::slot("thinning", &Params::thinning,
                   R"({"type": "voxel_downsample", "leaf_size_m": 0.25})",
                   "Equalises the density of the clouds, so that numbers of points measure area."),
      params::slot(
          "icp", &Params::icp,
          R"({"type": "point_to_plane", "max_distances_m": [0.8, 0.4], )"
          R"("max_iterations": 20, "normal_neighbours": 10, "rotation_tolerance_deg": 0.01, )"
          R"("translation_tolerance_m": 0.001})",
          "Registers each half of the points, and the rival poses."),
      params::number("min_overlap_ratio", &Params::min_overlap_ratio, {0.0, 1.0},
                     "Minimum share of agreeing points among those that both sensors should see."),
      params::number("max_violation_ratio", &Params::max_violation_ratio, {0.0, 1.0},
                     "Maximum share of these points that lie in free space of the other sensor."),
      params::number("max_violation_ratio_at_rest", &Params::max_violation_ratio_at_rest,
                     {0.0, 1.0},
                     "The same if the rig is at rest, where less of what it sees moves between the "
                     "scans."),
      params::number(
          "min_lead", &Params::min_lead, {-1e3, 1e3},
          "Minimum lead of the pose over each of its rivals, in standard deviations, from "
          "the points visible at both poses. Rivals are the other poses that a search "
          "found, and shifts along weakly constrained directions."),
      params::number("max_shift_m", &Params::max_shift_m, {0.0, 100.0},
                     "Maximum shift of a rival that is looked for."),
      params::number("min_constraint_ratio", &Params::min_constraint_ratio, {0.0, 1.0},
                     "Minimum share of the points' mean squared motion that is normal to their "
                     "surfaces, in the least constrained direction.")
          .formerly("min_strength"),
      params::number(
          "max_split_rotation_deg", &Params::max_split_rotation_deg, {0.0, 180.0},
          "Maximum rotation between the pose and the poses of two disjoint halves of the points.")
          .formerly("max_halves_rotation_deg"),
      params::number("max_split_translation_m", &Params::max_split_translation_m, {0.0, 1e6},
                     "Maximum distance between these poses.")
          .formerly("max_halves_translation_m"),
      params::number("split_offset_m", &Params::split_offset_m, {0.0, 10.0},
                     "Distance to either side, along a weakly constrained direction, at which the "
                     "halves start.")
          .formerly("slide_m"),
      params::integer("split_directions", &Params::split_directions, {1, 6},
                      "Number of such directions, the least constrained first.")
          .formerly("slides"),
      params::boolean("split_overlap", &Params::split_overlap,
                      "Whether the halves are of the points near surfaces of the other cloud, "
                      "instead of the whole cloud. If little overlaps, few of the points of the "
                      "whole cloud determine the pose."),
  };
  return table;
}

/// Maximum distance between surfaces in contact.
constexpr double kContact_m = 0.3;

/// Maximum distances between the pose and the poses of two disjoint halves of the points.
struct Halves {
  double rotation_rad = 0.0;
  double translation_m = 0.0;
};

/// Another pose, and the lead over it.
struct Rival {
  RigidTransform T;
  double lead = 0.0;
};

class Verdict final : public Step {
 public:
  explicit Verdict(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    const auto target = shared_view(*estimate.target, params_.thinning);
    const auto source = shared_view(*estimate.source, params_.thinning);
    const RigidTransform T = estimate.T_target_source;
    const PoseEvidence evidence = pose_evidence(*target, *source, T);
    const std::vector<ConstraintDirection> held =
        constraint_directions(*target, *source, T, kContact_m);
    const Halves halves = halves_of(*target, *source, T, held);
    const std::optional<Rival> rival = best_rival(evidence, estimate, *target, *source);
    const double strength = held.empty() ? 0.0 : held.front().strength;
    Reasons reasons;
    reasons.need_at_least("the overlap with agreeing surfaces", evidence.overlap_ratio(),
                          params_.min_overlap_ratio);
    reasons.need_at_most("the share of points in free space", evidence.violation_ratio(),
                         is_at_rest(estimate.extras) ? params_.max_violation_ratio_at_rest
                                                     : params_.max_violation_ratio);
    if (rival) {
      reasons.need_at_least(
          "the lead over a pose " + difference_in_words(rival->T, T) + ", in standard deviations,",
          rival->lead, params_.min_lead);
    }
    add_loose(held, reasons);
    reasons.need_at_most("the rotation between two halves of the points, deg,",
                         deg_from_rad(halves.rotation_rad), params_.max_split_rotation_deg);
    reasons.need_at_most("the distance between two halves of the points, m,", halves.translation_m,
                         params_.max_split_translation_m);
    if (reasons.words) estimate.rejection = reasons.words;
    if (rival && std::abs(rival->lead) < params_.min_lead) estimate.extras.put(kAmbiguous, true);
    estimate.diagnostics = {{"overlap_ratio", evidence.overlap_ratio()},
                            {"violation_ratio", evidence.violation_ratio()},
                            {"score", evidence.score()},
                            {"strength", strength},
                            {"strength_2", held.size() > 1 ? held[1].strength : 0.0},
                            {"strength_3", held.size() > 2 ? held[2].strength : 0.0},
                            {"halves_rotation_deg", deg_from_rad(halves.rotation_rad)},
                            {"halves_translation_m", halves.translation_m}};
    if (rival) estimate.diagnostics.emplace_back("lead", rival->lead);
    return estimate;
  }

 private:
  /// The reasons for a rejection, with their numbers.
  struct Reasons {
    std::optional<std::string> words;
    void add(const std::string& reason) { words = with_reason(words, reason); }
    void need_at_least(const std::string& what, double value, double bound) {
      if (value >= bound) return;
      add(what + " is " + fixed_number(value, 3) + ", below " + fixed_number(bound, 3));
    }
    void need_at_most(const std::string& what, double value, double bound) {
      if (value <= bound) return;
      add(what + " is " + fixed_number(value, 3) + ", above " + fixed_number(bound, 3));
    }
  };

  void add_loose(const std::vector<ConstraintDirection>& held, Reasons& reasons) const {
    if (held.empty()) return reasons.add("no surfaces touch, so nothing is constrained");
    std::vector<ConstraintDirection> loose;
    for (const ConstraintDirection& direction : held) {
      if (direction.strength < params_.min_constraint_ratio) loose.push_back(direction);
    }
    if (loose.empty()) return;
    reasons.add("not constrained: " + dof_names_of(loose) + " (strength " +
                fixed_number(loose.front().strength, 4) + ", below " +
                fixed_number(params_.min_constraint_ratio, 4) + ")");
  }

  /// The points of the sample whose index modulo `parts` is `part`.
  static std::shared_ptr<const Cloud> part_of(const Cloud& cloud, const std::vector<int>& sample,
                                              std::size_t part, std::size_t parts) {
    Points points;
    for (std::size_t i = part; i < sample.size(); i += parts) {
      points.push_back(cloud.points()[sample[i]]);
    }
    return cloud.derived_in_trial(std::move(points), "half");
  }

  /// The points of `source` near surfaces of `target`.
  static std::shared_ptr<const Cloud> overlap_of(const SensorView& target, const SensorView& source,
                                                 const RigidTransform& T) {
    constexpr float kNear_m = 1.0F;
    const KdTree& tree = target.thinned->kd_tree();
    Points near;
    for (const Eigen::Vector3f& point : source.thinned->points()) {
      if (tree.nearest((T * point.cast<double>()).cast<float>(), kNear_m)) near.push_back(point);
    }
    return source.thinned->derived_in_trial(std::move(near), "overlap");
  }

  /// Registers two halves of the points, started on either side of the pose along its least
  /// constrained directions.
  Halves halves_of(const SensorView& target, const SensorView& source, const RigidTransform& T,
                   const std::vector<ConstraintDirection>& held) const {
    constexpr double kNever = 1e3;
    Halves worst;
    const auto cloud = params_.split_overlap ? overlap_of(target, source, T) : source.thinned;
    const std::vector<int> sample = params_.split_overlap
                                        ? balanced_sample(*cloud, source.normal_neighbours,
                                                          static_cast<int>(source.sample.size()))
                                        : source.sample;
    const auto first = part_of(*cloud, sample, 0, 2);
    const auto second = part_of(*cloud, sample, 1, 2);
    for (int i = 0; i < params_.split_directions && i < static_cast<int>(held.size()); ++i) {
      const Vector6d slide = params_.split_offset_m * held[static_cast<std::size_t>(i)].motion;
      try {
        const RigidTransform a =
            params_.icp->align(*target.thinned, *first, moved(T, slide)).T_target_source;
        const RigidTransform b =
            params_.icp->align(*target.thinned, *second, moved(T, -slide)).T_target_source;
        for (const PoseError& apart : {pose_error(a, b), pose_error(a, T), pose_error(b, T)}) {
          worst.rotation_rad = std::max(worst.rotation_rad, apart.rotation_rad);
          worst.translation_m = std::max(worst.translation_m, apart.translation_m);
        }
      } catch (const StageError&) {
        return {kPi, kNever};  // Too few correspondences.
      }
    }
    return worst;
  }

  /// The pose away from that of `estimate` over which its lead is the least, if a global search
  /// looked for poses. std::nullopt if no other pose is comparable.
  std::optional<Rival> best_rival(const PoseEvidence& evidence, const Estimate& estimate,
                                  const SensorView& target, const SensorView& source) const {
    const std::vector<Hypothesis>* const hypotheses = estimate.extras.find(kHypotheses);
    if (hypotheses == nullptr) return std::nullopt;
    std::vector<RigidTransform> proposed;
    for (const Hypothesis& other : *hypotheses) proposed.push_back(other.T_target_source);
    const SearchRegion* const region = estimate.extras.find(kSearchRegion);
    // Bounds for rivals; the right pose may be the one that overlaps less.
    constexpr double kMaxViolationRatio = 0.1;
    constexpr double kMaxScoreGap = 0.2;
    const auto points = part_of(*source.thinned, source.sample, 0, 3);
    std::optional<Rival> best;
    for (const RigidTransform& start :
         rival_poses(target, source, estimate.T_target_source, proposed, params_.max_shift_m)) {
      const RigidTransform T = refined_pose(start, target, *points);
      if (agree(T, estimate.T_target_source, kSameHypothesis)) continue;
      if (region != nullptr && !agree(T, region->start, region->bounds)) continue;
      const PoseEvidence other = pose_evidence(target, source, T);
      if (other.violation_ratio() > kMaxViolationRatio) continue;
      if (other.score() < evidence.score() - kMaxScoreGap) continue;
      const std::optional<double> lead = lead_over(evidence, other);
      if (!lead || (best && *lead >= best->lead)) continue;
      if (*lead < params_.min_lead && !is_determined(T, target, source)) continue;
      best = Rival{T, *lead};
    }
    return best;
  }

  /// Whether two halves of the points agree on the pose of a rival. Along a highway, poses slide
  /// and have about the same evidence everywhere, but only near the right one do the halves agree.
  bool is_determined(const RigidTransform& T, const SensorView& target,
                     const SensorView& source) const {
    const Halves halves =
        halves_of(target, source, T, constraint_directions(target, source, T, kContact_m));
    return halves.rotation_rad <= rad_from_deg(params_.max_split_rotation_deg) &&
           halves.translation_m <= params_.max_split_translation_m;
  }

  /// The refined pose `T`, or `T` itself if too few points correspond.
  RigidTransform refined_pose(const RigidTransform& T, const SensorView& target,
                              const Cloud& points) const {
    try {
      return params_.icp->align(*target.thinned, points, T).T_target_source;
    } catch (const StageError&) {
      return T;
    }
  }

  Params params_;
};

}  // namespace

StageEntry verdict() {
  return stage_entry<Verdict>(
      "verdict",
      "Accepts or rejects the pose by overlap, free space, lead over other poses, unconstrained "
      "directions, and agreement between two halves of the points.",
      "croon; directions after Gelfand et al., 3DIM 2003; the lead "
      "after McNemar, Psychometrika 1947",
      table(), 4);
}

}  // namespace croon::stages::step
