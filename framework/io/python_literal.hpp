#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace croon {

/// A Python literal, as in the header of a NumPy array.
struct PythonLiteral {
  enum class Kind { text, number, truth, list, dict };
  Kind kind = Kind::number;
  std::string text;      ///< The characters of a string or number.
  bool is_true = false;  ///< The value of True or False.
  /// Of a list or tuple; of a dict its alternating keys and values.
  std::vector<PythonLiteral> items;

  /// The value of `key` in a dict, or null.
  const PythonLiteral* find(std::string_view key) const;
};

/// Parses all of `text` as a literal: strings without escapes, whole numbers, True, False, lists,
/// tuples and dicts. Throws std::invalid_argument for anything else.
PythonLiteral parse_python_literal(std::string_view text);

}  // namespace croon
