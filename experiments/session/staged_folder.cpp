#include "experiments/session/staged_folder.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

void refuse_if(const std::error_code& error, const fs::path& path) {
  if (error) throw InputError(path.string(), "", "cannot be written: " + error.message());
}

}  // namespace

StagedFolder::StagedFolder(fs::path folder, const std::string& marker)
    : folder_(folder.has_filename() ? std::move(folder) : folder.parent_path()) {
  staging_ = folder_;
  staging_ += ".croon-part";
  if (!fs::exists(folder_)) return;
  if (!fs::is_directory(folder_)) {
    throw InputError(folder_.string(), "",
                     "expected a folder to write to, found " + found_instead_of_file(folder_));
  }
  if (fs::is_empty(folder_) || fs::exists(folder_ / marker)) return;
  throw InputError(folder_.string(), "",
                   "expected a new folder or one with an earlier calibration, found one with "
                   "other files; choose another with --out");
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

const fs::path& StagedFolder::make_staging() {
  std::error_code error;
  fs::remove_all(staging_, error);
  fs::create_directories(staging_, error);
  refuse_if(error, staging_);
  return staging_;
}

std::vector<std::string> StagedFolder::publish() {
  std::error_code error;
  std::vector<std::string> left;
  if (!fs::exists(folder_)) {
    fs::rename(staging_, folder_, error);
    refuse_if(error, folder_);
    return left;
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_)) {
    const fs::path name = entry.path().lexically_relative(folder_);
    if (!entry.is_directory() && !fs::exists(staging_ / name)) left.push_back(name.string());
  }
  std::sort(left.begin(), left.end());
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(staging_)) {
    const fs::path to = folder_ / entry.path().lexically_relative(staging_);
    if (entry.is_directory()) {
      fs::create_directories(to, error);
    } else {
      fs::rename(entry.path(), to, error);
    }
    refuse_if(error, to);
  }
  return left;
}

}  // namespace croon::experiments
