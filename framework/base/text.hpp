#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace croon {

/// A spreadsheet treats a cell that begins with one of these as a formula.
inline constexpr const char* kFormulaSigns = "=+-@";

/// The maximum size of the name of a file or folder on common file systems, in bytes.
inline constexpr std::size_t kMaxFileNameBytes = 255;

/// The maximum size of the name of a variant or a step, in bytes; for scenes and sensors it is
/// less.
inline constexpr std::size_t kMaxNameBytes = 1000;

/// "expected WHAT of at most 255 bytes, found one of 256" if `name` has more than `max_bytes`
/// bytes; otherwise empty.
std::string why_too_long(const std::string& name, std::size_t max_bytes,
                         const std::string& what = "a name");

/// The number of columns of UTF-8 text, i.e. of its code points.
std::size_t text_columns(const std::string& text);

/// The first `columns` columns of UTF-8 text; if the text is cut, the last of them is "…".
std::string cut_to_columns(const std::string& text, std::size_t columns);

/// The same with "…" in the middle: names in a grid differ at their ends.
std::string cut_in_the_middle(const std::string& text, std::size_t columns);

/// `text` padded with spaces on the left to `columns`.
std::string right_aligned(const std::string& text, std::size_t columns);

/// `text` padded with spaces on the right to `columns`.
std::string left_aligned(const std::string& text, std::size_t columns);

/// `value` with `decimals` decimals, the same in every locale; a value that rounds to zero has no
/// sign.
std::string fixed_number(double value, int decimals);

/// `value` in the fewest digits that parse to the same bits (std::to_chars); zero and "nan" never
/// have a sign.
std::string shortest_number(double value);

/// `value` with all its digits, and without an exponent below 1e9: "-0.0005".
std::string plain_number(double value);

/// `text` with U+FFFD in place of each byte that is not valid UTF-8.
std::string valid_utf8(const std::string& text);

/// `text` as UTF-8, with a space in place of each control character but "\n" and "\t".
std::string without_controls(const std::string& text);

/// `text` without controls, escaped for the content of an element or attribute in HTML and SVG.
std::string markup_escaped(const std::string& text);

/// `text` escaped for LaTeX, for a table cell or a sentence.
std::string latex_escaped(const std::string& text);

/// `text` with `?` in place of each control character, each character that is invisible or changes
/// the direction of others, and each byte that is not valid UTF-8. The result is a single line and
/// sends no commands to a terminal.
std::string printable(const std::string& text);

/// "a, b, c".
std::string list_text(const std::vector<std::string>& texts, const std::string& between = ", ");

/// "1 trial", "2 trials".
std::string counted(std::size_t count, const std::string& what);

/// Hours, minutes and seconds: "3:07", "1:02:03".
std::string clock_text(double seconds);

}  // namespace croon
