#include "benchmarks/report/markdown.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/text.hpp"

namespace croon::benchmarks {

std::string three_digits(double value) {
  const int before = value > 0.0 ? static_cast<int>(std::floor(std::log10(value))) : 0;
  return fixed_number(value, std::clamp(2 - before, 0, 6));
}

std::string row_of(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + cell + " |";
  return row + "\n";
}

std::string header_of(const std::vector<std::string>& titles) {
  std::string text = row_of(titles) + "|";
  for (std::size_t i = 0; i < titles.size(); ++i) text += i == 0 ? "---|" : "---:|";
  return text + "\n";
}

std::string code(const std::string& name) { return "`" + name + "`"; }

}  // namespace croon::benchmarks
