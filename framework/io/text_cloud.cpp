#include "framework/io/text_cloud.hpp"

#include "framework/base/error.hpp"
#include "framework/io/text_fields.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// Reads the points of a text line by line.
class TextPoints {
 public:
  TextPoints(const TextLayout& layout, std::string_view body, const std::string& file)
      : layout_(layout), reader_(body, layout.lines), file_(file) {}

  /// Advances to the next line with numbers; returns false at the end.
  bool next() {
    while (reader_.next()) {
      const std::string_view line = trimmed(reader_.line());
      const bool is_comment =
          !line.empty() && (line[0] == '#' || line[0] == '%' || line.substr(0, 2) == "//");
      if (line.empty() || is_comment) continue;
      split_fields(line, layout_.separator, fields_);
      if (fields_.size() == layout_.fields.size()) return true;
      fail("expected " + std::to_string(layout_.fields.size()) + " numbers, found " +
           std::to_string(fields_.size()));
    }
    return false;
  }

  double number(std::size_t column) const {
    std::string_view word = fields_[column];
    if (layout_.separator != ' ') word = trimmed(word);
    const std::optional<double> value = number_from(word);
    if (value) return *value;
    fail("expected a number for " + in_quotes(layout_.fields[column]) + ", found " +
         in_quotes(word) +
         (word.find(',') == std::string_view::npos ? "" : "; write numbers with a decimal point"));
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_, reader_.place(), message);
  }

  const TextLayout& layout_;
  LineReader reader_;
  const std::string& file_;
  std::vector<std::string_view> fields_;
};

}  // namespace

LoadedCloud parse_text_cloud(std::string_view bytes, const std::string& file,
                             const Eigen::Vector3d& origin_m) {
  const TextLayout layout = text_layout(bytes, file);
  const std::vector<std::string> names = text_channel_names(layout);
  LoadedCloud cloud;
  cloud.origin_m = origin_m;
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (names[c].empty()) continue;
    columns.push_back(c);
    cloud.channels.push_back({names[c], scalar_type_of<double>(), 1, {}});
  }
  TextPoints lines(layout, bytes.substr(layout.body_offset), file);
  std::uint64_t points = 0;
  std::vector<double> numbers(layout.fields.size());
  while (lines.next()) {
    ++points;
    for (std::size_t c = 0; c < numbers.size(); ++c) numbers[c] = lines.number(c);
    if (!cloud.add({numbers[layout.xyz[0]], numbers[layout.xyz[1]], numbers[layout.xyz[2]]})) {
      continue;
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      append_scalar(cloud.channels[i].bytes, scalar_type_of<double>(), numbers[columns[i]]);
    }
  }
  if (layout.points && *layout.points != points) {
    throw InputError(
        file, "",
        "expected " + std::to_string(*layout.points) + " points, found " + std::to_string(points));
  }
  return cloud;
}

}  // namespace croon
