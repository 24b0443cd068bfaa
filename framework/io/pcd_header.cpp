#include "framework/io/pcd_header.hpp"

#include <limits>
#include <map>
#include <optional>

#include "framework/base/error.hpp"
#include "framework/io/channel_names.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

const std::vector<std::string> kKeywords = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                            "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

/// The words after the keyword in one line of the header.
struct Entry {
  std::vector<std::string> words;
  std::string place;
};

/// The lines of the header by keyword, and the offset of the points.
class HeaderLines {
 public:
  HeaderLines(std::string_view bytes, const std::string& file) : file_(file) {
    LineReader reader(bytes.substr(0, kMaxHeaderBytes));
    while (entries_.count("DATA") == 0) {
      if (!reader.next())
        fail("", entries_.empty() ? "is not a PCD file: it has no header"
                                  : "the header ends without a line DATA");
      note(reader);
    }
    body_offset = reader.end();
    lines = reader.number();
  }

  const Entry* find(const std::string& keyword) const {
    const auto found = entries_.find(keyword);
    return found == entries_.end() ? nullptr : &found->second;
  }

  const Entry& at(const std::string& keyword) const {
    const Entry* entry = find(keyword);
    if (entry == nullptr) fail("", "the header has no line " + keyword);
    return *entry;
  }

  /// The single number in a line; std::nullopt if the line is missing.
  std::optional<std::uint64_t> number(const std::string& keyword) const {
    const Entry* entry = find(keyword);
    if (entry == nullptr) return std::nullopt;
    if (entry->words.size() != 1) fail(entry->place, "expected one number after " + keyword);
    return count(*entry, entry->words[0]);
  }

  std::uint64_t count(const Entry& entry, const std::string& word) const {
    const std::optional<std::uint64_t> value = count_from(word);
    if (!value) fail(entry.place, "expected a number of at least 0, found " + in_quotes(word));
    return *value;
  }

  [[noreturn]] void fail(const std::string& place, const std::string& message) const {
    throw InputError(file_, place, message);
  }

  std::size_t body_offset = 0;
  int lines = 0;

 private:
  void note(const LineReader& reader) {
    std::vector<std::string_view> words = words_of(reader.line());
    if (words.empty() || words[0].front() == '#') return;
    std::string keyword(words[0]);
    if (keyword == "COLUMNS") keyword = "FIELDS";  // Its name before version .7.
    bool is_known = false;
    for (const std::string& known : kKeywords) is_known = is_known || known == keyword;
    if (!is_known && entries_.empty()) {
      fail(reader.place(),
           "is not a PCD file: expected its header, found " + in_quotes(reader.line()));
    }
    if (!is_known)
      fail(reader.place(), "unknown word " + in_quotes(keyword) + name_hint(keyword, kKeywords));
    const Entry entry{{words.begin() + 1, words.end()}, reader.place()};
    if (!entries_.emplace(keyword, entry).second) {
      fail(reader.place(), "the header has a duplicate line " + keyword);
    }
  }

  const std::string& file_;
  std::map<std::string, Entry> entries_;
};

void check_version(const HeaderLines& header) {
  const Entry* entry = header.find("VERSION");
  if (entry == nullptr) return;
  const std::string version = entry->words.size() == 1 ? entry->words[0] : "";
  for (const char* known : {".5", ".6", ".7", "0.5", "0.6", "0.7"}) {
    if (version == known) return;
  }
  header.fail(entry->place, "expected version .5, .6 or .7, found " + in_quotes(version));
}

ScalarType scalar_type(const HeaderLines& header, const std::string& type,
                       const std::string& size) {
  const std::uint64_t bytes = header.count(header.at("SIZE"), size);
  const bool is_integer_size = bytes == 1 || bytes == 2 || bytes == 4 || bytes == 8;
  if (type == "F" && (bytes == 4 || bytes == 8)) return {ScalarKind::floating, bytes};
  if (type == "I" && is_integer_size) return {ScalarKind::signed_integer, bytes};
  if (type == "U" && is_integer_size) return {ScalarKind::unsigned_integer, bytes};
  header.fail(header.at("TYPE").place,
              "expected F of 4 or 8 bytes, or I or U of 1, 2, 4 or 8, found " + in_quotes(type) +
                  " of " + size);
}

void check_length(const HeaderLines& header, const std::string& keyword, std::size_t fields) {
  const Entry& entry = header.at(keyword);
  if (entry.words.size() == fields) return;
  header.fail(entry.place, "expected " + keyword + " of " + std::to_string(fields) +
                               " fields, found " + std::to_string(entry.words.size()));
}

void read_fields(const HeaderLines& header, PcdHeader& out) {
  const Entry& names = header.at("FIELDS");
  check_length(header, "SIZE", names.words.size());
  check_length(header, "TYPE", names.words.size());
  const Entry* counts = header.find("COUNT");
  if (counts != nullptr) check_length(header, "COUNT", names.words.size());
  for (std::size_t i = 0; i < names.words.size(); ++i) {
    PcdField field;
    field.name = names.words[i];
    field.type = scalar_type(header, header.at("TYPE").words[i], header.at("SIZE").words[i]);
    if (counts != nullptr) field.count = header.count(*counts, counts->words[i]);
    // Prevents overflow in the sums below.
    if (field.count > std::numeric_limits<std::int32_t>::max()) {
      header.fail(counts->place, "a field cannot have " + counts->words[i] + " numbers");
    }
    field.first_byte = out.point_bytes;
    field.first_word = out.point_words;
    out.point_bytes += field.count * field.type.size;
    out.point_words += field.count;
    out.fields.push_back(field);
  }
}

void find_xyz(const HeaderLines& header, PcdHeader& out) {
  const std::string& place = header.at("FIELDS").place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t found = 0;
    for (const std::string_view spelling : {"xyz", "XYZ"}) {
      const std::string_view name = spelling.substr(axis, 1);
      for (std::size_t i = 0; found < 2 && i < out.fields.size(); ++i) {
        if (out.fields[i].name != name) continue;
        out.xyz[axis] = i;
        ++found;
      }
      if (found > 0) break;
    }
    const std::string name(1, "xyz"[axis]);
    if (found == 0) header.fail(place, "the field " + name + " is missing");
    if (found > 1) header.fail(place, "duplicate field " + name);
    if (out.fields[out.xyz[axis]].count != 1) {
      header.fail(header.at("COUNT").place, "expected one number in the field " + name);
    }
  }
}

/// The words of VIEWPOINT, or empty if it is missing or the identity, 0 0 0 1 0 0 0.
std::string viewpoint(const HeaderLines& header) {
  const Entry* entry = header.find("VIEWPOINT");
  constexpr std::size_t kNumbers = 7, kQuaternionW = 3;
  if (entry == nullptr || entry->words.size() != kNumbers) return "";
  std::string text;
  bool is_identity = true;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    text += (i == 0 ? "" : " ") + entry->words[i];
    if (i != kQuaternionW) is_identity = is_identity && number_from(entry->words[i]) == 0.0;
  }
  return is_identity ? "" : text;
}

std::uint64_t point_count(const HeaderLines& header) {
  const std::optional<std::uint64_t> width = header.number("WIDTH");
  const std::optional<std::uint64_t> height = header.number("HEIGHT");
  const std::optional<std::uint64_t> points = header.number("POINTS");
  if (!width && !points) header.fail("", "the header has no line POINTS and no line WIDTH");
  if (!width) return *points;
  // Some writers set the size of the image to zero.
  if (points && (*width == 0 || height == 0U)) return *points;
  const std::uint64_t rows = height.value_or(1);
  constexpr std::uint64_t kMaxProduct = std::numeric_limits<std::int64_t>::max();
  if (rows != 0 && *width > kMaxProduct / rows)
    header.fail(header.at("WIDTH").place, "is implausibly large");
  if (points && *points != *width * rows) {
    header.fail(header.at("POINTS").place, "expected POINTS to be WIDTH times HEIGHT, " +
                                               std::to_string(*width * rows) + ", found " +
                                               std::to_string(*points));
  }
  return *width * rows;
}

PcdEncoding encoding(const HeaderLines& header) {
  const Entry& entry = header.at("DATA");
  const std::string word = entry.words.size() == 1 ? entry.words[0] : "";
  if (word == "ascii") return PcdEncoding::ascii;
  if (word == "binary") return PcdEncoding::binary;
  if (word == "binary_compressed") return PcdEncoding::binary_compressed;
  header.fail(entry.place,
              "expected DATA ascii, binary or binary_compressed, found " + in_quotes(word));
}

}  // namespace

PcdHeader parse_pcd_header(std::string_view bytes, const std::string& file) {
  const HeaderLines header(bytes, file);
  PcdHeader out;
  check_version(header);
  read_fields(header, out);
  find_xyz(header, out);
  out.points = point_count(header);
  out.encoding = encoding(header);
  out.viewpoint = viewpoint(header);
  out.body_offset = header.body_offset;
  out.lines = header.lines;
  return out;
}

std::vector<std::string> pcd_channel_names(const PcdHeader& header) {
  std::vector<std::string> fields;
  // A field without numbers is treated like padding.
  for (const PcdField& field : header.fields) fields.push_back(field.count > 0 ? field.name : "_");
  for (const std::size_t axis : header.xyz) fields[axis] = "_";
  return channel_names(fields);
}

}  // namespace croon
