#include "framework/io/data_path.hpp"

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace croon {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxNames = 1000;

/// The sorted names in `folder` without hidden ones; in a large folder only some of them.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.compare(0, 1, ".") != 0) names.push_back(name);
    if (names.size() == kMaxNames) break;
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The one of `names` nearest to the name of a file. A common suffix does not count as similarity.
std::string nearest_file_name(const fs::path& name, const std::vector<std::string>& names) {
  std::vector<std::string> stems, others;
  for (const std::string& other : names) {
    const bool is_alike = fs::path(other).extension() == name.extension();
    is_alike ? stems.push_back(fs::path(other).stem().string()) : others.push_back(other);
  }
  const std::string stem = nearest_name(name.stem().string(), stems);
  return stem.empty() ? nearest_name(name.string(), others) : stem + name.extension().string();
}

}  // namespace

std::string missing_path_hint(const fs::path& folder, const fs::path& relative) {
  constexpr std::size_t kFew = 10;
  const fs::path from = folder.empty() ? fs::path(".") : folder;
  std::error_code error;
  fs::path known;
  for (const fs::path& part : relative.lexically_normal()) {
    if (fs::exists(from / known / part, error)) {
      known /= part;
      continue;
    }
    const bool is_free = folder.empty();
    if (!is_free && !is_within(fs::canonical(from / known, error), fs::canonical(from, error))) {
      return "";
    }
    const std::vector<std::string> names = names_in(from / known);
    const std::string near = nearest_file_name(part, names);
    const bool are_few = !names.empty() && names.size() <= kFew;
    if (near.empty()) return are_few ? "; known: " + list_text(names) : "";
    return "; did you mean \"" + (known / near).string() + "\"?";
  }
  return "";
}

bool is_within(const fs::path& path, const fs::path& folder) {
  const auto [in_folder, in_path] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return in_folder == folder.end();
}

fs::path path_in_data_root(const fs::path& data_root, const std::string& relative, Links links,
                           const std::string& pointer) {
  std::error_code error;
  const fs::path root = fs::canonical(data_root, error);
  if (error || !fs::is_directory(root, error)) {
    throw InputError(data_root.string(), "",
                     "expected the data folder, found none; set it with --data DIR or CROON_DATA "
                     "(docs/data.md)");
  }
  fs::path path = (root / relative).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  if (links == Links::inside) path = fs::weakly_canonical(root / relative, error);
  const std::string shown = (data_root / relative).string();
  const auto refuse = [&](const std::string& message) {
    if (pointer.empty()) throw InputError(shown, "", message);
    throw InputError("", pointer, shown + ": " + message);
  };
  if (error) refuse("cannot be accessed: " + error.message());
  // Checked before existence, so that the message does not reveal which files exist outside.
  if (!is_within(path, root)) {
    refuse("the path is outside the data root " + data_root.string());
  }
  if (!fs::exists(path, error)) {
    refuse("expected a file or folder, found none" +
           missing_path_hint(root, path.lexically_relative(root)));
  }
  return path;
}

}  // namespace croon
