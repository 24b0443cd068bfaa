#include <algorithm>
#include <cctype>

#include "framework/base/error.hpp"
#include "framework/io/channel_names.hpp"
#include "framework/io/float_rows.hpp"
#include "framework/io/text_cloud.hpp"
#include "framework/io/text_fields.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// `field` without surrounding quotes and blanks, and without a unit in brackets.
std::string plain_name(std::string_view field) {
  field = trimmed(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = trimmed(field.substr(1, field.size() - 2));
  }
  const std::size_t unit = field.find_first_of("([");
  if (unit != 0 && unit != std::string_view::npos) field = trimmed(field.substr(0, unit));
  std::string name(field);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Whether `name` denotes the coordinate `axis`; ParaView and VeloView write the last two forms.
bool is_axis(const std::string& name, std::size_t axis) {
  const std::string letter(1, "xyz"[axis]), index = std::to_string(axis);
  return name == letter || name == letter + "_m" || name == "points:" + index ||
         name == "points_m_xyz:" + index;
}

std::optional<std::array<std::size_t, 3>> find_xyz(const std::vector<std::string>& fields) {
  std::array<std::size_t, 3> xyz{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (is_axis(lower(fields[i]), axis)) found.push_back(i);
    }
    if (found.empty()) return std::nullopt;
    // Plain names take precedence over those of specific programs.
    const auto is_plain = [&](std::size_t i) { return fields[i].size() == 1; };
    const auto plain = std::find_if(found.begin(), found.end(), is_plain);
    xyz[axis] = plain == found.end() ? found.front() : *plain;
  }
  return xyz;
}

/// The separator of a line; commas take precedence, because blanks may follow them.
char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ','}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

std::vector<std::string> header_fields(std::string_view line) {
  std::vector<std::string_view> words;
  split_fields(line, separator_of(line), words);
  std::vector<std::string> fields;
  for (const std::string_view word : words) fields.push_back(plain_name(word));
  return fields;
}

/// Reads the lines before the points.
class LayoutReader {
 public:
  LayoutReader(std::string_view head, const std::string& file)
      : file_(file), reader_(head.substr(0, kMaxHeaderBytes)) {}

  TextLayout read() {
    while (reader_.next()) {
      std::string_view line = trimmed(without_mark(reader_.line()));
      const bool is_comment = remove_comment_sign(line);
      if (line.empty()) continue;
      if (is_comment) {
        note_header(line);
        continue;
      }
      layout_.separator = separator_of(line) == '\t' ? ' ' : separator_of(line);
      split_fields(line, layout_.separator, words_);
      if (are_numbers()) {
        if (words_.size() == 1 && !layout_.points && note_count()) continue;
        finish();
        return layout_;
      }
      if (layout_.has_header || !note_header(line)) fail_at(line);
    }
    if (layout_.has_header) {
      note_body(reader_.end(), reader_.number());
      return layout_;
    }
    throw InputError(file_, "", "expected lines of numbers x, y, z, found none");
  }

 private:
  /// The line without a UTF-8 byte order mark.
  std::string_view without_mark(std::string_view line) const {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    return reader_.number() == 1 && line.substr(0, kMark.size()) == kMark
               ? line.substr(kMark.size())
               : line;
  }

  static bool remove_comment_sign(std::string_view& line) {
    const bool is_comment =
        !line.empty() && (line[0] == '#' || line[0] == '%' || line.substr(0, 2) == "//");
    if (is_comment) line.remove_prefix(std::min(line.find_first_not_of("#%/ \t"), line.size()));
    return is_comment;
  }

  bool are_numbers() const {
    return std::all_of(words_.begin(), words_.end(), [](std::string_view word) {
      return number_from(trimmed(word)).has_value();
    });
  }

  bool note_count() {
    layout_.points = count_from(trimmed(words_[0]));
    return layout_.points.has_value();
  }

  /// Sets the fields if `line` is a header; returns whether it is.
  bool note_header(std::string_view line) {
    std::vector<std::string> fields = header_fields(line);
    const std::optional<std::array<std::size_t, 3>> xyz = find_xyz(fields);
    if (!xyz) return false;
    layout_.xyz = *xyz;
    layout_.fields = std::move(fields);
    layout_.has_header = true;
    return true;
  }

  void note_body(std::size_t offset, int lines) {
    layout_.body_offset = offset;
    layout_.lines = lines;
  }

  /// Completes the layout at the first line with a point.
  void finish() {
    const std::size_t columns = words_.size();
    if (!layout_.has_header) {
      // Lines of 8 or 12 numbers are probably poses.
      constexpr std::size_t kMinColumns = 3, kMaxColumns = 7;
      if (columns < kMinColumns || columns > kMaxColumns) {
        throw InputError(file_, reader_.place(),
                         "expected 3 to 7 numbers x, y, z, ..., or a header that names x, y and z, "
                         "found " +
                             std::to_string(columns));
      }
      for (std::size_t c = 0; c < columns; ++c) {
        layout_.fields.push_back(c < 3 ? std::string(1, "xyz"[c]) : name_of_column(c, columns));
      }
      layout_.xyz = {0, 1, 2};
    }
    note_body(start_of_line(), reader_.number() - 1);
  }

  std::size_t start_of_line() const {
    return static_cast<std::size_t>(reader_.line().data() - reader_.text().data());
  }

  [[noreturn]] void fail_at(std::string_view line) const {
    const bool has_decimal_commas =
        line.find(';') != std::string_view::npos && line.find(',') != std::string_view::npos;
    throw InputError(file_, reader_.place(),
                     "expected numbers, or a header that names x, y and z, found " +
                         in_quotes(line) +
                         (has_decimal_commas ? "; write numbers with a decimal point" : ""));
  }

  const std::string& file_;
  LineReader reader_;
  TextLayout layout_;
  std::vector<std::string_view> words_;
};

}  // namespace

void split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  if (separator == ' ') {
    split_words(line, fields);
    return;
  }
  fields.clear();
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(separator, start), line.size());
    fields.push_back(line.substr(start, end - start));
    start = end + 1;
  }
  // A line may end with a separator.
  if (fields.size() > 1 && trimmed(fields.back()).empty()) fields.pop_back();
}

TextLayout text_layout(std::string_view head, const std::string& file) {
  return LayoutReader(head, file).read();
}

std::vector<std::string> text_channel_names(const TextLayout& layout) {
  std::vector<std::string> fields = layout.fields;
  for (std::string& field : fields) {
    if (field.empty()) field = "_";
  }
  for (const std::size_t axis : layout.xyz) fields[axis] = "_";
  return channel_names(fields);
}

bool is_text_cloud(std::string_view head) {
  try {
    const TextLayout layout = text_layout(head, "");
    return layout.has_header || layout.fields.size() <= 4;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace croon
