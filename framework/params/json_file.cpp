#include "framework/params/json_file.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::params {
namespace {

using nlohmann::json;

/// Follows the parser through the file and notes every key that its object already has.
class DuplicateKeyWatch {
 public:
  DuplicateKeyWatch(std::string file, std::vector<Fault>& faults)
      : file_(std::move(file)), faults_(faults) {}

  bool operator()(int, json::parse_event_t event, json& parsed) {
    switch (event) {
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        next_element();
        // Whoever shows or walks the value calls itself once for each level.
        if (levels_.size() >= kMaxDepth) throw InputError(file_, "", "is nested too deeply");
        levels_.push_back({event == json::parse_event_t::array_start, -1, {}, {}});
        break;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        levels_.pop_back();
        break;
      case json::parse_event_t::key:
        note_key(parsed.get<std::string>());
        break;
      case json::parse_event_t::value:
        next_element();
        break;
    }
    return true;
  }

 private:
  static constexpr std::size_t kMaxDepth = 100;
  struct Level {
    bool is_array;
    int index;
    std::string key;
    std::set<std::string> keys;
  };

  void next_element() {
    if (!levels_.empty() && levels_.back().is_array) ++levels_.back().index;
  }

  void note_key(const std::string& key) {
    Level& level = levels_.back();
    level.key = key;
    if (level.keys.insert(key).second) return;
    json::json_pointer pointer;
    for (const Level& l : levels_) {
      if (l.is_array) {
        pointer.push_back(std::to_string(l.index));
      } else {
        pointer.push_back(l.key);
      }
    }
    faults_.push_back({file_, pointer.to_string(), "the key \"" + key + "\" stands here twice"});
  }

  std::string file_;
  std::vector<Fault>& faults_;
  std::vector<Level> levels_;
};

/// nlohmann's message without its error number in brackets.
std::string without_number(const std::string& message) {
  const std::size_t end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}

}  // namespace

json parse_json(const std::string& text, const std::string& file, std::vector<Fault>& faults) {
  try {
    return json::parse(text, DuplicateKeyWatch(file, faults));
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
  return parse_json(read_whole_file(path), path.string(), faults);
}

json read_json_file(const std::filesystem::path& path) {
  return parse_json(read_whole_file(path), path.string());
}

}  // namespace croon::params
