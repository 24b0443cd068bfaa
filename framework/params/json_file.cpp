#include "framework/params/json_file.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::params {
namespace {

using nlohmann::json;

/// Parses a text and notes every duplicate key of an object. Stops at invalid JSON. A callback of
/// json::parse would see the same keys, but it makes the parser quadratic in the length of a list.
class DuplicateKeyWatch final : public nlohmann::json_sax<json> {
 public:
  DuplicateKeyWatch(std::string file, std::vector<Fault>& faults)
      : file_(std::move(file)), faults_(faults) {}

  bool null() override { return next_element(); }
  bool boolean(bool) override { return next_element(); }
  bool number_integer(number_integer_t) override { return next_element(); }
  bool number_unsigned(number_unsigned_t) override { return next_element(); }
  bool number_float(number_float_t, const string_t&) override { return next_element(); }
  bool string(string_t&) override { return next_element(); }
  bool binary(binary_t&) override { return next_element(); }
  bool start_object(std::size_t) override { return enter(false); }
  bool start_array(std::size_t) override { return enter(true); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool key(string_t& key) override {
    note_key(key);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override {
    return false;
  }

 private:
  static constexpr std::size_t kMaxDepth = 100;
  struct Level {
    bool is_array;
    int index;
    std::string key;
    std::set<std::string> keys;
  };

  bool next_element() {
    if (!levels_.empty() && levels_.back().is_array) ++levels_.back().index;
    return true;
  }

  bool enter(bool is_array) {
    next_element();
    // Code that walks the value recurses once per level.
    if (levels_.size() >= kMaxDepth) {
      throw InputError(file_, pointer(),
                       "expected at most " + std::to_string(kMaxDepth) +
                           " levels of lists and objects, found more");
    }
    levels_.push_back({is_array, -1, {}, {}});
    return true;
  }

  bool leave() {
    levels_.pop_back();
    return true;
  }

  void note_key(const std::string& key) {
    Level& level = levels_.back();
    level.key = key;
    if (level.keys.insert(key).second) return;
    faults_.push_back({file_, pointer(), "duplicate key \"" + key + "\""});
  }

  /// Of the value that is being parsed.
  std::string pointer() const {
    json::json_pointer pointer;
    for (const Level& level : levels_) {
      pointer.push_back(level.is_array ? std::to_string(level.index) : level.key);
    }
    return pointer.to_string();
  }

  std::string file_;
  std::vector<Fault>& faults_;
  std::vector<Level> levels_;
};

/// The position of the byte `at`, e.g. "line 3, column 7".
std::string place_of(const std::string& text, std::size_t at) {
  const auto begin = text.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(std::min(at, text.size()));
  const std::size_t newline = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return "line " + std::to_string(std::count(begin, end, '\n') + 1) + ", column " +
         std::to_string(newline == std::string::npos ? at + 1 : at - newline);
}

/// The position of the number quoted in `message`, e.g. "number overflow parsing '1e999'".
std::string place_of_number(const std::string& text, const std::string& message) {
  const std::size_t quote = message.find('\'');
  if (quote == std::string::npos) return "";
  const std::string number = message.substr(quote + 1, message.rfind('\'') - quote - 1);
  const std::size_t at = text.find(number);
  return at == std::string::npos ? "" : place_of(text, at);
}

/// nlohmann's message without its error number in brackets.
std::string without_number(const std::string& message) {
  const std::size_t end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}

/// Throws InputError if `bytes` exceeds the size of any JSON file that croon reads.
void refuse_large(std::uintmax_t bytes, const std::string& file) {
  // A value needs up to ninety times the bytes of its text. Realistic files for croon, with 10,000
  // variants or claims, have a few megabytes.
  constexpr std::uintmax_t kMaxJsonBytes = 10'000'000;
  if (bytes <= kMaxJsonBytes) return;
  throw InputError(file, "",
                   "expected JSON of at most " + std::to_string(kMaxJsonBytes) + " bytes, found " +
                       std::to_string(bytes));
}

}  // namespace

std::string read_json_text(const std::filesystem::path& path) {
  std::error_code none;
  const std::uintmax_t bytes = std::filesystem::file_size(path, none);
  // A file without a size is refused, with the reason, when it is read.
  if (!none) refuse_large(bytes, path.string());
  return read_whole_file(path);
}

json parse_json(const std::string& text, const std::string& file, std::vector<Fault>& faults) {
  refuse_large(text.size(), file);
  // The parser treats a null byte as the end of the text.
  const std::size_t null_byte = text.find('\0');
  if (null_byte != std::string::npos) {
    throw InputError(file, place_of(text, null_byte), "expected JSON, found a null byte");
  }
  try {
    DuplicateKeyWatch watch(file, faults);
    json::sax_parse(text, &watch);
    return json::parse(text);
  } catch (const json::out_of_range& error) {
    throw InputError(
        file, place_of_number(text, error.what()),
        "expected a number of at most 1.8e308, found: " + without_number(error.what()));
  } catch (const json::exception& error) {
    throw InputError(file, "", "expected JSON, found: " + without_number(error.what()));
  }
}

json parse_json(const std::string& text, const std::string& file) {
  std::vector<Fault> faults;
  json value = parse_json(text, file, faults);
  if (!faults.empty()) throw InputError(std::move(faults));
  return value;
}

json read_json_file(const std::filesystem::path& path, std::vector<Fault>& faults) {
  return parse_json(read_json_text(path), path.string(), faults);
}

json read_json_file(const std::filesystem::path& path) {
  return parse_json(read_json_text(path), path.string());
}

}  // namespace croon::params
