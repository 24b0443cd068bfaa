#include "framework/registration/direction_balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace croon {
namespace {

constexpr int kCells = 5;  // Along an edge of the three faces that hold directions up to the sign.
static_assert(kDirectionBins == 3 * kCells * kCells);

}  // namespace

int direction_bin(const Eigen::Vector3d& normal) {
  int axis = 0;
  if (!(normal.cwiseAbs().maxCoeff(&axis) > 0.0)) return 0;
  const auto cell = [&](int other) {
    const double share = 0.5 * (normal((axis + other) % 3) / normal(axis) + 1.0);
    return std::clamp(static_cast<int>(share * kCells), 0, kCells - 1);
  };
  return (axis * kCells + cell(1)) * kCells + cell(2);
}

std::vector<int> patches_of(const Cloud& cloud, const std::vector<int>& indices,
                            int normal_neighbours, double patch_m) {
  const Normals& normals = cloud.normals(normal_neighbours);
  std::map<std::array<int, 4>, int> numbers;
  std::vector<int> patches;
  for (const int i : indices) {
    std::array<int, 4> place{};
    for (int axis = 0; axis < 3; ++axis) {
      const double cell = std::floor(cloud.points()[i](axis) / patch_m);
      place[axis] = static_cast<int>(std::clamp(cell, -1e9, 1e9));
    }
    place[3] = direction_bin(normals.at(i).normal.cast<double>());
    patches.push_back(numbers.emplace(place, static_cast<int>(numbers.size())).first->second);
  }
  return patches;
}

std::vector<double> patch_weights(const std::vector<int>& patches, double exponent) {
  std::vector<int> counts;
  for (const int patch : patches) {
    if (patch >= static_cast<int>(counts.size())) counts.resize(patch + 1);
    ++counts[patch];
  }
  std::vector<double> weights;
  for (const int patch : patches) weights.push_back(std::pow(counts[patch], -exponent));
  return weights;
}

SelectCorrespondences balanced_directions(double exponent) {
  return [exponent](Correspondences& pairs) {
    std::array<int, kDirectionBins> counts{};
    for (const Correspondence& pair : pairs) {
      ++counts[static_cast<std::size_t>(direction_bin(pair.target_normal))];
    }
    std::array<double, kDirectionBins> weights{};
    double sum = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == 0) continue;
      weights[i] = std::pow(counts[i], -exponent);
      sum += counts[i] * weights[i];
    }
    const double scale = sum > 0.0 ? static_cast<double>(pairs.size()) / sum : 1.0;
    for (Correspondence& pair : pairs) {
      pair.weight = scale * weights[static_cast<std::size_t>(direction_bin(pair.target_normal))];
    }
  };
}

}  // namespace croon
