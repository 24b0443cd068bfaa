#include "experiments/run/trial.hpp"

#include <algorithm>
#include <chrono>

#include "experiments/run/starts.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

TrialRecord failed(const TrialId& id, const std::string& reason) {
  TrialRecord record;
  record.id = id;
  record.status = Status::failed;
  record.reason = reason;
  return record;
}

bool is_finite(const RigidTransform& T) {
  return T.rotation.allFinite() && T.translation.allFinite();
}

bool is_within(const PoseError& error, const SuccessBounds& bounds) {
  return error.rotation_rad <= rad_from_deg(bounds.rotation_deg) &&
         error.translation_m <= bounds.translation_m;
}

/// The faults without the file's path: a reason must not depend on the data root.
std::string reasons(const InputError& error) {
  std::string text;
  for (const Fault& fault : error.faults()) {
    text += (text.empty() ? "" : "; ") + Fault{"", fault.where, fault.message}.line();
  }
  return text;
}

/// Reads the points of `scan`. Returns why they could not be read, or an empty string.
std::string read_points(const SensorScan& scan, PointCloud& points) {
  try {
    points = scan.load().points;
  } catch (const InputError& error) {
    return reasons(error);
  }
  const auto is_finite_point = [](const Eigen::Vector3f& point) { return point.allFinite(); };
  return std::any_of(points.begin(), points.end(), is_finite_point) ? "" : "it has no points";
}

/// Completes the record of a trial whose pipeline did not fail.
void finish(TrialRecord& record, const Estimate& estimate, const SensorScan& scan,
            const SuccessBounds& bounds) {
  if (!is_finite(estimate.T_target_source)) {
    record.reason = "the pose is not finite";
    return;
  }
  record.T_reference_sensor = estimate.T_target_source;
  if (scan.truth) record.error = pose_error(estimate.T_target_source, *scan.truth);
  const bool is_good = !record.error || is_within(*record.error, bounds);
  record.status = is_good ? Status::success : Status::inaccurate;
  if (estimate.rejection) {
    record.status = Status::rejected;
    record.reason = *estimate.rejection;
  }
}

}  // namespace

LoadedScan load_scan(const SensorScan& scan, const std::string& scene, std::uint64_t seed) {
  const auto start = std::chrono::steady_clock::now();
  LoadedScan loaded;
  PointCloud points;
  const std::string why_not = read_points(scan, points);
  if (why_not.empty()) {
    const StreamKey key = StreamKey(seed).with("cloud").with(scene).with(scan.sensor);
    loaded.cloud = std::make_shared<const Cloud>(std::move(points), key);
  } else {
    loaded.failure = "the cloud of " + scan.sensor + ": " + why_not;
  }
  loaded.reading_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return loaded;
}

void run_start(const Experiment& experiment, const PipelineTree& tree, const Scene& scene,
               const PlannedStart& planned, const LoadedScan& target, const LoadedScan& source,
               const std::function<void(const TrialRecord&)>& at_end) {
  const SensorScan& scan = scene.sensors[planned.sensor];
  const StreamKey key = StreamKey(experiment.seed)
                            .with("trial")
                            .with(scene.name)
                            .with(scan.sensor)
                            .with(static_cast<std::uint64_t>(planned.trial));
  const RigidTransform start = start_of(experiment, scene.name, scan, planned.trial);
  PipelineResult result = at_start(target.cloud, source.cloud, start);
  result.failure = target.failure.empty() ? source.failure : target.failure;
  run_tree(tree, std::move(result), key, [&](std::size_t variant, const PipelineResult& end) {
    TrialRecord record = failed(
        {experiment.variants[variant].name, scene.name, scan.sensor, planned.trial}, end.failure);
    record.steps = end.records;
    if (end.failure.empty()) finish(record, end.estimate, scan, experiment.success);
    at_end(record);
  });
}

}  // namespace croon::experiments
