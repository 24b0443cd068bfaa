#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace croon {

/// A value in the notation of Python, as the header of a NumPy array has it.
struct PythonLiteral {
  enum class Kind { text, number, truth, list, dict };
  Kind kind = Kind::number;
  std::string text;                  ///< The characters of a text, or of a number.
  bool is_true = false;              ///< Of True and False.
  std::vector<PythonLiteral> items;  ///< Of a list or tuple; of a dict its keys and values in turn.

  /// The value of `key` in a dict, or null.
  const PythonLiteral* find(std::string_view key) const;
};

/// The value that the whole of `text` spells: texts without escapes, whole numbers, True, False,
/// lists, tuples and dicts. Throws std::invalid_argument for anything else.
PythonLiteral parse_python_literal(std::string_view text);

}  // namespace croon
