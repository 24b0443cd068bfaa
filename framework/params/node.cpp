#include "framework/params/node.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/base/error.hpp"

namespace croon::params {
namespace {

/// Escapes `~` and `/` in a key (RFC 6901).
std::string escaped(const std::string& key) {
  std::string text;
  for (const char c : key) {
    if (c == '~') {
      text += "~0";
    } else if (c == '/') {
      text += "~1";
    } else {
      text += c;
    }
  }
  return text;
}

/// The value as the user wrote it, cut if it is long.
std::string shown(const nlohmann::json& value) {
  constexpr std::size_t kMaxShownBytes = 60;
  const std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (text.size() <= kMaxShownBytes) return text;
  // Never cut inside a UTF-8 character.
  std::size_t end = kMaxShownBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "...";
}

}  // namespace

Node::Node(const nlohmann::json& value, std::string file, std::vector<Fault>& faults)
    : value_(&value), file_(std::move(file)), faults_(&faults) {}

Node::Node(const nlohmann::json& value, std::string file, std::vector<Fault>& faults,
           MemberOrigins origins)
    : Node(value, std::move(file), faults) {
  origins_ = std::make_shared<const MemberOrigins>(std::move(origins));
}

Node Node::member(const std::string& key) const {
  Node node = *this;
  node.value_ = &value_->at(key);
  if (origins_ && origins_->count(key) > 0) node.file_ = origins_->at(key).file;
  node.pointer_ = pointer_to(key);
  node.origins_ = nullptr;
  return node;
}

Node Node::element(std::size_t index) const {
  Node node = *this;
  node.value_ = &value_->at(index);
  node.pointer_ += "/" + std::to_string(index);
  return node;
}

const nlohmann::json* Node::find(const std::string& path) const {
  const nlohmann::json* at = value_;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string key = path.substr(begin, end - begin);
    if (!at->is_object() || !at->contains(key)) return nullptr;
    at = &at->at(key);
    begin = end + 1;
  }
  return at;
}

bool Node::has(const std::string& key) const { return has_members() && value_->contains(key); }

bool Node::has_members() const { return value_->is_object(); }

Node Node::noting(std::vector<Fault>& notes) const {
  Node node = *this;
  node.notes_ = &notes;
  return node;
}

Node Node::renamed(const std::string& former, const std::string& key) const {
  if (!has(former)) return *this;
  const Node written = member(former);
  nlohmann::json changed = *value_;
  MemberOrigins origins = origins_ ? *origins_ : MemberOrigins();
  if (has(key)) {
    written.fault("expected \"" + key + "\" without its former name, found both");
  } else {
    if (notes_ != nullptr) {
      add_note(*notes_, {written.file_, written.pointer_,
                         "the key \"" + former + "\" is now called \"" + key + "\""});
    }
    changed[key] = *written.value_;
    origins[key] = {written.file_, former};
  }
  changed.erase(former);
  Node node = *this;
  node.renamed_ = std::make_shared<const nlohmann::json>(std::move(changed));
  node.value_ = node.renamed_.get();
  node.origins_ = std::make_shared<const MemberOrigins>(std::move(origins));
  return node;
}

std::string Node::pointer_to(const std::string& key) const {
  const bool has_origin = origins_ && origins_->count(key) > 0;
  return pointer_ + "/" + escaped(has_origin ? origins_->at(key).key : key);
}

void Node::fault(const std::string& message, std::vector<std::string> parts) const {
  faults_->push_back({file_, pointer_.empty() ? "/" : pointer_, message, std::move(parts)});
}

void Node::expected(const std::string& what) const {
  fault("expected " + what + ", found " + shown(*value_));
}

bool Node::is_object() const {
  if (has_members()) return true;
  expected("an object");
  return false;
}

bool Node::is_array() const {
  if (value_->is_array()) return true;
  expected("a list");
  return false;
}

void Node::refuse_unknown_keys(const std::vector<std::string>& known) const {
  for (const auto& [key, value] : value_->items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    member(key).fault("unknown key \"" + key + "\"" + name_hint(key, known));
  }
}

bool Node::require(const std::string& key, std::vector<std::string> parts) const {
  if (has(key)) return true;
  fault("the key \"" + key + "\" is missing", std::move(parts));
  return false;
}

bool Node::read(bool& out) const {
  if (!value_->is_boolean()) {
    expected("true or false");
    return false;
  }
  out = value_->get<bool>();
  return true;
}

bool Node::read(double& out) const {
  if (!value_->is_number() || !std::isfinite(value_->get<double>())) {
    expected("a number");
    return false;
  }
  out = value_->get<double>();
  return true;
}

bool Node::read(int& out) const {
  const double number = value_->is_number() ? value_->get<double>() : 0.5;
  if (std::floor(number) != number || std::abs(number) > std::numeric_limits<int>::max()) {
    expected("a whole number");
    return false;
  }
  out = static_cast<int>(number);
  return true;
}

bool Node::read(std::string& out) const {
  if (!value_->is_string()) {
    expected("a string");
    return false;
  }
  out = value_->get<std::string>();
  return true;
}

}  // namespace croon::params
