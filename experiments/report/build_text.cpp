#include "experiments/report/build_text.hpp"

#include <algorithm>
#include <filesystem>

#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

constexpr std::size_t kShownDigits = 12;

/// "my_stages at commit 0123456789ab-dirty"; without parent folders, which differ between machines.
std::string folder_text(const StageFolder& folder) {
  return std::filesystem::path(folder.folder).filename().string() + " at commit " +
         short_commit(folder.commit);
}

std::string build_text(const Build& build) {
  return "commit " + short_commit(build.commit) + " (program " +
         build.program_sha256.substr(0, kShownDigits) + ")";
}

}  // namespace

std::string short_commit(const std::string& commit) {
  const std::size_t dash = std::min(commit.find('-'), commit.size());
  return commit.substr(0, std::min(dash, kShownDigits)) + commit.substr(dash);
}

std::vector<std::string> build_sentences(const std::vector<Build>& builds) {
  std::vector<std::string> of_builds, folders;
  for (const Build& build : builds) {
    of_builds.push_back(build_text(build));
    for (const StageFolder& folder : build.stage_folders) folders.push_back(folder_text(folder));
  }
  std::sort(folders.begin(), folders.end());
  folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
  std::vector<std::string> sentences;
  if (builds.size() > 1) {
    sentences.push_back("Trials of " + std::to_string(builds.size()) +
                        " builds of croon: " + list_text(of_builds) + ".");
  }
  if (!folders.empty()) {
    sentences.push_back("With stages from outside the croon tree: " + list_text(folders) + ".");
  }
  return sentences;
}

}  // namespace croon::experiments
