#include "test/house/fenced_block.hpp"

#include <sstream>

#include "test/support/tree.hpp"

namespace croon::test {

std::string FencedBlock::text() const {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::vector<std::string> written_pages() {
  std::vector<std::string> pages;
  for (const std::string& file : tree_files("", ".md")) {
    const bool is_in_root = file.find('/') == std::string::npos;
    const bool is_in_docs = starts_with(file, "docs/") && file.find('/', 5) == std::string::npos;
    const bool is_in_experiments = starts_with(file, "experiments/");
    if (is_in_root || is_in_docs || is_in_experiments) pages.push_back(file);
  }
  return pages;
}

std::vector<FencedBlock> fenced_blocks(const std::string& file, const std::string& language) {
  std::vector<FencedBlock> blocks;
  bool is_inside = false;
  FencedBlock block;
  for (const Line& line : lines_of(file)) {
    if (!starts_with(line.text, "```")) {
      if (is_inside) block.lines.push_back(line.text);
      continue;
    }
    if (!is_inside) {
      block = {file, line.number, "", "", {}};
      std::istringstream(line.text.substr(3)) >> block.language >> block.mark;
    } else if (block.language == language) {
      blocks.push_back(block);
    }
    is_inside = !is_inside;
  }
  return blocks;
}

}  // namespace croon::test
