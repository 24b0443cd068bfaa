#pragma once

#include <filesystem>
#include <string>

namespace croon::test {

/// How a script ended.
struct Finished {
  int status = -1;     ///< 0 where every command succeeded.
  std::string output;  ///< What it wrote to both streams, but for what it sent elsewhere.
};

/// Runs a script with bash in `folder`, with this build's programs on the path and CROON_DATA set
/// where the authors' samples are there. Ends at the first command that fails.
Finished run_script(const std::string& script, const std::filesystem::path& folder);

}  // namespace croon::test
