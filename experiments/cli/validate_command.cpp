#include "experiments/cli/commands.hpp"

#include <algorithm>

#include "experiments/file/experiment.hpp"
#include "experiments/run/pose_file.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// The JSON files below `folder`, by path.
std::vector<fs::path> json_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".json") files.push_back(entry);
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw InputError(folder.string(), "", "expected a folder with *.json files");
  return files;
}

std::vector<fs::path> all_files(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    if (fs::is_directory(path)) {
      const std::vector<fs::path> below = json_files(path);
      files.insert(files.end(), below.begin(), below.end());
    } else {
      files.push_back(path);
    }
  }
  return files;
}

}  // namespace

void print_faults(const InputError& error, std::ostream& err) {
  const std::vector<Fault>& faults = error.faults();
  // One more than are shown may be the number of the others, as files of poses have it.
  const std::size_t shown = faults.size() <= kShownFaults + 1 ? faults.size() : kShownFaults;
  for (std::size_t i = 0; i < shown; ++i) err << "croon: " << faults[i].line() << "\n";
  if (shown < faults.size()) err << "croon: and " << faults.size() - shown << " more faults\n";
}

int validate_command(const std::vector<fs::path>& paths, const Catalogue& catalogue,
                     std::ostream& out, std::ostream& err) {
  int code = 0;
  for (const fs::path& file : all_files(paths)) {
    try {
      load_experiment(file, catalogue);
      out << printable(file.string()) << ": ok\n";
    } catch (const InputError& error) {
      print_faults(error, err);
      code = 2;
    }
  }
  return code;
}

}  // namespace croon::experiments
