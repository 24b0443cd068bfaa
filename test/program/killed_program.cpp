#include "test/program/killed_program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace croon::experiments {
namespace {

/// Becomes the program, in a process that was forked.
[[noreturn]] void become(const std::vector<char*>& words) {
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  ::execv(words.front(), words.data());
  ::_exit(127);
}

}  // namespace

bool kill_croon_after(double delay_s, const std::vector<std::string>& arguments) {
  std::vector<std::string> texts = {std::string(CROON_BINARY_DIR) + "/bin/croon"};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> words;
  for (std::string& text : texts) words.push_back(text.data());
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process for a test");
  if (child == 0) become(words);
  std::this_thread::sleep_for(std::chrono::duration<double>(delay_s));
  ::kill(child, SIGKILL);
  int status = 0;
  if (::waitpid(child, &status, 0) != child) throw std::runtime_error("lost a process of a test");
  if (WIFSIGNALED(status)) return true;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return false;
  throw std::runtime_error("croon ended with " + std::to_string(WEXITSTATUS(status)));
}

}  // namespace croon::experiments
