#include "framework/params/values.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace croon::params {
namespace {

using nlohmann::json;

bool is_alphanumeric(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

bool holds(const std::string& characters, char c) {
  return characters.find(c) != std::string::npos;
}

bool in_range(double value, const Range& range) {
  return value >= range.minimum && value <= range.maximum;
}

void read_text(const Node& node, const ParameterDoc& doc, std::string& out) {
  std::string text;
  if (!node.read(text)) return;
  if (doc.name_rule && !doc.name_rule->allows(text)) return node.expected(doc.name_rule->words);
  if (text.empty() && !doc.may_be_empty) return node.expected("a string that is not empty");
  out = text;
}

/// Whether `word` occurs in `text` as a whole word.
bool has_word(const std::string& text, const std::string& word) {
  const auto ends_at = [&](std::size_t i) {
    return i >= text.size() || (!is_alphanumeric(text[i]) && text[i] != '_');
  };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    if ((at == 0 || ends_at(at - 1)) && ends_at(at + word.size())) return true;
  }
  return false;
}

/// Whether the rule applies to the object `node`.
bool applies(const KeyRule& rule, const Node& node) {
  const json* value = node.find(rule.key);
  if (rule.words.empty()) return (value != nullptr) != rule.is_negated;
  if (value == nullptr || !value->is_string()) return false;
  const auto found = std::find(rule.words.begin(), rule.words.end(), value->get<std::string>());
  return (found != rule.words.end()) != rule.is_negated;
}

/// `"a" and "b"`.
std::string in_words(const std::vector<std::string>& keys) {
  std::string text;
  for (const std::string& key : keys) text += (text.empty() ? "\"" : " and \"") + key + "\"";
  return text;
}

}  // namespace

bool NameRule::allows(const std::string& name) const {
  return !name.empty() && !holds(not_first, name.front()) && !holds(not_last, name.back()) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return is_alphanumeric(c) || holds(marks, c); });
}

std::string NameRule::pattern() const {
  const auto one_of = [&](const std::string& without) {
    std::string others;
    for (const char c : marks) {
      // A minus sign denotes a range unless it is the last character.
      if (c != '-' && !holds(without, c)) others += c;
    }
    return "[A-Za-z0-9" + others + (holds(marks, '-') && !holds(without, '-') ? "-]" : "]");
  };
  if (not_first.empty() && not_last.empty()) return "^" + one_of("") + "+$";
  return "^" + one_of(not_first + not_last) + "(" + one_of("") + "*" + one_of(not_last) + ")?$";
}

std::string range_words(const std::string& what, const Range& range) {
  const bool has_minimum = std::isfinite(range.minimum);
  const bool has_maximum = std::isfinite(range.maximum);
  if (has_minimum && has_maximum) {
    return what + " from " + value_json(range.minimum) + " to " + value_json(range.maximum);
  }
  if (has_minimum) return what + " of at least " + value_json(range.minimum);
  if (has_maximum) return what + " of at most " + value_json(range.maximum);
  return what;
}

void read_value(const Node& node, const ParameterDoc&, bool& out) { node.read(out); }

void read_value(const Node& node, const ParameterDoc& doc, int& out) {
  const json& value = node.value();
  const double number = value.is_number() ? value.get<double>() : 0.5;
  // Checked here, because the number may also exceed an int.
  if (std::floor(number) == number && !in_range(number, doc.range)) {
    return node.expected(range_words("a whole number", doc.range));
  }
  int whole = 0;
  if (node.read(whole)) out = whole;
}

void read_value(const Node& node, const ParameterDoc& doc, double& out) {
  double value = 0.0;
  if (!node.read(value)) return;
  if (in_range(value, doc.range)) {
    out = value;
  } else {
    node.expected(range_words("a number", doc.range));
  }
}

void read_value(const Node& node, const ParameterDoc& doc, std::uint64_t& out) {
  const json& value = node.value();
  // Accepts 1e3 too; the range ends where a double can no longer represent every whole number.
  const double number = value.is_number() ? value.get<double>() : 0.5;
  if (std::floor(number) == number && number >= 0.0 && in_range(number, doc.range)) {
    out = value.is_number_unsigned() ? value.get<std::uint64_t>()
                                     : static_cast<std::uint64_t>(number);
  } else {
    node.expected(range_words("a whole number", doc.range));
  }
}

void read_value(const Node& node, const ParameterDoc& doc, std::array<double, 2>& out) {
  std::vector<double> ends;
  if (!node.is_array()) return;
  const std::size_t faults_before = node.fault_count();
  for_each_element(node, [&](const Node& element) {
    ends.push_back(0.0);
    read_value(element, doc, ends.back());
  });
  if (node.fault_count() > faults_before) return;
  if (ends.size() != 2 || ends[0] > ends[1]) {
    return node.expected("[low, high] with low at most high");
  }
  out = {ends[0], ends[1]};
}

void read_value(const Node& node, const ParameterDoc& doc, PerAxis& out) {
  if (!node.value().is_array()) {
    double all = out[0];
    read_value(node, doc, all);
    out = all;
    return;
  }
  if (node.value().size() != out.values.size()) {
    return node.expected("a number or a list of three, one for each axis");
  }
  for (std::size_t axis = 0; axis < out.values.size(); ++axis) {
    read_value(node.element(axis), doc, out.values[axis]);
  }
}

void read_value(const Node& node, const ParameterDoc& doc, std::string& out) {
  if (doc.type == ParameterType::text) {
    read_text(node, doc, out);
  } else if (const auto index = read_word(node, doc.choices)) {
    out = doc.choices[*index];
  }
}

void read_value(const Node& node, const ParameterDoc& doc, std::vector<double>& out) {
  if (!node.is_array()) return;
  if (node.value().empty()) return node.expected("a list of at least one number");
  std::vector<double> values;
  for_each_element(node, [&](const Node& element) {
    double value = out.empty() ? 0.0 : out.front();
    read_value(element, doc, value);
    values.push_back(value);
  });
  out = values;
}

void read_value(const Node& node, const ParameterDoc&, std::vector<std::string>& out) {
  if (!node.is_array()) return;
  out.assign(node.value().size(), "");
  for (std::size_t i = 0; i < out.size(); ++i) node.element(i).read(out[i]);
}

std::optional<std::size_t> read_word(const Node& node, const std::vector<std::string>& words,
                                     const std::string& or_else) {
  std::string expected = "one of ";
  for (const std::string& word : words) expected += (&word == &words[0] ? "" : ", ") + word;
  expected += or_else;
  if (!node.value().is_string()) {
    node.expected(expected);
    return std::nullopt;
  }
  const std::string word = node.value().get<std::string>();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return found - words.begin();
  const std::string near = nearest_name(word, words);
  node.fault("expected " + expected + ", found \"" + word + "\"" +
             (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
  return std::nullopt;
}

std::vector<std::size_t> read_words(const Node& node, const std::vector<std::string>& words) {
  std::vector<std::size_t> indices;
  if (!node.is_array()) return indices;
  if (node.value().empty()) node.expected("a list of at least one word");
  for_each_element(node, [&](const Node& element) {
    const std::optional<std::size_t> index = read_word(element, words);
    if (!index) return;
    if (std::find(indices.begin(), indices.end(), *index) != indices.end()) {
      element.fault("duplicate \"" + words[*index] + "\" in this list");
    } else {
      indices.push_back(*index);
    }
  });
  return indices;
}

std::string value_json(bool value) { return value ? "true" : "false"; }
std::string value_json(int value) { return std::to_string(value); }
std::string value_json(std::uint64_t value) { return std::to_string(value); }
std::string value_json(const PerAxis& axes) {
  if (axes == PerAxis(axes[0])) return value_json(axes[0]);
  return value_json(std::vector<double>(axes.values.begin(), axes.values.end()));
}
std::string value_json(const std::array<double, 2>& ends) {
  return value_json(std::vector<double>(ends.begin(), ends.end()));
}
std::string value_json(double value) {
  // A whole number is written without decimals: "10", not "10.0".
  constexpr double kMaxExactInteger = 9007199254740992.0;  // 2^53
  const bool is_whole = std::floor(value) == value && std::abs(value) <= kMaxExactInteger;
  return is_whole ? std::to_string(static_cast<long long>(value)) : json(value).dump();
}
std::string value_json(const std::string& value) { return json(value).dump(); }
std::string value_json(const std::vector<double>& values) {
  return list_json(values, [](double value) { return value_json(value); });
}
std::string value_json(const std::vector<std::string>& words) { return json(words).dump(); }

std::string node_json(const Node& node) { return node.value().dump(); }

std::string object_json(const Members& members, const std::vector<KeyRule>& rules) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& [key, text] : members) {
    if (!text.empty()) object[key] = nlohmann::ordered_json::parse(text);
  }
  const json before = object;
  std::vector<Fault> none;
  for (const KeyRule& rule : rules) {
    if (!rule.one_of.empty() || !applies(rule, Node(before, "", none))) continue;
    for (const std::string& key : rule.excluded) object.erase(key);
  }
  return object.dump();
}

void check_key_rules(const Node& node, const std::vector<KeyRule>& rules) {
  for (const KeyRule& rule : rules) {
    if (!rule.one_of.empty()) {
      const auto count = std::count_if(rule.one_of.begin(), rule.one_of.end(),
                                       [&](const std::string& key) { return node.has(key); });
      if (count != 1) node.expected("one of " + in_words(rule.one_of));
      continue;
    }
    if (!applies(rule, node)) continue;
    const std::vector<std::string> because = {node.pointer_to(rule.key)};
    for (const std::string& key : rule.required) node.require(key, because);
    for (const std::string& key : rule.excluded) {
      if (!node.has(key)) continue;
      node.member(key).fault("expected " + rule.expected + ", found \"" + key + "\"", because);
    }
  }
}

void note_broken_rule(const Node& node, const std::string& message, const Members& members) {
  constexpr std::size_t kMaxValueColumns = 60;
  std::vector<std::string> parts;
  Members named;
  for (const auto& [key, text] : members) {
    if (text.empty() || !has_word(message, key)) continue;
    parts.push_back(node.pointer_to(key));
    named.emplace_back(key, cut_in_the_middle(text, kMaxValueColumns));
  }
  std::string found;
  for (const auto& [key, text] : named) {
    found += (found.empty() ? ", found " : " and ") + (named.size() > 1 ? key + " " : "") + text;
  }
  node.fault(message + found, parts);
}

void set_default(ParameterDoc& doc, const std::string& value) {
  const auto preset = std::find(doc.preset_json.begin(), doc.preset_json.end(), value);
  const bool is_preset = preset != doc.preset_json.end();
  doc.default_json = is_preset ? value_json(doc.choices[preset - doc.preset_json.begin()]) : value;
}

void read_default(const ParameterDoc& doc, const Node& node,
                  const std::function<void(const Node&)>& use) {
  const json value = json::parse(doc.default_json);
  std::vector<Fault> faults;
  use(Node(value, node.file(), faults));
  for (const Fault& fault : faults) {
    node.fault("the default of \"" + doc.key + "\": " + fault.message);
  }
}

void for_each_element(const Node& node, const std::function<void(const Node&)>& use) {
  for (std::size_t i = 0; i < node.value().size(); ++i) use(node.element(i));
}

}  // namespace croon::params
