#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace croon {

/// The largest header of a point cloud file, bytes; a file without a complete header in its first
/// bytes has none.
constexpr std::size_t kMostHeaderBytes = 64 * 1024;

/// Goes through a text line by line; ends of line are `\n` or `\r\n`, and the last may be missing.
/// Views into the text, which must outlive it.
class LineReader {
 public:
  /// `number` counts from the line after `lines_before`.
  explicit LineReader(std::string_view text, int lines_before = 0)
      : text_(text), number_(lines_before) {}

  /// Goes to the next line; false if there is none.
  bool next();
  /// The line, without its end.
  std::string_view line() const { return line_; }
  /// All lines.
  std::string_view text() const { return text_; }
  /// Its number, from one.
  int number() const { return number_; }
  /// "line 7", for errors.
  std::string place() const { return "line " + std::to_string(number_); }
  /// The offset of the next line, bytes.
  std::size_t end() const { return end_; }

 private:
  std::string_view text_;
  std::string_view line_;
  std::size_t end_ = 0;
  int number_ = 0;
};

/// `text` without blanks at its ends.
std::string_view trimmed(std::string_view text);
/// Removes the next word from `rest` and returns it; empty if there is none.
std::string_view next_word(std::string_view& rest);
/// Makes `words` those of `line`; its memory is used again.
void split_words(std::string_view line, std::vector<std::string_view>& words);
/// The words of a line.
std::vector<std::string_view> words_of(std::string_view line);

/// `text` in quotes for an error, shortened and with unprintable characters replaced.
std::string in_quotes(std::string_view text);

/// The number that `word` spells, independent of the locale ("nan" and "inf" too); std::nullopt if
/// the whole word is not a number.
std::optional<double> number_from(std::string_view word);
/// The same for a number that counts something.
std::optional<std::uint64_t> count_from(std::string_view word);

}  // namespace croon
