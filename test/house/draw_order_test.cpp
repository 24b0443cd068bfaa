// Compilers evaluate the arguments of a call in orders of their own, so two of them that draw from
// one generator are other numbers with another compiler. Between braces the order is fixed.
#include <gtest/gtest.h>

#include <regex>

#include "test/support/tree.hpp"

namespace croon::test {
namespace {

/// The end of the argument list that opens at `open`, or npos where it holds a statement.
std::size_t end_of_arguments(const std::string& text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size() && text[i] != ';'; ++i) {
    if (text[i] == '(' || text[i] == '{') ++depth;
    if (text[i] == ')' || text[i] == '}') --depth;
    if (depth == 0) return i;
  }
  return std::string::npos;
}

/// How many arguments between `open` and `end` draw from a generator that is called rng.
int drawing_arguments(const std::string& text, std::size_t open, std::size_t end) {
  static const std::regex draws(R"(\brng\.\w+\(|\w\(rng\b)");
  int count = 0;
  int depth = 0;
  std::size_t begin = open + 1;
  for (std::size_t i = begin; i <= end; ++i) {
    if (i == end || (depth == 0 && text[i] == ',')) {
      count += std::regex_search(text.substr(begin, i - begin), draws) ? 1 : 0;
      begin = i + 1;
    }
    if (text[i] == '(' || text[i] == '{') ++depth;
    if (text[i] == ')' || text[i] == '}') --depth;
  }
  return count;
}

/// The argument lists of `text` in which the order of evaluation decides what is drawn.
std::vector<std::string> lists_without_order(const std::string& text) {
  std::vector<std::string> found;
  for (std::size_t open = text.find('('); open != std::string::npos;
       open = text.find('(', open + 1)) {
    const std::size_t end = end_of_arguments(text, open);
    if (end == std::string::npos) continue;
    if (drawing_arguments(text, open, end) > 1) found.push_back(text.substr(open, end - open + 1));
  }
  return found;
}

TEST(DrawOrder, IsTheSameForEveryCompiler) {
  for (const std::string& file : tree_files("", "pp")) {
    std::string text;
    for (const Line& line : lines_of(file)) text += line.text + "\n";
    for (const std::string& list : lists_without_order(text)) {
      ADD_FAILURE() << file << " draws twice in one argument list: " << list;
    }
  }
}

TEST(DrawOrder, KnowsTheListsThatHaveNone) {
  const std::string u = "rng.uni" + std::string("form()");
  EXPECT_EQ(lists_without_order("f(" + u + ", " + u + ");").size(), 1U);
  EXPECT_EQ(lists_without_order("f(g(r" + std::string("ng), {1, ") + u + "});").size(), 1U);
  EXPECT_EQ(lists_without_order("V{" + u + ", " + u + "};").size(), 0U);
  EXPECT_EQ(lists_without_order("f(V{" + u + ", " + u + "}, 1);").size(), 0U);
  EXPECT_EQ(lists_without_order("f(a * (1 + " + u + "), b);").size(), 0U);
}

}  // namespace
}  // namespace croon::test
