#include "framework/base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>

namespace croon {

namespace {

/// Whether a byte begins a UTF-8 code point.
bool begins_code_point(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

/// The number of bytes of the UTF-8 code point that begins at `at` (RFC 3629); 0 if it is invalid.
std::size_t code_point_bytes(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  if (first < 0x80) return 1;
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || at + bytes > text.size()) return 0;
  for (std::size_t i = at + 1; i < at + bytes; ++i) {
    if (begins_code_point(text[i])) return 0;
  }
  // Overlong encodings, surrogates, and values above U+10FFFF.
  const unsigned char second = byte(at + 1);
  const bool is_wrong = (first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) ||
                        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90);
  return is_wrong ? 0 : bytes;
}

/// The UTF-8 code point encoded in `bytes` bytes at `at`.
std::uint32_t code_point(const std::string& text, std::size_t at, std::size_t bytes) {
  constexpr std::array<unsigned char, 5> kFirstBits = {0, 0x7F, 0x1F, 0x0F, 0x07};
  std::uint32_t value = static_cast<unsigned char>(text[at]) & kFirstBits.at(bytes);
  for (std::size_t i = at + 1; i < at + bytes; ++i) {
    value = value << 6U | (static_cast<unsigned char>(text[i]) & 0x3FU);
  }
  return value;
}

/// Whether a code point is invisible or changes the order of others: control characters, line
/// separators, direction marks, and Unicode's format characters. Two names that differ by one of
/// them look the same.
bool is_unseen(std::uint32_t code) {
  struct Range {
    std::uint32_t first, last;
  };
  static constexpr std::array<Range, 13> kUnseen = {{{0x00, 0x1F},
                                                     {0x7F, 0x9F},
                                                     {0xAD, 0xAD},
                                                     {0x61C, 0x61C},
                                                     {0x115F, 0x1160},
                                                     {0x180B, 0x180F},
                                                     {0x200B, 0x200F},
                                                     {0x2028, 0x202E},
                                                     {0x2060, 0x206F},
                                                     {0x3164, 0x3164},
                                                     {0xFEFF, 0xFEFF},
                                                     {0xFFF9, 0xFFFB},
                                                     {0xE0000, 0xE007F}}};
  return std::any_of(kUnseen.begin(), kUnseen.end(), [code](const Range& range) {
    return range.first <= code && code <= range.last;
  });
}

std::string padding(const std::string& text, std::size_t columns) {
  const std::size_t taken = text_columns(text);
  return std::string(taken < columns ? columns - taken : 0, ' ');
}

std::string two_digits(long long number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

bool is_one_of(std::string_view characters, char c) {
  return characters.find(c) != std::string_view::npos;
}

/// `c` as LaTeX prints it.
std::string escaped(char c) {
  static const std::map<char, const char*> commands = {{'\\', "\\textbackslash{}"},
                                                       {'^', "\\textasciicircum{}"},
                                                       {'~', "\\textasciitilde{}"},
                                                       {'<', "\\textless{}"},
                                                       {'>', "\\textgreater{}"},
                                                       {'|', "\\textbar{}"},
                                                       {'\n', " "},
                                                       {'\r', " "}};
  if (const auto command = commands.find(c); command != commands.end()) return command->second;
  if (is_one_of("{}$&#_%", c)) return std::string("\\") + c;
  // "[" and "*" after a line break would begin its options; two of the others form a ligature.
  if (is_one_of("[]*-`'", c)) return std::string("{") + c + "}";
  return std::string(1, c);
}

}  // namespace

std::size_t text_columns(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_code_point));
}

std::string cut_to_columns(const std::string& text, std::size_t columns) {
  if (text_columns(text) <= columns) return text;
  if (columns == 0) return "";
  std::size_t begun = 0;
  std::size_t end = 0;
  while (!(begins_code_point(text[end]) && ++begun == columns)) ++end;
  return text.substr(0, end) + "…";
}

std::string cut_in_the_middle(const std::string& text, std::size_t columns) {
  const std::size_t all = text_columns(text);
  if (all <= columns || columns < 2) return cut_to_columns(text, columns);
  const std::size_t behind = columns / 2;
  std::size_t begun = 0;
  std::size_t tail = 0;
  while (!(begins_code_point(text[tail]) && ++begun == all - behind + 1)) ++tail;
  return cut_to_columns(text, columns - behind) + text.substr(tail);
}

std::string right_aligned(const std::string& text, std::size_t columns) {
  return padding(text, columns) + text;
}

std::string left_aligned(const std::string& text, std::size_t columns) {
  return text + padding(text, columns);
}

std::string fixed_number(double value, int decimals) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value < 0.0 ? "-inf" : "inf";
  std::array<char, 400> digits;  // The largest double has 309 digits before the decimal point.
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::fixed, decimals)
                       .ptr;
  const std::string text(digits.data(), end);
  return text.find_first_not_of("-0.") == std::string::npos && text[0] == '-' ? text.substr(1)
                                                                              : text;
}

std::string shortest_number(double value) {
  if (value == 0.0) return "0";
  if (std::isnan(value)) return "nan";
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return std::string(digits.data(), end);
}

std::string plain_number(double value) {
  std::array<char, 400> digits;  // The smallest double has over 300 digits after the decimal point.
  const auto format = std::abs(value) < 1e9 ? std::chars_format::fixed : std::chars_format::general;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value + 0.0, format).ptr;
  return {digits.data(), end};
}

std::string printable(const std::string& text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t bytes = code_point_bytes(text, i);
    const bool is_shown = bytes > 0 && !is_unseen(code_point(text, i, bytes));
    shown += is_shown ? text.substr(i, bytes) : "?";
    i += std::max<std::size_t>(bytes, 1);
  }
  return shown;
}

std::string why_too_long(const std::string& name, std::size_t max_bytes, const std::string& what) {
  if (name.size() <= max_bytes) return "";
  return "expected " + what + " of at most " + std::to_string(max_bytes) + " bytes, found one of " +
         std::to_string(name.size());
}

std::string list_text(const std::vector<std::string>& texts, const std::string& between) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : between) + text;
  return list;
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(std::lround(std::min(seconds, 1e9)));
  const long long hours = whole / 3600;
  const long long minutes = whole / 60 % 60;
  return (hours > 0 ? std::to_string(hours) + ":" + two_digits(minutes) : std::to_string(minutes)) +
         ":" + two_digits(whole % 60);
}

std::string valid_utf8(const std::string& text) {
  std::string valid;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = code_point_bytes(text, at);
    valid += size == 0 ? "\xEF\xBF\xBD" : text.substr(at, size);
    at += std::max<std::size_t>(size, 1);
  }
  return valid;
}

std::string without_controls(const std::string& text) {
  std::string clean = valid_utf8(text);
  const auto is_control = [](char c) {
    return (static_cast<unsigned char>(c) < 0x20U && c != '\n' && c != '\t') || c == '\x7f';
  };
  std::replace_if(clean.begin(), clean.end(), is_control, ' ');
  return clean;
}

std::string markup_escaped(const std::string& text) {
  static const std::map<char, const char*> entities = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string markup;
  for (const char c : without_controls(text)) {
    const auto entity = entities.find(c);
    markup += entity == entities.end() ? std::string(1, c) : entity->second;
  }
  return markup;
}

std::string latex_escaped(const std::string& text) {
  std::string latex;
  for (const char c : text) latex += escaped(c);
  return latex;
}

}  // namespace croon
