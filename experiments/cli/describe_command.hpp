#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// What `croon describe` is asked for.
struct DescribeOptions {
  std::vector<std::filesystem::path> experiments;
  std::filesystem::path data;  ///< Empty: CROON_DATA, else data/.
  std::filesystem::path out;   ///< Empty: nothing is written.
  int jobs = 0;                ///< 0: all cores.
  int scenes = 0;              ///< Of each dataset, from the first on; 0: all.
};

/// Tells what the clouds of the experiments' datasets look like, side by side: a table to `out`,
/// and clouds.csv and ranges.svg in a folder. Returns 0. Throws InputError.
int describe_command(const DescribeOptions& options, const Catalogue& catalogue, std::ostream& out);

}  // namespace croon::experiments
