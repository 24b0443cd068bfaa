#include "experiments/cli/commands.hpp"

#include <algorithm>
#include <memory>

#include "experiments/cli/command.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/file/experiment.hpp"
#include "experiments/run/pose_file.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// Appends the JSON files below `folder`, and a fault for each folder that cannot be read.
void find_json_files(const fs::path& folder, std::vector<fs::path>& files,
                     std::vector<Fault>& faults) {
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    // Errors are ignored: an entry that cannot be inspected is neither a folder nor a file.
    std::error_code ignored;
    if (entry->is_directory(ignored) && !entry->is_symlink(ignored)) {
      find_json_files(entry->path(), files, faults);
    } else if (entry->is_regular_file(ignored) && entry->path().extension() == ".json") {
      files.push_back(entry->path());
    }
  }
  if (error) faults.push_back({folder.string(), "", "cannot be read: " + error.message()});
}

/// The files of `paths`; a folder is replaced by the JSON files below it, sorted by path. Appends a
/// fault for each folder that cannot be read or has none.
std::vector<fs::path> all_files(const std::vector<fs::path>& paths, std::vector<Fault>& faults) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) {
      files.push_back(path);
      continue;
    }
    std::vector<fs::path> below;
    const std::size_t faults_before = faults.size();
    find_json_files(path, below, faults);
    std::sort(below.begin(), below.end());
    files.insert(files.end(), below.begin(), below.end());
    if (below.empty() && faults.size() == faults_before) {
      faults.push_back({path.string(), "", "expected a folder with *.json files"});
    }
  }
  return files;
}

}  // namespace

void print_faults(const InputError& error, std::ostream& err) {
  const std::vector<Fault>& faults = error.faults();
  // A CSV reader keeps kShownFaults faults and appends one with the number of the others.
  const std::size_t shown = faults.size() <= kShownFaults + 1 ? faults.size() : kShownFaults;
  for (std::size_t i = 0; i < shown; ++i) err << "croon: " << faults[i].line() << "\n";
  if (shown < faults.size()) err << "croon: and " << faults.size() - shown << " more faults\n";
}

void print_notes(const std::vector<Fault>& notes, std::ostream& err) {
  for (const Fault& note : notes) err << "croon: warning: " << note.line() << "\n";
}

int validate_command(const std::vector<fs::path>& paths, const Catalogue& catalogue,
                     std::ostream& out, std::ostream& err) {
  std::vector<Fault> faults;
  const std::vector<fs::path> files = all_files(paths, faults);
  int code = faults.empty() ? 0 : 2;
  for (const Fault& fault : faults) print_faults(InputError({fault}), err);
  for (const fs::path& file : files) {
    try {
      print_notes(validate_experiment(file, catalogue), err);
      out << printable(file.string()) << ": ok\n";
    } catch (const InputError& error) {
      print_faults(error, err);
      code = 2;
    } catch (const fs::filesystem_error& error) {
      print_faults(InputError(file.string(), "", error.code().message()), err);
      code = 2;
    }
  }
  return code;
}

namespace {

class ValidateCommand final : public Command {
 public:
  std::string sentence() const override {
    return "Check experiment files and workloads; the data need not exist.";
  }

  void add_options(CLI::App& command) override {
    add_path(command, "PATH", paths_, "Files, or folders of *.json.")->required();
  }

  int run(const Console& console) override {
    return validate_command(paths_, console.catalogue, console.out, console.err);
  }

 private:
  std::vector<fs::path> paths_;
};

}  // namespace

std::unique_ptr<Command> make_validate_command() { return std::make_unique<ValidateCommand>(); }

}  // namespace croon::experiments
