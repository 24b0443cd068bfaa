// What does one iteration of generalized and of point-to-plane ICP cost, here, with PCL and with
// Open3D, in one run, with trees, normals and covariances computed before? Built with
// -DCROON_BENCHMARK_PEERS=ON.

#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/GeneralizedICP.h>
#include <open3d/pipelines/registration/Registration.h>
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>

#include <chrono>

#include "benchmarks/support/calibration.hpp"
#include "benchmarks/support/run.hpp"
#include "framework/stage/icp.hpp"
#include "test/support/stages.hpp"

namespace croon::benchmarks {
namespace {

namespace reg = open3d::pipelines::registration;
using PeerCloud = open3d::geometry::PointCloud;

constexpr int kPoses = 8;
constexpr double kMaxDistanceM = 0.5;
constexpr int kNeighbours = 20;  // Of a normal or covariance; the default of all three.

RigidTransform rigid(const Eigen::Matrix4d& T) {
  return {T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()};
}

Eigen::Matrix4d matrix(const RigidTransform& T) {
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
  result.topLeftCorner<3, 3>() = T.rotation;
  result.topRightCorner<3, 1>() = T.translation;
  return result;
}

/// The pose after some iterations from another one.
using Step = std::function<RigidTransform(const RigidTransform& start)>;

Step croon_step(const std::string& name, const CloudPair& pair) {
  // Without a robust kernel, as the others by default.
  const auto icp = test::stage<Icp>(
      R"({"type": ")" + name +
      R"(", "kernel": "none", "max_iterations": 1, "max_distances_m": [0.5], "normal_neighbours": 20})");
  return
      [icp, target = fresh(pair.target), source = fresh(pair.source)](const RigidTransform& start) {
        return icp->align(*target, *source, start).T_target_source;
      };
}

pcl::PointCloud<pcl::PointNormal>::Ptr pcl_cloud(const Points& points) {
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  for (const Eigen::Vector3f& point : points) {
    pcl::PointNormal added;
    added.getVector3fMap() = point;
    cloud->push_back(added);
  }
  pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> normals;
  normals.setInputCloud(cloud);
  normals.setKSearch(kNeighbours);
  const pcl::PointCloud<pcl::PointNormal>::Ptr result(new pcl::PointCloud<pcl::PointNormal>);
  normals.compute(*result);
  for (std::size_t i = 0; i < points.size(); ++i) (*result)[i].getVector3fMap() = points[i];
  return result;
}

/// `icp` keeps its trees and covariances after the first call.
template <class PeerIcp>
Step pcl_step(const CloudPair& pair) {
  const auto icp = std::make_shared<PeerIcp>();
  icp->setInputTarget(pcl_cloud(pair.target));
  icp->setInputSource(pcl_cloud(pair.source));
  icp->setMaximumIterations(1);
  icp->setMaxCorrespondenceDistance(kMaxDistanceM);
  return [icp](const RigidTransform& start) {
    pcl::PointCloud<pcl::PointNormal> moved;
    icp->align(moved, matrix(start).cast<float>());
    return rigid(icp->getFinalTransformation().template cast<double>());
  };
}

std::shared_ptr<PeerCloud> open3d_cloud(const Points& points) {
  const auto cloud = std::make_shared<PeerCloud>();
  for (const Eigen::Vector3f& point : points) cloud->points_.push_back(point.cast<double>());
  cloud->EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(kNeighbours));
  cloud->EstimateCovariances(open3d::geometry::KDTreeSearchParamKNN(kNeighbours));
  return cloud;
}

Step open3d_steps(bool is_generalized, int iterations, const CloudPair& pair) {
  // A relative change is never below zero, so that no iteration is the last one early.
  const reg::ICPConvergenceCriteria criteria(0.0, 0.0, iterations);
  return [=, target = open3d_cloud(pair.target),
          source = open3d_cloud(pair.source)](const RigidTransform& start) {
    const Eigen::Matrix4d T = matrix(start);
    return rigid((is_generalized
                      ? reg::RegistrationGeneralizedICP(
                            *source, *target, kMaxDistanceM, T,
                            reg::TransformationEstimationForGeneralizedICP(), criteria)
                      : reg::RegistrationICP(*source, *target, kMaxDistanceM, T,
                                             reg::TransformationEstimationPointToPlane(), criteria))
                     .transformation_);
  };
}

/// Starts from poses like the results of a rough calibration. The counters are the errors after one
/// iteration. The first round computes what is kept and is not timed.
std::vector<RigidTransform> starts_with_errors(benchmark::State& state, const Step& one_step,
                                               const CloudPair& pair) {
  const std::vector<RigidTransform> starts = poses_near(pair, kPoses, 1.0, 0.1);
  AnswerErrors errors;
  for (const RigidTransform& start : starts) errors.add({one_step(start)}, pair);
  errors.set_counters(state);
  return starts;
}

void measure(benchmark::State& state, const Step& step, const CloudPair& pair) {
  const std::vector<RigidTransform> starts = starts_with_errors(state, step, pair);
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(step(starts[next++ % starts.size()]));
}

double seconds_of(const Step& step, const RigidTransform& start) {
  const auto begin = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(step(start));
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Open3D builds the target's tree in each call: a call without iterations, which ends after the
/// first search, is subtracted from one with several.
void measure_open3d(benchmark::State& state, bool is_generalized, const CloudPair& pair) {
  constexpr int kIterations = 4;
  const Step none = open3d_steps(is_generalized, 0, pair);
  const Step several = open3d_steps(is_generalized, kIterations, pair);
  const std::vector<RigidTransform> starts =
      starts_with_errors(state, open3d_steps(is_generalized, 1, pair), pair);
  std::size_t next = 0;
  for (auto _ : state) {
    const RigidTransform& start = starts[next++ % starts.size()];
    const double all_s = seconds_of(several, start);
    state.SetIterationTime(std::max(0.0, all_s - seconds_of(none, start)) / kIterations);
  }
}

void check_and_add() {
  std::vector<CloudPair> pairs = {street(100000, 20000)};
  for (CloudPair& pair : samples()) pairs.push_back(std::move(pair));
  for (const CloudPair& pair : pairs) {
    for (const bool is_generalized : {true, false}) {
      const std::string stage = is_generalized ? "gicp" : "point_to_plane";
      const std::string start = stage + "_iteration/" + pair.name + "/";
      add(start + "croon_one_core", benchmark::kMillisecond,
          [=](benchmark::State& state) { measure(state, croon_step(stage, pair), pair); });
      add(start + "peer_pcl_one_core", benchmark::kMillisecond, [=](benchmark::State& state) {
        using Point = pcl::PointNormal;
        measure(state,
                is_generalized
                    ? pcl_step<pcl::GeneralizedIterativeClosestPoint<Point, Point>>(pair)
                    : pcl_step<pcl::IterativeClosestPointWithNormals<Point, Point>>(pair),
                pair);
      });
      add_with_own_clock(
          start + "peer_open3d", benchmark::kMillisecond,
          [=](benchmark::State& state) { measure_open3d(state, is_generalized, pair); });
    }
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}
