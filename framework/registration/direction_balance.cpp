#include "framework/registration/direction_balance.hpp"

#include <array>
#include <cmath>
#include <map>

#include "framework/registration/surface_key.hpp"

namespace croon {
std::vector<int> patches_of(const Cloud& cloud, const std::vector<int>& indices,
                            int normal_neighbours, double patch_m) {
  const Normals& normals = cloud.normals(normal_neighbours);
  std::map<SurfaceKey, int> numbers;
  std::vector<int> patches;
  for (const int i : indices) {
    const SurfaceKey surface =
        surface_key(cloud.points()[i].cast<double>(), normals.at(i).normal.cast<double>(), patch_m);
    patches.push_back(numbers.emplace(surface, static_cast<int>(numbers.size())).first->second);
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
    DirectionCounts counts{};
    for (const Correspondence& pair : pairs) {
      ++counts[static_cast<std::size_t>(direction_bin(pair.target_normal))];
    }
    const auto weights = direction_weights(counts, exponent);
    double sum = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) sum += counts[i] * weights[i];
    const double scale = sum > 0.0 ? static_cast<double>(pairs.size()) / sum : 1.0;
    for (Correspondence& pair : pairs) {
      pair.weight = scale * weights[static_cast<std::size_t>(direction_bin(pair.target_normal))];
    }
  };
}

}  // namespace croon
