#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/pipeline/pipeline.hpp"
#include "framework/pipeline/shared_view.hpp"
#include "framework/registration/pose_evidence.hpp"
#include "framework/stage/hypotheses.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/reasons.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  std::vector<params::Slot<Step>> pair;
  params::Slot<Preprocessor> thinning;
  double max_rotation_deg = 0.5;
  double max_translation_m = 0.1;
  double max_violation_ratio = 0.1;
};

/// Files of velocities are read for the steps of the pipeline only.
bool has_no_known_velocity(const Params& params) {
  return std::none_of(params.pair.begin(), params.pair.end(),
                      [](const auto& step) { return step.name() == "known_velocity"; });
}

params::Table<Params> graph_rows() {
  return {
      params::slots<Step>(
          "pair", &Params::pair,
          R"([{"step": "global_alignment", "free_space": 2, "hypotheses": 32}, )"
          R"({"step": "registration", "icp": {"type": "nicp", "max_distances_m": [0.5, 0.3]}}, )"
          R"({"step": "registration", "icp": {"type": "gicp", )"
          R"("normal_neighbours": 10, "direction_balance": 0.5, "max_distances_m": [0.3], )"
          R"("kernel_width_m": 0.05}}, )"
          R"({"step": "verdict", "max_split_rotation_deg": 1.0, "split_overlap": true}, )"
          R"({"step": "covariance"}])",
          "The steps that calibrate one sensor to another; their last ones must judge the pose and "
          "estimate its covariance."),
      params::slot("thinning", &Params::thinning,
                   R"({"type": "voxel_downsample", "leaf_size_m": 0.25})",
                   "Equalises the density of the clouds for the test of free space."),
      params::number("max_rotation_deg", &Params::max_rotation_deg, {0.0, 180.0},
                     "Maximum rotation between poses of a sensor by way of different sensors; "
                     "beyond it they contradict each other."),
      params::number("max_translation_m", &Params::max_translation_m, {0.0, 1e6},
                     "The same for the translation."),
      params::number("max_violation_ratio", &Params::max_violation_ratio, {0.0, 1.0},
                     "Maximum share of the points of two accepted sensors that lie in the free "
                     "space of the other; beyond it one of the two is wrong."),
  };
}

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      graph_rows().require(has_no_known_velocity, "pair must not contain known_velocity");
  return table;
}

/// The sensors of one scene as a graph: nodes are the reference and the sensors, edges the accepted
/// poses of pairs. Grows from the reference by breadth-first search.
class SceneGraph {
 public:
  SceneGraph(const Params& params, const RigGroup& members, const StreamKey& key)
      : params_(params), key_(key) {
    for (RigEstimate* const member : members) {
      if (is_accepted(*member)) {
        connected_.push_back(member);
      } else if (member->estimate.extras.find(kAmbiguous) == nullptr) {
        pending_.push_back(member);
      }
      if (member->estimate.extras.find(kMotionInDoubt) != nullptr) may_have_moved_ = true;
    }
  }

  /// Connects sensors by way of others until none is left or none can be connected; but nothing if
  /// the rig may have moved, because sensors that scan the same surfaces at different times agree
  /// on wrong poses. A sensor with two poses that fit about as well stays rejected: in periodic
  /// surroundings, another sensor sees the same period.
  void grow() {
    if (may_have_moved_) return;
    std::vector<const RigEstimate*> front(connected_.begin(), connected_.end());
    front.push_back(kReference);
    while (!front.empty() && !pending_.empty()) {
      const std::vector<Edge> edges = edges_between(front, pending_);
      std::vector<RigEstimate*> added;
      for (RigEstimate* const sensor : pending_) {
        std::vector<const Edge*> to_sensor;
        for (const Edge& edge : edges) {
          if (edge.to == sensor && edge.is_accepted()) to_sensor.push_back(&edge);
        }
        if (!to_sensor.empty() && connect(*sensor, to_sensor)) added.push_back(sensor);
      }
      for (RigEstimate* const sensor : added) {
        pending_.erase(std::find(pending_.begin(), pending_.end(), sensor));
        connected_.push_back(sensor);
      }
      front.assign(added.begin(), added.end());
    }
  }

  /// Tells for each sensor that is still not connected relative to which others its pose was found.
  void name_parts() {
    if (may_have_moved_) return;
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < pending_.size(); ++i) {
      for (std::size_t j = i + 1; j < pending_.size(); ++j) {
        if (is_at_rest(pending_[i]->estimate.extras) && is_at_rest(pending_[j]->estimate.extras)) {
          edges.push_back({pending_[i], pending_[j]});
        }
      }
    }
    for_each_in_parallel(edges.size(), [&](std::size_t i) { calibrate(edges[i]); });
    for (RigEstimate* const sensor : pending_) {
      std::vector<std::string> others;
      for (const Edge& edge : edges) {
        if (!edge.is_accepted() || (edge.from != sensor && edge.to != sensor)) continue;
        others.push_back(edge.from == sensor ? edge.to->source : edge.from->source);
      }
      if (others.empty()) continue;
      add_reason(*sensor, "its pose was found relative to " + list_text(others) +
                              ", but not to the reference");
    }
  }

  /// Rejects sensors that contradict others: points of one lie in the free space of the other. The
  /// sensor with the most contradictions first, with those that were connected by way of it; of two
  /// that contradict only each other, both.
  void reject_contradictions() {
    const std::size_t n = connected_.size();
    std::vector<std::vector<double>> violations(n, std::vector<double>(n, 0.0));
    for_each_in_parallel(n * n, [&](std::size_t pair) {
      const std::size_t i = pair / n, j = pair % n;
      if (i < j) violations[i][j] = violation_ratio(*connected_[i], *connected_[j]);
    });
    const auto contradicts = [&](std::size_t i, std::size_t j) {
      return violations[std::min(i, j)][std::max(i, j)] > params_.max_violation_ratio;
    };
    std::vector<bool> is_out(n, false);
    for (;;) {
      std::vector<std::size_t> counts(n, 0);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          if (i != j && !is_out[i] && !is_out[j] && contradicts(i, j)) ++counts[i];
        }
      }
      const std::size_t most = n == 0 ? 0 : *std::max_element(counts.begin(), counts.end());
      if (most == 0) return;
      const std::vector<bool> was_out = is_out;
      for (std::size_t i = 0; i < n; ++i) {
        if (counts[i] != most) continue;
        is_out[i] = true;
        std::size_t other = 0;
        while (other == i || was_out[other] || !contradicts(i, other)) ++other;
        reject(*connected_[i], *connected_[other],
               violations[std::min(i, other)][std::max(i, other)]);
      }
      reject_dependents(is_out);
    }
  }

 private:
  /// Rejects sensors that were calibrated by way of one that `is_out`. Connected sensors are after
  /// those by way of which they were connected.
  void reject_dependents(std::vector<bool>& is_out) {
    for (std::size_t i = 0; i < connected_.size(); ++i) {
      const auto way = way_of_.find(connected_[i]);
      if (is_out[i] || way == way_of_.end() || way->second == kReference) continue;
      const auto from = std::find(connected_.begin(), connected_.end(), way->second);
      if (!is_out[static_cast<std::size_t>(from - connected_.begin())]) continue;
      is_out[i] = true;
      Estimate& estimate = connected_[i]->estimate;
      estimate.rejection =
          with_reason(estimate.rejection,
                      "it was calibrated by way of " + way->second->source + ", which is rejected");
    }
  }

  static constexpr const RigEstimate* kReference = nullptr;

  /// The pose of a sensor relative to another one, or to the reference, by the steps `pair`.
  struct Edge {
    const RigEstimate* from = kReference;
    const RigEstimate* to = nullptr;
    PipelineResult result = {};

    bool is_accepted() const {
      return result.failure.empty() && !result.estimate.rejection && result.estimate.covariance;
    }
    /// The pose of `to` in the frame of the reference.
    RigidTransform T_reference_to() const {
      const RigidTransform& T = result.estimate.T_target_source;
      return from == kReference ? T : from->estimate.T_target_source * T;
    }
    PoseCovariance covariance() const {
      if (from == kReference) return *result.estimate.covariance;
      return composed_covariance(from->estimate.T_target_source, *from->estimate.covariance,
                                 result.estimate.T_target_source, *result.estimate.covariance);
    }
    const std::string& from_name() const { return from == kReference ? to->target : from->source; }
  };

  static bool is_accepted(const RigEstimate& member) {
    return member.failure.empty() && !member.estimate.rejection && member.estimate.covariance;
  }

  /// Edges between sensors at rest: a moving sensor whose pose was wrong was deskewed wrongly, and
  /// cannot be compared.
  std::vector<Edge> edges_between(const std::vector<const RigEstimate*>& from,
                                  const std::vector<RigEstimate*>& to) const {
    std::vector<Edge> edges;
    for (const RigEstimate* const a : from) {
      if (a != kReference && !is_at_rest(a->estimate.extras)) continue;
      for (const RigEstimate* const b : to) {
        if (is_at_rest(b->estimate.extras)) edges.push_back({a, b});
      }
    }
    for_each_in_parallel(edges.size(), [&](std::size_t i) { calibrate(edges[i]); });
    return edges;
  }

  void calibrate(Edge& edge) const {
    const Estimate& to = edge.to->estimate;
    if (edge.from == kReference) {
      edge.result = at_start(to.target, to.source, to.initial_guess);
    } else {
      const Estimate& from = edge.from->estimate;
      const RigidTransform& T_reference_from =
          is_accepted(*edge.from) ? from.T_target_source : from.initial_guess;
      edge.result = at_start(from.source, to.source, T_reference_from.inverse() * to.initial_guess);
    }
    const StreamKey key = key_.with(edge.from_name()).with(edge.to->source);
    for (std::size_t i = 0; i < params_.pair.size(); ++i) {
      advance(edge.result, {params_.pair[i].name() + std::to_string(i), params_.pair[i]}, key);
    }
    if (edge.result.failure.empty() && !edge.result.estimate.covariance) {
      throw StageError("the steps of pair estimate no covariance");
    }
  }

  /// Sets the pose of `sensor` from the most certain of the `edges` to it. Returns false, and
  /// rejects the sensor, if their poses differ.
  bool connect(RigEstimate& sensor, const std::vector<const Edge*>& edges) {
    const PoseBounds bounds = {rad_from_deg(params_.max_rotation_deg), params_.max_translation_m};
    const Edge* best = edges.front();
    for (const Edge* const edge : edges) {
      for (const Edge* const other : edges) {
        if (agree(edge->T_reference_to(), other->T_reference_to(), bounds)) continue;
        refuse(sensor, *edge, *other);
        return false;
      }
      if (edge->covariance().matrix.trace() < best->covariance().matrix.trace()) best = edge;
    }
    Estimate& estimate = sensor.estimate;
    estimate.set_pose(best->T_reference_to());
    estimate.covariance = best->covariance();
    estimate.rejection.reset();
    // The search from the reference found them, and this pose is not from that search.
    estimate.extras.put(kHypotheses, std::vector<Hypothesis>());
    estimate.diagnostics = {{"edges", static_cast<double>(edges.size())}};
    sensor.failure.clear();
    way_of_[&sensor] = best->from;
    return true;
  }

  /// Adds the contradiction of two edges to the failure or the rejection of `sensor`.
  static void refuse(RigEstimate& sensor, const Edge& a, const Edge& b) {
    const PoseError apart = pose_error(a.T_reference_to(), b.T_reference_to());
    const std::string reason = "the poses by way of " + a.from_name() + " and " + b.from_name() +
                               " differ by " + fixed_number(deg_from_rad(apart.rotation_rad), 3) +
                               " degrees and " + fixed_number(apart.translation_m, 3) + " m";
    add_reason(sensor, reason);
  }

  /// Adds a reason to the failure or the rejection of `sensor`.
  static void add_reason(RigEstimate& sensor, const std::string& reason) {
    if (sensor.failure.empty()) {
      sensor.estimate.rejection = with_reason(sensor.estimate.rejection, reason);
    } else {
      sensor.failure = with_reason(sensor.failure, reason);
    }
  }

  /// The share of the points of two sensors that lie in each other's free space; 0 if a cloud
  /// cannot be compared.
  double violation_ratio(const RigEstimate& a, const RigEstimate& b) const {
    try {
      const RigidTransform T_a_b =
          a.estimate.T_target_source.inverse() * b.estimate.T_target_source;
      return pose_evidence(*shared_view(*a.estimate.source, params_.thinning),
                           *shared_view(*b.estimate.source, params_.thinning), T_a_b)
          .violation_ratio();
    } catch (const StageError&) {
      return 0.0;
    }
  }

  void reject(RigEstimate& sensor, const RigEstimate& other, double violation_ratio) const {
    sensor.estimate.rejection = with_reason(
        sensor.estimate.rejection,
        "it contradicts " + other.source + ": " + fixed_number(100.0 * violation_ratio, 1) +
            " % of their points lie in each other's free space, and at most " +
            fixed_number(100.0 * params_.max_violation_ratio, 1) + " % may");
  }

  const Params& params_;
  StreamKey key_;
  std::vector<RigEstimate*> connected_, pending_;
  bool may_have_moved_ = false;
  /// By connected sensor: the one, or the reference, by way of which it was connected.
  std::map<const RigEstimate*, const RigEstimate*> way_of_;
};

class SensorGraph final : public RigStep {
 public:
  explicit SensorGraph(Params params) : params_(std::move(params)) {}

  static params::DataFlow data_flow(const Params& params) {
    params::DataFlow flow = params.thinning.flow();
    for (const params::Slot<Step>& step : params.pair) {
      flow.add_channels(step.flow());  // Not the extras: they pass from step to step of a pair.
    }
    flow.add(takes(kCovariance));
    return flow;
  }

  bool sees_failures() const override { return true; }

  void adjust(std::vector<RigEstimate>& rig, Rng& rng) const override {
    const StreamKey key(rng.bits());
    const auto key_of = [](const RigEstimate& member) -> std::optional<RigKey> {
      return RigKey{member.scene, member.target};
    };
    for_each_group(rig_groups(rig, key_of), [&](const RigGroup& scene) {
      SceneGraph graph(params_, scene, key.with(scene.front()->scene));
      graph.grow();
      graph.name_parts();
      graph.reject_contradictions();
    });
  }

 private:
  Params params_;
};

}  // namespace

StageEntry sensor_graph() {
  return stage_entry<SensorGraph>(
      "sensor_graph",
      "Processes the whole rig: connects sensors that could not be calibrated to the reference by "
      "way of other sensors, rejects those that contradict others, and names parts of the rig that "
      "are not connected to the reference.",
      "croon", table(), 3);
}

}  // namespace croon::stages::step
