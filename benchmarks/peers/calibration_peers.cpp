// What does a complete calibration of two clouds cost with Open3D, and with the paper's pipeline
// and `best.json`, in one run, and how far off are the poses? Built with
// -DCROON_BENCHMARK_PEERS=ON.

#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/CorrespondenceChecker.h>
#include <open3d/pipelines/registration/FastGlobalRegistration.h>
#include <open3d/pipelines/registration/Feature.h>
#include <open3d/pipelines/registration/GeneralizedICP.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Random.h>

#include "benchmarks/support/calibration.hpp"
#include "benchmarks/support/run.hpp"

namespace croon::benchmarks {
namespace {

namespace reg = open3d::pipelines::registration;
using open3d::geometry::KDTreeSearchParamHybrid;
using PeerCloud = open3d::geometry::PointCloud;

// As in open3d_poses.py: Open3D's own example, at the scale of a street.
constexpr double kVoxelM = 0.4;
constexpr double kMaxMatchM = 1.5 * kVoxelM;
constexpr double kFineVoxelM = 0.1;
constexpr double kMinRangeM = 1.0;

/// What Open3D computes of one cloud.
struct View {
  std::shared_ptr<PeerCloud> fine, thin;
  std::shared_ptr<reg::Feature> features;
};

/// A cloud at one point per 10 cm and per 40 cm, the latter with normals and FPFH features. Points
/// within a metre, on the car itself, are removed.
View view_of(const Points& points) {
  PeerCloud cloud;
  for (const Eigen::Vector3f& point : points) {
    if (point.norm() >= kMinRangeM) cloud.points_.emplace_back(point.cast<double>());
  }
  View view;
  view.fine = cloud.VoxelDownSample(kFineVoxelM);
  view.thin = cloud.VoxelDownSample(kVoxelM);
  view.thin->EstimateNormals(KDTreeSearchParamHybrid(2.0 * kVoxelM, 30));
  view.thin->OrientNormalsTowardsCameraLocation();
  view.features = reg::ComputeFPFHFeature(*view.thin, KDTreeSearchParamHybrid(5.0 * kVoxelM, 100));
  return view;
}

Eigen::Matrix4d by_ransac(const View& source, const View& target) {
  const reg::CorrespondenceCheckerBasedOnEdgeLength edge_length(0.9);
  const reg::CorrespondenceCheckerBasedOnDistance distance(kMaxMatchM);
  return reg::RegistrationRANSACBasedOnFeatureMatching(
             *source.thin, *target.thin, *source.features, *target.features, true, kMaxMatchM,
             reg::TransformationEstimationPointToPoint(false), 3, {edge_length, distance},
             reg::RANSACConvergenceCriteria(100000, 0.999))
      .transformation_;
}

Eigen::Matrix4d by_fast_global_registration(const View& source, const View& target) {
  reg::FastGlobalRegistrationOption option;
  option.maximum_correspondence_distance_ = kMaxMatchM;
  return reg::FastGlobalRegistrationBasedOnFeatureMatching(
             *source.thin, *target.thin, *source.features, *target.features, option)
      .transformation_;
}

using GlobalRegistration = Eigen::Matrix4d (*)(const View& source, const View& target);

/// Everything from two clouds to the refined pose.
RigidTransform calibrated(const CloudPair& pair, GlobalRegistration global) {
  const View target = view_of(pair.target);
  const View source = view_of(pair.source);
  Eigen::Matrix4d pose = global(source, target);
  for (const double max_distance_m : {0.5, 0.2}) {
    pose = reg::RegistrationGeneralizedICP(*source.fine, *target.fine, max_distance_m, pose)
               .transformation_;
  }
  return {pose.topLeftCorner<3, 3>(), pose.topRightCorner<3, 1>()};
}

/// Times `calibrate` of trial 0, 1, …, counted over repetitions; `prepare` is not timed.
template <class Prepare, class Calibrate>
void measure(benchmark::State& state, const CloudPair& pair, std::size_t& trials,
             const Prepare& prepare, const Calibrate& calibrate) {
  AnswerErrors errors;
  for (auto _ : state) {
    state.PauseTiming();
    prepare();
    state.ResumeTiming();
    const Answer answer = calibrate(trials++);
    state.PauseTiming();
    errors.add(answer, pair);
    state.ResumeTiming();
  }
  errors.set_counters(state);
}

void add_croon(const std::string& name, const Method& method, const CloudPair& pair) {
  add(name, benchmark::kMillisecond, [=, trials = std::size_t{0}](benchmark::State& state) mutable {
    Calibration calibration(method, pair);
    measure(
        state, pair, trials, [&] { calibration.forget(); },
        [&](std::size_t trial) { return calibration.run(trial); });
  });
}

void add_peer(const std::string& name, GlobalRegistration global, const CloudPair& pair) {
  add(name, benchmark::kMillisecond, [=, trials = std::size_t{0}](benchmark::State& state) mutable {
    measure(
        state, pair, trials, [] {},
        [&](std::size_t trial) -> Answer {
          // Other random numbers for each trial, instead of another initial guess.
          open3d::utility::random::Seed(static_cast<int>(trial));
          return {calibrated(pair, global)};
        });
  });
}

void check_and_add() {
  std::vector<CloudPair> pairs = {street(100000, 20000)};
  for (CloudPair& pair : samples()) pairs.push_back(std::move(pair));
  for (CloudPair& pair : rigs()) pairs.push_back(std::move(pair));
  for (const CloudPair& pair : pairs) {
    const std::string start = "calibration/" + pair.name + "/";
    for (const Method& method : methods()) add_croon(start + "croon_" + method.name, method, pair);
    add_peer(start + "peer_open3d_ransac_gicp", by_ransac, pair);
    add_peer(start + "peer_open3d_fgr_gicp", by_fast_global_registration, pair);
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}
