#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "framework/params/table.hpp"

namespace croon::params {

/// A named value of a group.
template <class G>
struct Preset {
  std::string name;
  G value;
};

/// The key in a group's object that names the preset to start from.
constexpr const char* kLikeKey = "like";

/// The names of steps and the keys of maps. They appear in tables, where a leading minus sign would
/// begin a formula.
extern const NameRule kKeyName;

/// The keys of the object `node`, in order. Notes a fault if the node is not an object, if it has
/// no keys, and for each key that is not a valid name (kKeyName). `name_words` describes a key: "a
/// sensor's name".
std::vector<std::string> read_names(const Node& node, const std::string& name_words);

/// The JSON text of the object with `members`. Names that are not in alphabetical order are a
/// std::logic_error, because files are read in that order.
std::string map_json(const Members& members);

/// The documentation of a parameter whose objects `table` reads. A stage in `table` is a
/// std::logic_error: presets and defaults are plain values, whereas a stage must be built.
template <class G>
ParameterDoc object_doc(const std::string& key, ParameterType type, const Table<G>& table,
                        const std::string& sentence) {
  for (const Parameter<G>& row : table.rows()) {
    if (row.is_slot) throw std::logic_error(key + "." + row.doc.key + " is a stage in an object");
  }
  ParameterDoc doc{key, type, "", {}, {}, "", sentence};
  doc.members = table.docs();
  doc.rules = table.rules();
  return doc;
}

/// Reads the object `node`, which may start from a preset, into `out`. Notes faults in the node.
template <class G>
void read_object(const Node& node, const Table<G>& table, const std::vector<Preset<G>>& presets,
                 const std::vector<std::string>& names, const StageBuilder& builder, G& out) {
  if (presets.empty()) {
    out = table.read(node, {}, builder);
  } else if (!node.has(kLikeKey)) {
    out = table.read(node, {kLikeKey}, builder);
  } else if (const auto like = read_word(node.member(kLikeKey), names)) {
    out = table.read(node, {kLikeKey}, builder, presets[*like].value);
  } else {
    // Finds the other faults: with any preset no key is missing; its conditions are not checked.
    out = presets.front().value;
    table.read_members(node, {kLikeKey}, builder, out);
  }
}

/// An object that `table` reads, or the name of a preset. In the object, the optional key "like"
/// names the preset to start from; without it the object starts from G{}.
template <class P, class G>
Parameter<P> group(const std::string& key, G P::*member, const Table<G>& table,
                   const std::vector<Preset<G>>& presets, const std::string& sentence) {
  ParameterDoc doc = object_doc(key, ParameterType::group, table, sentence);
  for (const Preset<G>& preset : presets) {
    doc.choices.push_back(preset.name);
    doc.preset_json.push_back(table.json(preset.value));
  }
  doc.is_required = !table.is_whole(P{}.*member);
  set_default(doc, table.json(P{}.*member));
  const auto read = [=, names = doc.choices](P& params, const Node& node,
                                             const StageBuilder& builder) {
    if (node.has_members()) {
      read_object(node, table, presets, names, builder, params.*member);
    } else if (presets.empty()) {
      node.expected("an object");
    } else if (const auto preset = read_word(node, names, " or an object")) {
      params.*member = presets[*preset].value;
    }
  };
  return {doc, read, [=](const P& params) { return table.json(params.*member); }, false};
}

/// An optional object that `table` reads.
template <class P, class G>
Parameter<P> optional_group(const std::string& key, std::optional<G> P::*member,
                            const Table<G>& table, const std::string& sentence) {
  ParameterDoc doc = object_doc(key, ParameterType::group, table, sentence);
  doc.is_optional = true;
  const auto read = [=](P& params, const Node& node, const StageBuilder& builder) {
    if (node.is_object()) params.*member = table.read(node, {}, builder);
  };
  const auto json = [=](const P& params) {
    return params.*member ? table.json(*(params.*member)) : std::string();
  };
  return {doc, read, json, false};
}

/// A list of objects that `table` reads. Elements with faults are kept, so that the indices match
/// the file. Empty if the key is missing.
template <class P, class G>
Parameter<P> list(const std::string& key, std::vector<G> P::*member, const Table<G>& table,
                  const std::string& sentence) {
  ParameterDoc doc = object_doc(key, ParameterType::list, table, sentence);
  doc.default_json = "[]";
  const auto read = [=](P& params, const Node& node, const StageBuilder& builder) {
    if (!node.is_array()) return;
    (params.*member).clear();
    for_each_element(node, [&](const Node& element) {
      (params.*member).push_back(element.is_object() ? table.read(element, {}, builder) : G{});
    });
  };
  const auto json = [=](const P& params) {
    return list_json(params.*member, [&](const G& value) { return table.json(value); });
  };
  return {doc, read, json, false};
}

/// An object whose keys are names that the user chooses and whose values are objects that `table`
/// reads. Never empty: the key is required unless the struct has a default. Sorted by name.
template <class P, class G>
Parameter<P> map(const std::string& key, std::vector<std::pair<std::string, G>> P::*member,
                 const Table<G>& table, const std::string& name_words,
                 const std::string& sentence) {
  const auto read = [=](P& params, const Node& node, const StageBuilder& builder) {
    std::vector<std::pair<std::string, G>> values;
    for (const std::string& name : read_names(node, name_words)) {
      const Node value = node.member(name);
      if (value.is_object()) values.emplace_back(name, table.read(value, {}, builder));
    }
    params.*member = std::move(values);
  };
  const auto json = [=](const P& params) {
    Members members;
    for (const auto& [name, value] : params.*member) members.emplace_back(name, table.json(value));
    return map_json(members);
  };
  ParameterDoc doc = object_doc(key, ParameterType::map, table, sentence);
  doc.name_words = name_words;
  doc.is_required = (P{}.*member).empty();
  doc.default_json = json(P{});
  return {doc, read, json, false};
}

}  // namespace croon::params
