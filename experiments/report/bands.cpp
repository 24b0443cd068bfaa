#include "experiments/report/bands.hpp"

#include <numeric>

namespace croon::experiments {

std::vector<std::optional<Interval>> intervals_of(const std::vector<Share>& shares) {
  std::vector<std::optional<Interval>> intervals;
  for (const Share& share : shares) intervals.push_back(share.interval);
  return intervals;
}

std::vector<std::size_t> lines_with_band(std::size_t lines) {
  constexpr std::size_t kMaxBands = 4;
  std::vector<std::size_t> all(lines > kMaxBands ? 1 : lines);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::string band_sentence(const std::vector<std::string>& names,
                          const std::vector<std::size_t>& with_band) {
  const bool have_all = with_band.size() == names.size();
  return (have_all ? "bands:" : "band of " + names[with_band.front()] + ":") +
         " 95 % interval over scenes (requires at least " + std::to_string(kMinScenes) + " scenes)";
}

}  // namespace croon::experiments
