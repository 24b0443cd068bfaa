#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace croon {

/// The header of a point cloud file is at most so long; one whose first bytes hold no whole header
/// has none.
constexpr std::size_t kMostHeaderBytes = 64 * 1024;

/// Goes through a text line by line; ends of line are `\n` or `\r\n`, and the last may be missing.
/// Views into the text, which must outlive it.
class LineReader {
 public:
  /// `number` counts from the line after `lines_before`.
  explicit LineReader(std::string_view text, int lines_before = 0)
      : text_(text), number_(lines_before) {}

  /// Goes to the next line; false where there is none.
  bool next();
  /// The line, without its end.
  std::string_view line() const { return line_; }
  /// Its number, from one.
  int number() const { return number_; }
  /// "line 7", as an error says it.
  std::string place() const { return "line " + std::to_string(number_); }
  /// Where the text goes on after the line, bytes.
  std::size_t end() const { return end_; }

 private:
  std::string_view text_;
  std::string_view line_;
  std::size_t end_ = 0;
  int number_ = 0;
};

/// `text` without blanks at its ends.
std::string_view trimmed(std::string_view text);
/// Cuts the next word off `rest`; empty where there is none.
std::string_view next_word(std::string_view& rest);
/// The words of a line.
std::vector<std::string_view> words_of(std::string_view line);

/// `text` in quotes for an error: short and printable, whatever the file holds.
std::string in_quotes(std::string_view text);

/// The number that the whole word is, in any locale ("nan" and "inf" too); nothing where it is
/// none.
std::optional<double> number_from(std::string_view word);
/// The same for a number that counts something.
std::optional<std::uint64_t> count_from(std::string_view word);

}  // namespace croon
