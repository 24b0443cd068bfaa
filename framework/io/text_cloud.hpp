#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The layout of a text with one point per line, whose numbers are separated by commas, semicolons
/// or blanks.
struct TextLayout {
  char separator = ' ';  ///< A blank means any number of blanks and tabs.
  /// From the header; "x", "y", "z", "intensity", ... without one.
  std::vector<std::string> fields;
  std::array<std::size_t, 3> xyz{};     ///< Indices of the coordinates.
  std::optional<std::uint64_t> points;  ///< Set if the first line is their number, as in .pts.
  bool has_header = false;
  std::size_t body_offset = 0;  ///< Bytes before the points.
  int lines = 0;                ///< Lines before the points.
};

/// Determines the layout of the text that begins with `head`. A header names x, y and z in any case
/// and with any unit in brackets ("X (m)"), and may be a comment ("//X Y Z", "# x,y,z"); without
/// one the columns are x, y, z, intensity. Lines that begin with #, % or // are comments. `file` is
/// the name in errors. Throws InputError with the faulty line and the reason.
TextLayout text_layout(std::string_view head, const std::string& file);

/// The name of the channel in each field, see `channel_names`.
std::vector<std::string> text_channel_names(const TextLayout& layout);

/// Parses the points of a text (CSV, TXT, XYZ), with its other columns as channels of double.
/// `origin_m` is subtracted. Throws InputError like `text_layout`, and for a line with a different
/// number of columns.
LoadedCloud parse_text_cloud(std::string_view bytes, const std::string& file,
                             const Eigen::Vector3d& origin_m);

/// Whether the text that begins with `head` certainly contains points, for files whose suffix is
/// ambiguous (.csv, .txt): its header names x, y and z, or each line has 3 or 4 numbers.
bool is_text_cloud(std::string_view head);

}  // namespace croon
