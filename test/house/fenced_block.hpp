#pragma once

#include <string>
#include <vector>

namespace croon::test {

/// A fenced block of a Markdown page.
struct FencedBlock {
  std::string file;
  int line_number = 0;             ///< Of the opening fence.
  std::string language;            ///< "sh", "json", ...
  std::string mark;                ///< The second word of the fence, or nothing.
  std::vector<std::string> lines;  ///< What stands between the fences.

  std::string place() const { return file + ":" + std::to_string(line_number); }
  std::string text() const;
};

/// The pages that a person wrote: README.md, CONTRIBUTING.md, docs/*.md and those of
/// experiments.
std::vector<std::string> written_pages();

/// The fenced blocks of a page in `language`.
std::vector<FencedBlock> fenced_blocks(const std::string& file, const std::string& language);

}  // namespace croon::test
