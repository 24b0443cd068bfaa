#include "framework/registration/sensor_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/registration/surface_key.hpp"

namespace croon {

std::vector<int> balanced_sample(const Cloud& cloud, int normal_neighbours, int count) {
  const Normals& normals = cloud.normals(normal_neighbours);
  const int size = static_cast<int>(cloud.points().size());
  std::vector<int> bins(size, -1);
  DirectionCounts counts{};
  for (int i = 0; i < size; ++i) {
    const LocalShape shape = normals.at(i);
    if (shape.normal.isZero()) continue;
    bins[i] = direction_bin(shape.normal.cast<double>());
    ++counts[bins[i]];
  }
  double all = 0.0;
  for (const int n : counts) all += std::sqrt(static_cast<double>(n));
  // Systematic sampling in each bin: a point is selected each time the sum of the weights passes a
  // multiple of the step.
  const double step = std::max(1e-9, all / count);
  std::array<double, kDirectionBins> sums{};
  sums.fill(0.5 * step);
  std::vector<int> sample;
  for (int i = 0; i < size; ++i) {
    if (bins[i] < 0) continue;
    const auto bin = static_cast<std::size_t>(bins[i]);
    sums[bin] += 1.0 / std::sqrt(static_cast<double>(counts[bin]));
    if (sums[bin] < step) continue;
    sums[bin] -= std::floor(sums[bin] / step) * step;
    sample.push_back(i);
  }
  return sample;
}

}  // namespace croon
