#include "test/program/program.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>

namespace croon::experiments {

Answer croon(const std::string& arguments) {
  const std::string command =
      std::string("\"") + CROON_BINARY_DIR + "/bin/croon\" " + arguments + " 2>&1";
  Answer answer;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return answer;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    answer.text.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status)) answer.code = WEXITSTATUS(status);
  return answer;
}

}  // namespace croon::experiments
