#include "experiments/cli/options.hpp"

#include <charconv>

#include "experiments/file/start_rule.hpp"
#include "experiments/report/figures.hpp"
#include "framework/base/threads.hpp"

namespace croon::experiments {

std::string why_no_text(const std::string& name, const std::string& text, const std::string& what) {
  if (text.empty()) return "expected " + what + ", found \"\"";
  if (name.compare(0, 2, "--") != 0 || text.compare(0, 2, "--") != 0) return "";
  return "expected " + what + ", found the option \"" + text + "\"";
}

std::string capitals(const std::string& word) {
  std::string result;
  for (const char c : word) result += static_cast<char>(c - 'a' + 'A');
  return result;
}

void add_experiment(CLI::App& command, std::filesystem::path& experiment,
                    std::vector<std::filesystem::path>& workloads) {
  add_path(command, "EXPERIMENT", experiment, "The experiment, a JSON file.")->required();
  add_path(command, "--with", workloads,
           "A workload: a JSON file whose keys, such as dataset and starts, replace those of the "
           "experiment; may be repeated.")
      ->type_name("WORKLOAD");
}

void add_data(CLI::App& command, std::filesystem::path& option) {
  add_path(command, "--data", option, "Data root; default $CROON_DATA, else data.");
}

void add_jobs(CLI::App& command, int& option) {
  command.add_option("--jobs", option, "Number of threads; default all cores.")
      ->check(CLI::Range(1, kMaxJobs));
}

void add_trials(CLI::App& command, int& option, const std::string& sentence) {
  command.add_option("--trials", option, sentence)->check([](const std::string& text) {
    int trials = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, trials);
    const bool is_whole = read.ec == std::errc() && read.ptr == end;
    if (is_whole && trials >= 1 && trials <= kMaxTrials) return std::string();
    return "expected a whole number from 1 to " + std::to_string(kMaxTrials) + ", found " + text;
  });
}

void add_width(CLI::App& command, std::string& option) {
  add_text(command, "--width", option, names_of(named_sheets()) + ".", "a width");
}

}  // namespace croon::experiments
