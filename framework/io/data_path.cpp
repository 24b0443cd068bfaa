#include "framework/io/data_path.hpp"

#include <algorithm>

#include "framework/base/error.hpp"

namespace croon {

namespace fs = std::filesystem;

bool is_within(const fs::path& path, const fs::path& folder) {
  const auto [in_folder, in_path] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return in_folder == folder.end();
}

fs::path path_in_data_root(const fs::path& data_root, const std::string& relative, Links links) {
  std::error_code error;
  const fs::path root = fs::canonical(data_root, error);
  if (error || !fs::is_directory(root, error)) {
    throw InputError(data_root.string(), "",
                     "expected the folder of the data, found none; --data DIR or CROON_DATA names "
                     "it (docs/data.md)");
  }
  fs::path path = (root / relative).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  if (links == Links::inside) path = fs::weakly_canonical(root / relative, error);
  const std::string shown = (data_root / relative).string();
  if (error) throw InputError(shown, "", "cannot be looked at: " + error.message());
  // Checked before existence, so that the message does not reveal which files exist outside.
  if (!is_within(path, root)) {
    throw InputError(shown, "", "the path leads outside the data root " + data_root.string());
  }
  if (!fs::exists(path, error))
    throw InputError(shown, "", "expected a file or folder, found none");
  return path;
}

}  // namespace croon
