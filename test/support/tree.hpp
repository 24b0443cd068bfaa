#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace croon::test {

/// One line of a file of the tree.
struct Line {
  std::string file;  ///< Relative to the root, with slashes.
  int number = 0;    ///< From 1.
  std::string text;

  /// "framework/base/angles.hpp:3".
  std::string place() const { return file + ":" + std::to_string(number); }
};

/// The root of the sources.
std::filesystem::path source_root();

/// The files of the tree, without what is built, downloaded or git's own; sorted.
std::vector<std::string> tree_files();

/// Those below `folder` ("stages/") whose name ends in `ending` (".hpp").
std::vector<std::string> tree_files(const std::string& folder, const std::string& ending);

/// The lines of a file of the tree.
std::vector<Line> lines_of(const std::string& file);

/// An `#include` and what it asks for.
struct Include {
  Line line;
  std::string path;        ///< Between the quotes or brackets.
  bool is_quoted = false;  ///< "..." and not <...>.
};

/// The includes of all .cpp and .hpp files.
std::vector<Include> tree_includes();

bool starts_with(const std::string& text, const std::string& start);
bool ends_with(const std::string& text, const std::string& end);

}  // namespace croon::test
