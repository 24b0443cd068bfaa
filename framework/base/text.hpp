#pragma once

#include <cstddef>
#include <string>

namespace croon {

/// A cell that begins with one of these is a formula to a spreadsheet.
inline constexpr const char* kFormulaSigns = "=+-@";

/// The bytes of the name of a file or folder, on the usual file systems.
inline constexpr std::size_t kMostFileNameBytes = 255;

/// The longest name of a variant or a step, in bytes; those of scenes and sensors are shorter.
inline constexpr std::size_t kMostNameBytes = 1000;

/// "expected WHAT of at most 255 bytes, found one of 256" if `name` has more bytes than `most`;
/// else empty.
std::string why_too_long(const std::string& name, std::size_t most,
                         const std::string& what = "a name");

/// The number of columns that UTF-8 text takes: its code points.
std::size_t text_columns(const std::string& text);

/// The first `columns` columns of UTF-8 text; if something is cut off, the last of them is "…".
std::string cut_to_columns(const std::string& text, std::size_t columns);

/// The same with "…" in the middle: names of one grid differ at their ends.
std::string cut_in_the_middle(const std::string& text, std::size_t columns);

/// `text` with spaces before it, to fill `columns`.
std::string right_aligned(const std::string& text, std::size_t columns);

/// `text` with spaces after it, to fill `columns`.
std::string left_aligned(const std::string& text, std::size_t columns);

/// `value` with so many decimals, the same in every locale; what rounds to zero has no sign.
std::string fixed_number(double value, int decimals);

/// `value` in the fewest digits that read back as the same bits (std::to_chars); zero and
/// "nan" never have a sign.
std::string shortest_number(double value);

/// `value` with as many digits as it takes, and no exponent below 1e9: "-0.0005".
std::string plain_number(double value);

/// `text` with U+FFFD for each byte that is not part of UTF-8.
std::string valid_utf8(const std::string& text);

/// `text` as LaTeX prints it, in a cell or a sentence.
std::string latex_escaped(const std::string& text);

/// `text` with `?` for each control character, each character that cannot be seen or changes the
/// direction of others, and each byte that is not part of UTF-8, so that it is one line, gives no
/// commands to a terminal and reads as it is.
std::string printable(const std::string& text);

/// "1 trial", "2 trials".
std::string counted(std::size_t count, const std::string& what);

/// Hours, minutes and seconds: "3:07", "1:02:03".
std::string clock_text(double seconds);

}  // namespace croon
