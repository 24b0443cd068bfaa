#include "framework/document/renderers.hpp"
#include "framework/table/renderers.hpp"

namespace croon {
namespace {

/// Writes the blocks that Markdown can show.
struct MarkdownWriter {
  std::string operator()(const Paragraph& paragraph) const {
    return markdown_escaped(paragraph.text) + "\n\n";
  }

  std::string operator()(const BulletList& list) const {
    std::string text;
    for (const std::string& item : list.items) text += "- " + markdown_escaped(item) + "\n";
    return text + "\n";
  }

  std::string operator()(const Cards& cards) const {
    std::string text;
    for (const Card& card : cards.cards) {
      text += "**" + markdown_escaped(card.title) + "** " + markdown_escaped(card.status) + "\n\n";
      text += (*this)(BulletList{card.lines});
      if (!card.details.empty()) text += (*this)(Preformatted{card.details});
    }
    return text;
  }

  std::string operator()(const TableBlock& block) const {
    std::string text = block.caption.empty() ? "" : markdown_escaped(block.caption) + "\n\n";
    text += markdown_table(block.table, block.view) + "\n";
    for (const std::string& note : block.notes) text += (*this)(Paragraph{note});
    return text;
  }

  std::string operator()(const Facts& facts) const {
    std::string text;
    for (const auto& [name, value] : facts.facts) {
      text += "- " + markdown_escaped(name) + ": " + markdown_escaped(value) + "\n";
    }
    return text + "\n";
  }

  std::string operator()(const Preformatted& block) const {
    const bool is_ended = !block.text.empty() && block.text.back() == '\n';
    std::string fence = "```";  // Longer than any in the text.
    while (block.text.find(fence) != std::string::npos) fence += '`';
    return fence + "\n" + block.text + (is_ended ? "" : "\n") + fence + "\n\n";
  }

  /// Figures.
  template <class Figure>
  std::string operator()(const Figure&) const {
    return "";
  }
};

std::string markdown(const Section& section, const std::string& hashes) {
  std::string text = hashes + " " + markdown_escaped(section.title) + "\n\n";
  for (const Block& block : section.blocks) text += std::visit(MarkdownWriter(), block);
  for (const Section& inner : section.sections) text += markdown(inner, hashes + "#");
  return text;
}

}  // namespace

std::string markdown_section(const Section& section) { return markdown(section, "##"); }

}  // namespace croon
