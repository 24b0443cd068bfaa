#include <nettle/sha2.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "framework/base/base64.hpp"
#include "framework/base/text.hpp"
#include "framework/document/html_assets.hpp"
#include "framework/document/renderers.hpp"
#include "framework/picture/writers.hpp"
#include "framework/table/renderers.hpp"

namespace croon {
namespace {

/// `text` with `less` for each "<", so that it cannot end the script element that contains it.
std::string without_tags(const std::string& text, const std::string& less) {
  std::string marked;
  marked.reserve(text.size());
  for (const char c : text) c == '<' ? marked += less : marked += c;
  return marked;
}

/// `<name class="of">content</name>`.
std::string element(const std::string& name, const std::string& content,
                    const std::string& of = "") {
  return "<" + name + (of.empty() ? "" : " class=\"" + of + "\"") + ">" + content + "</" + name +
         ">";
}

/// The source of a script in a Content-Security-Policy.
std::string script_hash(std::string_view script) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, script.size(), reinterpret_cast<const std::uint8_t*>(script.data()));
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  return "'sha256-" + base64({reinterpret_cast<const char*>(digest.data()), digest.size()}) + "'";
}

const char* tone_class(Tone tone) {
  switch (tone) {
    case Tone::plain:
      return "";
    case Tone::note:
      return "note";
    case Tone::warning:
      return "warning";
    case Tone::accepted:
      return "accepted";
    case Tone::rejected:
      return "rejected";
  }
  throw std::logic_error("unknown tone");
}

std::string figure(const std::string& kind, const std::string& caption,
                   const std::string& content) {
  const std::string title = caption.empty() ? "" : element("figcaption", markup_escaped(caption));
  return element("figure", title + content, kind) + "\n";
}

/// The text of a cell with its significance mark, the best value bold.
std::string html_cell(const Cell& cell, const Column& column) {
  const std::string text = markup_escaped(shown_text(cell, column));
  return (cell.is_best ? element("strong", text) : text) +
         (cell.mark.empty() ? "" : " " + element("span", markup_escaped(cell.mark), "mark"));
}

/// The value by which a cell is sorted; empty if it is not a number.
std::string sort_key(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell.value)) return shortest_number(*number);
  if (const auto* count = std::get_if<long long>(&cell.value)) return std::to_string(*count);
  return "";
}

/// Writes the blocks of a document. The data of copy buttons and views follow at its end.
class HtmlWriter {
 public:
  std::string operator()(const Paragraph& paragraph) const {
    return element("p", markup_escaped(paragraph.text), tone_class(paragraph.tone)) + "\n";
  }

  std::string operator()(const BulletList& list) const {
    std::string items;
    for (const std::string& item : list.items) items += element("li", markup_escaped(item)) + "\n";
    return items.empty() ? "" : element("ul", "\n" + items, "points") + "\n";
  }

  std::string operator()(const Cards& cards) {
    std::string all;
    for (const Card& card : cards.cards) {
      const std::string tone = card.tone == Tone::plain ? "neutral" : tone_class(card.tone);
      std::string content =
          element("h3", markup_escaped(card.title)) +
          (card.status.empty() ? "" : element("p", markup_escaped(card.status), "status"));
      for (const std::string& line : card.lines)
        content += element("p", markup_escaped(line)) + "\n";
      if (!card.details.empty()) content += element("pre", markup_escaped(card.details)) + "\n";
      if (!card.copies.empty()) {
        content += element(
            "details", element("summary", "Copy the pose") + copy_buttons(card.copies), "copies");
      }
      all += element("article", content, "card " + tone) + "\n";
    }
    return element("div", "\n" + all, "cards") + "\n";
  }

  std::string operator()(const TableBlock& block) {
    const View view = with_heading_as_column(block.view);
    std::string head;
    for (std::size_t k = 0; k < view.columns.size(); ++k) {
      const std::string scope = "<th scope=\"col\"" + number_class(k, view) + ">";
      head += scope + markup_escaped(view.columns[k].title) + "</th>";
    }
    const std::vector<ShownCells> columns = shown_cells(block.table, view);
    std::string body;
    for (const CellRow& row : block.table.rows) {
      std::string cells;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const std::vector<ShownCells::Piece>& pieces = columns[k].pieces();
        const std::string key = pieces.empty() ? "" : sort_key(row[pieces.front().column]);
        cells += "<td" + number_class(k, view) +
                 (key.empty() ? "" : " data-value=\"" + markup_escaped(key) + "\"") + ">" +
                 columns[k].content(row, html_cell) + "</td>";
      }
      body += element("tr", cells) + "\n";
    }
    const std::string table = element(
        "table", element("thead", element("tr", head)) + "\n" + element("tbody", "\n" + body),
        "sortable");
    const std::vector<CopyText> copies = {{"CSV", csv_table(block.table)},
                                          {"Markdown", markdown_table(block.table, view)},
                                          {"LaTeX", latex_tabular(block.table, view)}};
    std::string notes;
    for (const std::string& note : block.notes) notes += (*this)(Paragraph{note, Tone::note});
    return figure("table", block.caption,
                  element("div", table, "scroll") + notes +
                      element("p", "Copy as " + copy_buttons(copies), "copies"));
  }

  std::string operator()(const Chart& chart) const {
    return figure("chart", chart.caption, inline_svg(chart.drawing));
  }

  std::string operator()(const Picture& picture) const {
    return figure("picture", picture.caption,
                  "<img alt=\"" + markup_escaped(picture.alt) + "\" src=\"data:image/png;base64," +
                      base64(picture.png) + "\">");
  }

  std::string operator()(const FigureRow& row) const {
    std::string figures;
    for (const auto& one : row.figures) figures += std::visit(*this, one);
    return figures.empty() ? "" : element("div", "\n" + figures, "row") + "\n";
  }

  std::string operator()(const Facts& facts) const {
    std::string list;
    for (const auto& [name, value] : facts.facts) {
      list += element("dt", markup_escaped(name)) + element("dd", markup_escaped(value)) + "\n";
    }
    return list.empty() ? "" : element("dl", "\n" + list, "facts") + "\n";
  }

  std::string operator()(const Preformatted& block) const {
    return element("pre", markup_escaped(block.text)) + "\n";
  }

  std::string operator()(const CloudViewBlock& view) {
    std::string pictures;
    for (const Picture& picture : view.fallback) pictures += (*this)(picture);
    const std::string caption = element("figcaption", markup_escaped(view.caption));
    return "<figure class=\"cloud-view\" data-view=\"" +
           add_data("view", "application/json", without_tags(view.json, "\\u003c")) + "\">" +
           caption + element("div", "\n" + pictures, "fallback") + "</figure>\n";
  }

  std::string section(const Section& section, int level) {
    std::string content =
        element("h" + std::to_string(level), markup_escaped(section.title)) + "\n";
    for (const Block& block : section.blocks) content += std::visit(*this, block);
    for (const Section& inner : section.sections) content += this->section(inner, level + 1);
    return "<section id=\"" + markup_escaped(section.id) + "\">" + content + "</section>\n";
  }

  const std::string& data() const { return data_; }

 private:
  static std::string number_class(std::size_t column, const View& view) {
    return column < view.names ? "" : " class=\"number\"";
  }

  /// Adds `data` as a script element of the type `type`, which does not run; returns its id.
  std::string add_data(const std::string& kind, const std::string& type, const std::string& data) {
    const std::string id = kind + "-" + std::to_string(++count_);
    data_ += "<script type=\"" + type + "\" id=\"" + id + "\">" + data + "</script>\n";
    return id;
  }

  /// The page's script removes the backslash behind each "<".
  std::string copy_buttons(const std::vector<CopyText>& copies) {
    std::string buttons;
    for (const CopyText& copy : copies) {
      const std::string text = without_tags(without_controls(copy.text), "<\\");
      buttons += "<button type=\"button\" data-copy=\"" + add_data("copy", "text/plain", text) +
                 "\">" + markup_escaped(copy.label) + "</button> ";
    }
    return buttons;
  }

  int count_ = 0;
  std::string data_;
};

}  // namespace

bool can_write_html() { return !report_script().empty(); }

std::string html_document(const Document& document) {
  if (!can_write_html()) throw std::logic_error("this build writes no reports");
  HtmlWriter writer;
  std::string sections, links;
  for (const Section& section : document.sections) {
    links += "<li><a href=\"#" + markup_escaped(section.id) + "\">" +
             markup_escaped(section.title) + "</a></li>";
    sections += writer.section(section, 2);
  }
  std::string policy, scripts;
  for (const std::string_view script : {three_script(), cloud_view_script(), report_script()}) {
    policy += " " + script_hash(script);
    scripts += "<script>" + std::string(script) + "</script>\n";
  }
  const std::string title = markup_escaped(document.title);
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src "
         "data:; "
         "style-src 'unsafe-inline'; script-src" +
         policy + "\">\n" + element("title", title) + "\n<style>\n" + std::string(report_style()) +
         inline_style_sheet() + "</style></head>\n<body>\n<header>" + element("h1", title) +
         element("p", markup_escaped(document.lead), "lead") +
         "</header>\n<nav aria-label=\"Sections\"><ul>" + links + "</ul></nav>\n<main>\n" +
         sections + "</main>\n<footer>" + markup_escaped(document.footer) + "</footer>\n" +
         writer.data() + scripts + "</body></html>\n";
}

}  // namespace croon
