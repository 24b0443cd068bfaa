#include "test/support/script.hpp"

#include <array>
#include <cstdio>
#include <fstream>

#include "test/support/data_root.hpp"

namespace croon::test {

Finished run_script(const std::string& script, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "script.sh";
  const std::string data = data_root().string();
  std::ofstream(file) << "set -euo pipefail\nexport PATH='" << CROON_BINARY_DIR << "/bin':$PATH\n"
                      << (data.empty() ? "unset CROON_DATA" : "export CROON_DATA='" + data + "'")
                      << "\n"
                      << script << "\n";
  const std::string command = "cd '" + folder.string() + "' && bash script.sh 2>&1";
  Finished finished;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return finished;
  std::array<char, 4096> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) finished.output += part.data();
  finished.status = pclose(pipe);
  return finished;
}

}  // namespace croon::test
