#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace croon {

/// Maximum size of the header of a point cloud file, bytes; a longer header is not recognised.
constexpr std::size_t kMaxHeaderBytes = 64 * 1024;

/// Reads a text line by line; line endings are `\n` or `\r\n`, and the last may be missing. Returns
/// views into the text, which must outlive it.
class LineReader {
 public:
  /// Line numbers start after `lines_before`.
  explicit LineReader(std::string_view text, int lines_before = 0)
      : text_(text), number_(lines_before) {}

  /// Advances to the next line; returns false if there is none.
  bool next();
  /// The line without its line ending.
  std::string_view line() const { return line_; }
  /// The whole text.
  std::string_view text() const { return text_; }
  /// The line number, starting at 1.
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

/// `text` without leading and trailing blanks.
std::string_view trimmed(std::string_view text);
/// Removes the next word from `rest` and returns it; empty if there is none.
std::string_view next_word(std::string_view& rest);
/// Sets `words` to the words of `line`, reusing its memory.
void split_words(std::string_view line, std::vector<std::string_view>& words);
/// The words of a line.
std::vector<std::string_view> words_of(std::string_view line);

/// `text` in quotes for an error message, shortened and with unprintable characters replaced.
std::string in_quotes(std::string_view text);

/// Parses `word` as a number, including "nan" and "inf", independent of the locale; std::nullopt if
/// the whole word is not a number.
std::optional<double> number_from(std::string_view word);
/// The same for a non-negative whole number.
std::optional<std::uint64_t> count_from(std::string_view word);

}  // namespace croon
