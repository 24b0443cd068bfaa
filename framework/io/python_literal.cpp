#include "framework/io/python_literal.hpp"

#include <cctype>
#include <stdexcept>

namespace croon {
namespace {

class LiteralParser {
 public:
  explicit LiteralParser(std::string_view text) : rest_(text) {}

  PythonLiteral parse_all() {
    PythonLiteral value = parse(0);
    skip_blanks();
    if (!rest_.empty()) fail();
    return value;
  }

 private:
  [[noreturn]] static void fail() { throw std::invalid_argument("not a Python literal"); }

  void skip_blanks() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())) != 0) {
      rest_.remove_prefix(1);
    }
  }

  bool take(std::string_view word) {
    skip_blanks();
    if (rest_.substr(0, word.size()) != word) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  PythonLiteral parse(int depth) {
    constexpr int kMaxDepth = 16;
    if (depth > kMaxDepth) fail();
    skip_blanks();
    if (rest_.empty()) fail();
    const char first = rest_.front();
    if (first == '\'' || first == '"') return text();
    if (take("{")) return items("}", PythonLiteral::Kind::dict, depth);
    if (take("[")) return items("]", PythonLiteral::Kind::list, depth);
    if (take("(")) return items(")", PythonLiteral::Kind::list, depth);
    PythonLiteral value;
    value.kind = PythonLiteral::Kind::truth;
    value.is_true = take("True");
    if (value.is_true || take("False")) return value;
    return number();
  }

  PythonLiteral text() {
    const char quote = rest_.front();
    const std::size_t end = rest_.find(quote, 1);
    if (end == std::string_view::npos) fail();
    PythonLiteral value;
    value.kind = PythonLiteral::Kind::text;
    value.text = rest_.substr(1, end - 1);
    if (value.text.find('\\') != std::string::npos) fail();
    rest_.remove_prefix(end + 1);
    return value;
  }

  PythonLiteral number() {
    PythonLiteral value;
    while (!rest_.empty() && std::isdigit(static_cast<unsigned char>(rest_.front())) != 0) {
      value.text += rest_.front();
      rest_.remove_prefix(1);
    }
    if (value.text.empty()) fail();
    take("L");  // The suffix of integers in Python 2.
    return value;
  }

  PythonLiteral items(std::string_view end, PythonLiteral::Kind kind, int depth) {
    PythonLiteral value;
    value.kind = kind;
    while (!take(end)) {
      if (!value.items.empty() && !take(",")) fail();
      if (take(end)) break;
      value.items.push_back(parse(depth + 1));
      if (kind != PythonLiteral::Kind::dict) continue;
      if (!take(":")) fail();
      value.items.push_back(parse(depth + 1));
    }
    return value;
  }

  std::string_view rest_;
};

}  // namespace

const PythonLiteral* PythonLiteral::find(std::string_view key) const {
  if (kind != Kind::dict) return nullptr;
  for (std::size_t i = 0; i + 1 < items.size(); i += 2) {
    if (items[i].kind == Kind::text && items[i].text == key) return &items[i + 1];
  }
  return nullptr;
}

PythonLiteral parse_python_literal(std::string_view text) {
  return LiteralParser(text).parse_all();
}

}  // namespace croon
