#include <string_view>

#include "experiments/report/export_formats.hpp"

namespace croon::experiments {

namespace {

bool is_one_of(std::string_view characters, char c) {
  return characters.find(c) != std::string_view::npos;
}

bool ends_line(char c) { return c == '\n' || c == '\r'; }

const char* latex_command(char c) {
  switch (c) {
    case '\\':
      return "\\textbackslash{}";
    case '^':
      return "\\textasciicircum{}";
    case '~':
      return "\\textasciitilde{}";
    case '<':
      return "\\textless{}";
    case '>':
      return "\\textgreater{}";
    case '|':
      return "\\textbar{}";
    default:
      return nullptr;
  }
}

}  // namespace

std::string latex_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (const char* command = latex_command(c)) {
      escaped += command;
    } else if (is_one_of("{}$&#_%", c)) {
      escaped += std::string("\\") + c;
    } else if (is_one_of("[]*-`'", c)) {
      // Behind a line's end "[" and "*" are its options; two of the others are one other sign.
      escaped += std::string("{") + c + "}";
    } else {
      escaped += ends_line(c) ? ' ' : c;
    }
  }
  return escaped;
}

std::string latex_breakable(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    text += latex_escaped(name.substr(i, 1));
    // Not inside 0.05.
    const bool is_in_number = i + 1 < name.size() && name[i + 1] >= '0' && name[i + 1] <= '9';
    if (is_one_of("/_=,", name[i]) || (name[i] == '.' && !is_in_number)) text += "\\allowbreak{}";
  }
  return text;
}

std::string markdown_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (is_one_of("\\`*_[]<>|~&#", c)) escaped += '\\';
    escaped += ends_line(c) ? ' ' : c;
  }
  return escaped;
}

}  // namespace croon::experiments
