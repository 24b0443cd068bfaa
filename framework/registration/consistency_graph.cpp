#include "framework/registration/consistency_graph.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "framework/base/bits.hpp"
#include "framework/base/error.hpp"

namespace croon {
namespace {

bool consistent(const OrientedPairs& pairs, std::size_t i, std::size_t j,
                const ConsistencyOptions& options) {
  const Eigen::Vector3d target = (pairs.target[j] - pairs.target[i]).cast<double>();
  const Eigen::Vector3d source = (pairs.source[j] - pairs.source[i]).cast<double>();
  const double target_m = target.norm();
  const double source_m = source.norm();
  if (!(std::abs(target_m - source_m) <= options.tolerance_m)) return false;
  // Except for rounding, cosines differ by at most two: normals are ignored.
  if (options.normal_tolerance >= 2.0) return true;
  const auto alike = [&](double a, double b) {
    return std::abs(a - b) <= options.normal_tolerance;
  };
  const Eigen::Vector3d target_i = pairs.target_normals[i].cast<double>();
  const Eigen::Vector3d target_j = pairs.target_normals[j].cast<double>();
  const Eigen::Vector3d source_i = pairs.source_normals[i].cast<double>();
  const Eigen::Vector3d source_j = pairs.source_normals[j].cast<double>();
  if (!alike(target_i.dot(target_j), source_i.dot(source_j))) return false;
  // The direction between points that are close to each other is undefined.
  if (std::min(target_m, source_m) < std::max(1e-6, 4.0 * options.tolerance_m)) return true;
  return alike(target_i.dot(target) / target_m, source_i.dot(source) / source_m) &&
         alike(target_j.dot(target) / target_m, source_j.dot(source) / source_m);
}

}  // namespace

ConsistencyGraph::ConsistencyGraph(const OrientedPairs& pairs, const ConsistencyOptions& options)
    : size_(static_cast<int>(pairs.size())), words_((pairs.size() + 63) / 64) {
  if (pairs.size() > kMaxVertices) {
    throw StageError(std::to_string(pairs.size()) + " correspondences exceed the maximum of " +
                     std::to_string(kMaxVertices) + " for a consistency graph");
  }
  rows_.resize(pairs.size() * words_);
  for (int i = 0; i < size_; ++i) {
    for (int j = i + 1; j < size_; ++j) {
      if (!consistent(pairs, static_cast<std::size_t>(i), static_cast<std::size_t>(j), options)) {
        continue;
      }
      rows_[word(i, j)] |= std::uint64_t{1} << (static_cast<unsigned>(j) % 64U);
      rows_[word(j, i)] |= std::uint64_t{1} << (static_cast<unsigned>(i) % 64U);
    }
  }
}

ConsistencyGraph::Bits ConsistencyGraph::neighbours(int vertex) const {
  const auto row = rows_.begin() + static_cast<std::ptrdiff_t>(word(vertex, 0));
  return Bits(row, row + static_cast<std::ptrdiff_t>(words_));
}

int ConsistencyGraph::common(int vertex, const Bits& set) const {
  const std::uint64_t* const row = &rows_[word(vertex, 0)];
  int count = 0;
  for (std::size_t k = 0; k < words_; ++k) count += count_bits(row[k] & set[k]);
  return count;
}

std::vector<int> ConsistencyGraph::members(const Bits& set) const {
  std::vector<int> members;
  for (std::size_t k = 0; k < words_; ++k) {
    for (unsigned bit = 0; set[k] >> bit != 0; ++bit) {
      if ((set[k] >> bit & 1U) != 0) members.push_back(static_cast<int>(64 * k + bit));
      if (bit == 63) break;
    }
  }
  return members;
}

std::vector<int> ConsistencyGraph::core_numbers() const {
  // Vertices are removed in order of ascending degree, from bins of equal degree.
  std::vector<int> degrees;
  const Bits all(words_, ~std::uint64_t{0});
  for (int i = 0; i < size_; ++i) degrees.push_back(common(i, all));
  std::vector<std::vector<int>> bins(static_cast<std::size_t>(size_) + 1);
  for (int i = 0; i < size_; ++i) bins[static_cast<std::size_t>(degrees[i])].push_back(i);
  std::vector<int> cores(static_cast<std::size_t>(size_), -1);
  for (std::size_t min_degree = 0; min_degree < bins.size();) {
    if (bins[min_degree].empty()) {
      ++min_degree;
      continue;
    }
    const int vertex = bins[min_degree].back();
    bins[min_degree].pop_back();
    if (cores[vertex] >= 0 || degrees[vertex] != static_cast<int>(min_degree)) continue;
    cores[vertex] = static_cast<int>(min_degree);
    for (const int other : members(neighbours(vertex))) {
      if (cores[other] >= 0 || degrees[other] <= static_cast<int>(min_degree)) continue;
      bins[static_cast<std::size_t>(--degrees[other])].push_back(other);
    }
  }
  return cores;
}

std::vector<int> ConsistencyGraph::by_neighbours(const Bits& set) const {
  std::vector<int> vertices = members(set);
  std::vector<int> counts(static_cast<std::size_t>(size_));
  for (const int vertex : vertices) counts[vertex] = common(vertex, set);
  std::stable_sort(vertices.begin(), vertices.end(),
                   [&](int a, int b) { return counts[a] > counts[b]; });
  return vertices;
}

std::vector<int> ConsistencyGraph::clique(int seed) const {
  std::vector<int> clique = {seed};
  Bits candidates = neighbours(seed);
  for (;;) {
    const std::vector<int> order = by_neighbours(candidates);
    if (order.empty()) return clique;
    for (const int vertex : order) {
      if ((candidates[static_cast<std::size_t>(vertex) / 64] >> (vertex % 64) & 1U) == 0) continue;
      clique.push_back(vertex);
      const std::size_t row = word(vertex, 0);
      int remaining = 0;
      for (std::size_t k = 0; k < words_; ++k) {
        candidates[k] &= rows_[row + k];
        remaining += count_bits(candidates[k]);
      }
      if (2 * remaining < static_cast<int>(order.size())) break;
    }
  }
}

}  // namespace croon
