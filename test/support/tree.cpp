#include "test/support/tree.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>

namespace croon::test {
namespace fs = std::filesystem;

fs::path source_root() { return CROON_SOURCE_DIR; }

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::vector<std::string> tree_files() {
  static const std::set<std::string> left_out = {".git",  "build",        "results",
                                                 "data",  "node_modules", "__pycache__",
                                                 ".idea", ".vscode",      ".cache"};
  std::vector<std::string> files;
  for (auto it = fs::recursive_directory_iterator(source_root());
       it != fs::recursive_directory_iterator(); ++it) {
    if (it->is_directory() && left_out.count(it->path().filename().string()) > 0) {
      it.disable_recursion_pending();
    }
    if (it->is_regular_file()) {
      files.push_back(it->path().lexically_relative(source_root()).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> tree_files(const std::string& folder, const std::string& ending) {
  std::vector<std::string> files;
  for (const std::string& file : tree_files()) {
    if (starts_with(file, folder) && ends_with(file, ending)) files.push_back(file);
  }
  return files;
}

std::vector<Line> lines_of(const std::string& file) {
  std::ifstream stream(source_root() / file);
  std::vector<Line> lines;
  for (std::string text; std::getline(stream, text);) {
    lines.push_back({file, static_cast<int>(lines.size()) + 1, text});
  }
  return lines;
}

std::vector<Include> tree_includes() {
  // The examples are folders outside of the tree, so their own headers have no path.
  const std::string examples[] = {"docs/example_stage/", "docs/example_paper/", "test/extra_kind/"};
  static const std::regex pattern(R"(^\s*#\s*include\s*(["<])([^">]+)[">])");
  std::vector<Include> includes;
  for (const std::string& file : tree_files()) {
    if (!ends_with(file, ".hpp") && !ends_with(file, ".cpp")) continue;
    for (const Line& line : lines_of(file)) {
      std::smatch match;
      if (std::regex_search(line.text, match, pattern)) {
        std::string path = match[2];
        for (const std::string& example : examples) {
          const bool is_own = std::filesystem::exists(source_root() / example / path);
          if (starts_with(file, example) && is_own) path = example + path;
        }
        includes.push_back({line, path, match[1] == "\""});
      }
    }
  }
  return includes;
}

}  // namespace croon::test
