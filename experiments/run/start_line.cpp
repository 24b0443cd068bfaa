#include "experiments/run/start_line.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

constexpr std::size_t kFields = 10;
constexpr double kUnitTolerance = 1e-6;

/// The fields of a line of RFC 4180, without the quotes.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields = {""};
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_doubled = is_quoted && line.compare(i, 2, "\"\"") == 0;
    if (line[i] == '"' && !is_doubled) {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
      if (is_doubled) ++i;
    }
  }
  if (is_quoted) refuse("a second quote", in_quotes(line));
  return fields;
}

double finite_number(const std::string& text) {
  const std::optional<double> number = number_from(text);
  if (!number) refuse("a number", in_quotes(text));
  if (!std::isfinite(*number)) refuse("a finite number", in_quotes(text));
  return *number;
}

int trial_number(const std::string& text) {
  const std::optional<std::uint64_t> number = count_from(text);
  if (!number || *number >= kMaxTrials) {
    refuse("a trial, a whole number from 0 to " + std::to_string(kMaxTrials - 1), in_quotes(text));
  }
  return static_cast<int>(*number);
}

/// Of unit length. What is of unit length but for rounding keeps its bits, so that a start that
/// was written is read as it was.
Eigen::Quaterniond unit(const Eigen::Quaterniond& q) {
  const double length = q.norm();
  if (std::abs(length - 1.0) > kUnitTolerance) {
    refuse("a quaternion of length 1", "one of length " + std::to_string(length));
  }
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  return std::abs(length - 1.0) <= kRounding ? q : q.normalized();
}

}  // namespace

void refuse(const std::string& expected, const std::string& found) {
  throw InputError("", "", "expected " + expected + ", found " + found);
}

StartLine read_start_line(const std::string& text) {
  const std::vector<std::string> fields = fields_of(text);
  if (fields.size() != kFields) {
    refuse(std::to_string(kFields) + " fields", std::to_string(fields.size()));
  }
  StartLine line{fields[0], fields[1], trial_number(fields[2]), {}};
  for (int i = 0; i < 3; ++i) line.start.translation(i) = finite_number(fields[3 + i]);
  Eigen::Quaterniond q;
  for (int i = 0; i < 4; ++i) q.coeffs()(i) = finite_number(fields[6 + i]);
  line.start.rotation = unit(q);
  return line;
}

}  // namespace croon::experiments
