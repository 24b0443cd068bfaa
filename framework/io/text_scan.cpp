#include "framework/io/text_scan.hpp"

#include <algorithm>
#include <charconv>

namespace croon {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

template <class T>
std::optional<T> whole_word(std::string_view word) {
  T value{};
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

bool LineReader::next() {
  if (end_ >= text_.size()) return false;
  const std::size_t newline = std::min(text_.find('\n', end_), text_.size());
  line_ = text_.substr(end_, newline - end_);
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  end_ = std::min(newline + 1, text_.size());
  ++number_;
  return true;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view next_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(kBlanks));
  rest.remove_prefix(word.size());
  return word;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n'); };
  const char* const end = line.data() + line.size();
  for (const char* at = line.data(); at != end;) {
    if (is_blank(*at)) {
      ++at;
      continue;
    }
    const char* const first = at;
    while (at != end && !is_blank(*at)) ++at;
    words.emplace_back(first, static_cast<std::size_t>(at - first));
  }
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  split_words(line, words);
  return words;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMaxShown = 60;
  std::string shown = "\"";
  for (const char c : text.substr(0, kMaxShown)) shown += c >= 0x20 && c < 0x7f ? c : '?';
  return shown + (text.size() > kMaxShown ? "...\"" : "\"");
}

std::optional<double> number_from(std::string_view word) {
  // from_chars does not accept a plus sign.
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return whole_word<double>(word);
}

std::optional<std::uint64_t> count_from(std::string_view word) {
  return whole_word<std::uint64_t>(word);
}

}  // namespace croon
