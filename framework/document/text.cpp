#include "framework/base/text.hpp"

#include <algorithm>

#include "framework/document/renderers.hpp"
#include "framework/table/renderers.hpp"

namespace croon {
namespace {

/// The lines of `text`, each made printable and indented.
std::string indented(const std::string& text, const std::string& indent) {
  std::string lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines += indent + printable(text.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  return lines;
}

/// Writes the blocks that a terminal can show.
class TextWriter {
 public:
  explicit TextWriter(bool colours) : colours_(colours) {}

  std::string operator()(const Paragraph& paragraph) const {
    const std::string word = paragraph.tone == Tone::warning ? "warning: " : "";
    return word + printable(paragraph.text) + "\n";
  }

  std::string operator()(const BulletList& list) const {
    std::string text;
    for (const std::string& item : list.items) text += "- " + printable(item) + "\n";
    return text;
  }

  std::string operator()(const Cards& cards) const {
    std::string text = "\n";
    for (const Card& card : cards.cards) {
      text += status(card) + printable(card.title) + "\n";
      if (card.tone == Tone::warning) text += indented(card.status, "  ");
      for (const std::string& line : card.lines) text += indented(line, "  ");
      text += indented(card.details, "  ") + "\n";
    }
    return text;
  }

  std::string operator()(const TableBlock& block) const {
    std::string text = block.caption.empty() ? "" : printable(block.caption) + "\n";
    text += text_table(block.table, block.view, colours_);
    for (const std::string& note : block.notes) text += printable(note) + "\n";
    return text;
  }

  std::string operator()(const Facts& facts) const {
    std::string text;
    for (const auto& [name, value] : facts.facts) {
      text += printable(name) + ": " + printable(value) + "\n";
    }
    return text;
  }

  std::string operator()(const Preformatted& block) const {
    return indented(block.text, "") + "\n";
  }

  /// Figures.
  template <class Figure>
  std::string operator()(const Figure&) const {
    return "";
  }

 private:
  /// The status in capitals, so that it is visible without colours.
  std::string status(const Card& card) const {
    switch (card.tone) {
      case Tone::accepted:
        return coloured("ACCEPTED", "32") + "  ";
      case Tone::rejected:
        return coloured("REJECTED", "31") + "  ";
      case Tone::warning:
        return coloured("WARNING", "33") + "   ";
      default:
        return "";
    }
  }

  /// `word` in a colour of the terminal.
  std::string coloured(const std::string& word, const std::string& colour) const {
    return colours_ ? "\033[" + colour + "m" + word + "\033[0m" : word;
  }

  bool colours_;
};

}  // namespace

std::string text_section(const Section& section, bool colours) {
  const TextWriter writer(colours);
  std::string text;
  for (const Block& block : section.blocks) text += std::visit(writer, block);
  for (const Section& inner : section.sections) {
    const std::string title = printable(inner.title);
    text += (text.empty() ? "" : "\n") + (colours ? "\033[1m" + title + "\033[0m" : title) + "\n" +
            text_section(inner, colours);
  }
  return text;
}

}  // namespace croon
