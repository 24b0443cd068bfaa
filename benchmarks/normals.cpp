// What do the normals of a whole cloud cost, on one core and on all, and with nanoflann and Eigen
// as their examples use them?

#include <Eigen/Eigenvalues>
#include <stdexcept>

#include "benchmarks/support/clouds.hpp"
#include "benchmarks/support/nanoflann_peer.hpp"
#include "benchmarks/support/run.hpp"
#include "framework/base/threads.hpp"
#include "framework/spatial/normals.hpp"

namespace croon::benchmarks {
namespace {

constexpr int kNeighbours = 40;

Points normals_of(const Points& points, bool in_parallel) {
  const KdTree tree(points);
  const Normals normals(points, tree, kNeighbours);
  Points result(points.size());
  const auto set = [&](std::size_t i) { result[i] = normals.at(static_cast<int>(i)).normal; };
  if (in_parallel) {
    for_each_in_parallel(points.size(), set);
  } else {
    for (std::size_t i = 0; i < points.size(); ++i) set(i);
  }
  return result;
}

Points peer_normals_of(const Points& points) {
  const NanoflannPeer tree(points);
  Points result(points.size());
  std::vector<Neighbour> neighbours;
  for (std::size_t i = 0; i < points.size(); ++i) {
    tree.nearest(points[i], kNeighbours, neighbours);
    Eigen::Matrix3Xd offsets(3, static_cast<Eigen::Index>(neighbours.size()));
    for (Eigen::Index k = 0; k < offsets.cols(); ++k) {
      offsets.col(k) =
          (points[neighbours[static_cast<std::size_t>(k)].index] - points[i]).cast<double>();
    }
    offsets.colwise() -= offsets.rowwise().mean().eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(offsets * offsets.transpose());
    const Eigen::Vector3f normal = solver.eigenvectors().col(0).cast<float>();
    result[i] = normal.dot(points[i]) > 0.0F ? Eigen::Vector3f(-normal) : normal;
  }
  return result;
}

/// Throws unless nearly all normals agree within a degree: in an isotropic neighbourhood the normal
/// is undefined.
void check_agreement(const std::string& place, const Points& points) {
  const Points ours = normals_of(points, true);
  const Points theirs = peer_normals_of(points);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    differ += static_cast<std::size_t>(std::abs(ours[i].dot(theirs[i])) < 0.99985F);
  }
  if (1000 * differ > points.size()) {
    throw std::runtime_error("normals differ from those of the peer on " + place);
  }
}

void check_and_add() {
  std::vector<CloudPair> pairs = {street(20000, 20000), street(100000, 100000)};
  for (CloudPair& pair : samples()) {
    pair.name = pair.name.substr(0, pair.name.rfind('/')) + "/reference";
    pairs.push_back(std::move(pair));
  }
  for (const CloudPair& pair : pairs) {
    check_agreement(pair.name, pair.target);
    const auto add_one = [&](const std::string& name, const auto& compute) {
      add("normals/" + pair.name + "/" + name, benchmark::kMillisecond,
          [compute, points = pair.target](benchmark::State& state) {
            for (auto _ : state) benchmark::DoNotOptimize(compute(points));
            state.counters["points"] = static_cast<double>(points.size());
          });
    };
    add_one("croon_one_core", [](const Points& points) { return normals_of(points, false); });
    add_one("croon", [](const Points& points) { return normals_of(points, true); });
    add_one("peer_nanoflann_eigen_one_core", peer_normals_of);
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}
