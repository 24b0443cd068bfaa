#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "framework/picture/drawing.hpp"
#include "framework/table/table.hpp"

namespace croon {

// A document is plain data: sections of prose, tables and figures. Each renderer (renderers.hpp)
// shows as much of it as its format allows.

/// The tone of a paragraph or card. Renderers show it by a word or symbol too, not by colour alone.
enum class Tone { plain, note, warning, accepted, rejected };

/// A paragraph.
struct Paragraph {
  std::string text;
  Tone tone = Tone::plain;
};

/// A list of short sentences.
struct BulletList {
  std::vector<std::string> items;
};

/// Text, such as a pose in some format, that the reader can copy to the clipboard.
struct CopyText {
  std::string label;
  std::string text;
};

/// A summary of one object, with its verdict.
struct Card {
  std::string title;
  Tone tone = Tone::plain;
  std::string status;  ///< "accepted".
  std::vector<std::string> lines;
  std::string details = {};  ///< Lines in a fixed-width font.
  std::vector<CopyText> copies = {};
};

/// Cards side by side.
struct Cards {
  std::vector<Card> cards;
};

/// A table. In HTML its rows can be sorted, and it can be copied as CSV, LaTeX or Markdown.
struct TableBlock {
  std::string caption;
  Table table;
  View view;
  std::vector<std::string> notes = {};  ///< Below the table.
};

/// A chart.
struct Chart {
  std::string caption;
  Drawing drawing;
};

/// A picture of pixels.
struct Picture {
  std::string caption;
  std::string alt;  ///< Description for readers who do not see it.
  std::string png;  ///< The bytes of a PNG file.
};

/// Charts and pictures side by side where there is room.
struct FigureRow {
  std::vector<std::variant<Chart, Picture>> figures;
};

/// Names and values.
struct Facts {
  std::vector<std::pair<std::string, std::string>> facts;
};

/// Text in a fixed-width font.
struct Preformatted {
  std::string text;
};

/// An interactive view of clouds, in HTML only. The JSON is read by assets/cloud_view.js; the
/// pictures take its place in print and in browsers without WebGL.
struct CloudViewBlock {
  std::string caption;
  std::string json;
  std::vector<Picture> fallback;
};

using Block = std::variant<Paragraph, BulletList, Cards, TableBlock, Chart, Picture, FigureRow,
                           Facts, Preformatted, CloudViewBlock>;

/// A section; in HTML, the sections in it may not be nested further.
struct Section {
  std::string id;  ///< Unique in the document; letters, digits and "-".
  std::string title;
  std::vector<Block> blocks;
  std::vector<Section> sections = {};
};

/// A document.
struct Document {
  std::string title;
  std::string lead;  ///< The main result in a sentence.
  std::vector<Section> sections;
  std::string footer = {};
};

}  // namespace croon
