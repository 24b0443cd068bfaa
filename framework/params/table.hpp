#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/params/parameter.hpp"
#include "framework/params/slot.hpp"
#include "framework/params/values.hpp"

namespace croon::params {

/// One row of a Table: a parameter's documentation, and how to read it into the struct `P` and
/// write it.
template <class P>
struct Parameter {
  ParameterDoc doc;
  std::function<void(P&, const Node&, const StageBuilder&)> read;
  std::function<std::string(const P&)> json;  ///< JSON text of the value.
  bool is_slot = false;                       ///< The default must be built, not copied.

  /// This row, which also reads the key `former` that it replaces, see Node::renamed.
  Parameter formerly(const std::string& former) const {
    Parameter row = *this;
    row.doc.former_key = former;
    return row;
  }
};

/// The parameters of a stage, each declared once: its JSON key, its member in the struct `P`, its
/// bounds and a sentence. The initialisers of `P` are the defaults.
template <class P>
class Table {
 public:
  Table() = default;
  Table(std::initializer_list<Parameter<P>> parameters) : parameters_(parameters) {}

  /// Adds a row.
  Table& add(Parameter<P> row) {
    parameters_.push_back(std::move(row));
    return *this;
  }

  /// Adds all rows of the table of a base of `P`, i.e. parameters that several stages share. `P`
  /// may have other defaults.
  template <class Base>
  Table& inherit(const Table<Base>& base) {
    for (const Parameter<Base>& row : base.rows()) {
      ParameterDoc doc = row.doc;
      if (!row.is_slot) set_default(doc, row.json(P{}));
      parameters_.push_back(
          {doc,
           [read = row.read](P& params, const Node& node, const StageBuilder& builder) {
             read(params, node, builder);
           },
           [json = row.json](const P& params) { return json(params); }, row.is_slot});
    }
    for (const auto& [holds, message] : base.conditions()) {
      conditions_.push_back({[holds = holds](const P& params) { return holds(params); }, message});
    }
    rules_.insert(rules_.end(), base.rules().begin(), base.rules().end());
    finishes_.insert(finishes_.end(), base.finishes().begin(), base.finishes().end());
    return *this;
  }

  const std::vector<Parameter<P>>& rows() const { return parameters_; }
  const std::vector<std::pair<std::function<bool(const P&)>, std::string>>& conditions() const {
    return conditions_;
  }

  /// Adds a condition on several parameters; `message` states the condition and names the keys.
  Table& require(std::function<bool(const P&)> holds, std::string message) {
    conditions_.push_back({std::move(holds), std::move(message)});
    return *this;
  }

  /// Adds a dependency between keys.
  Table& rule(KeyRule rule) {
    rules_.push_back(std::move(rule));
    return *this;
  }
  const std::vector<KeyRule>& rules() const { return rules_; }

  /// Adds a final step of reading that needs the node: it completes the values and may note faults.
  /// Skipped if there were faults before it.
  Table& finish(std::function<void(P&, const Node&)> finish) {
    finishes_.push_back(std::move(finish));
    return *this;
  }
  const std::vector<std::function<void(P&, const Node&)>>& finishes() const { return finishes_; }

  /// Reads the object `written` over the initial values `params` and checks the conditions. The
  /// caller reads `other_keys` ("type", "step"). Notes all faults in the node.
  P read(const Node& written, const std::vector<std::string>& other_keys,
         const StageBuilder& builder, P params = P{}) const;

  /// The same without checking the conditions.
  void read_members(const Node& written, const std::vector<std::string>& other_keys,
                    const StageBuilder& builder, P& params) const;

  /// Whether `params` has a value for every required key.
  bool is_whole(const P& params) const;

  /// Canonical JSON: the members `first`, then each parameter that has a value and that no rule
  /// excludes.
  std::string json(const P& params, Members first = {}) const {
    return object_json(members(params, std::move(first)), rules_);
  }

  std::vector<ParameterDoc> docs() const {
    std::vector<ParameterDoc> docs;
    for (const Parameter<P>& parameter : parameters_) docs.push_back(parameter.doc);
    return docs;
  }

 private:
  /// The members of canonical JSON after `first`, including those that rules exclude.
  Members members(const P& params, Members first = {}) const {
    for (const Parameter<P>& row : parameters_) first.emplace_back(row.doc.key, row.json(params));
    return first;
  }

  /// `node` with the present names of its keys.
  Node renamed(Node node) const {
    for (const Parameter<P>& parameter : parameters_) {
      const ParameterDoc& doc = parameter.doc;
      if (!doc.former_key.empty()) node = node.renamed(doc.former_key, doc.key);
    }
    return node;
  }

  static bool is_missing(const Parameter<P>& parameter, const P& params) {
    return parameter.doc.is_required && parameter.json(params) == parameter.doc.default_json;
  }

  std::vector<Parameter<P>> parameters_;
  std::vector<std::pair<std::function<bool(const P&)>, std::string>> conditions_;
  std::vector<KeyRule> rules_;
  std::vector<std::function<void(P&, const Node&)>> finishes_;
};

template <class P>
P Table<P>::read(const Node& written, const std::vector<std::string>& other_keys,
                 const StageBuilder& builder, P params) const {
  const std::size_t faults_before = written.fault_count();
  const Node node = renamed(written);
  read_members(node, other_keys, builder, params);
  // Conditions on several parameters are meaningless if one of them could not be read.
  if (node.fault_count() > faults_before) return params;
  for (const auto& [holds, message] : conditions_) {
    if (!holds(params)) note_broken_rule(node, message, members(params));
  }
  for (const auto& finish : finishes_) finish(params, node);
  return params;
}

template <class P>
void Table<P>::read_members(const Node& written, const std::vector<std::string>& other_keys,
                            const StageBuilder& builder, P& params) const {
  const Node node = renamed(written);
  std::vector<std::string> known = other_keys;
  for (const Parameter<P>& parameter : parameters_) known.push_back(parameter.doc.key);
  node.refuse_unknown_keys(known);
  for (const Parameter<P>& parameter : parameters_) {
    if (node.has(parameter.doc.key)) {
      parameter.read(params, node.member(parameter.doc.key), builder);
    } else if (parameter.is_slot && !parameter.doc.is_required) {
      read_default(parameter.doc, node, [&](const Node& default_node) {
        parameter.read(params, default_node, builder);
      });
    } else if (is_missing(parameter, params)) {
      node.require(parameter.doc.key);
    }
  }
  check_key_rules(node, rules_);
}

template <class P>
bool Table<P>::is_whole(const P& params) const {
  return std::none_of(parameters_.begin(), parameters_.end(),
                      [&](const Parameter<P>& row) { return is_missing(row, params); });
}

/// A row for the value `of(params)`, a reference to any type that has `read_value` and
/// `value_json`.
template <class P, class Of>
Parameter<P> value_row(const ParameterDoc& doc, const Of& of) {
  const auto read = [doc, of](P& params, const Node& node, const StageBuilder&) {
    read_value(node, doc, of(params));
  };
  return {doc, read, [of](const P& params) { return value_json(of(params)); }, false};
}

/// The same for a member.
template <class P, class T>
Parameter<P> value_parameter(ParameterDoc doc, T P::*member) {
  doc.default_json = value_json(P{}.*member);
  return value_row<P>(
      doc, [member](auto& params) -> auto& { return params.*member; });
}

/// `row` with its key made required, even if it has a default.
template <class P>
Parameter<P> required(Parameter<P> row) {
  row.doc.is_required = true;
  row.doc.is_optional = false;
  return row;
}

/// `row` with its key made optional and without a default: the struct's initial value means "not
/// set" and is not written.
template <class P>
Parameter<P> optional(Parameter<P> row) {
  row.doc.is_required = false;
  row.doc.is_optional = true;
  row.json = [json = row.json, none = row.doc.default_json](const P& params) {
    const std::string text = json(params);
    return text == none ? std::string() : text;
  };
  return row;
}

template <class P>
Parameter<P> boolean(const std::string& key, bool P::*member, const std::string& sentence) {
  return value_parameter<P>({key, ParameterType::boolean, "", {}, {}, "", sentence}, member);
}

template <class P>
Parameter<P> integer(const std::string& key, int P::*member, Range range,
                     const std::string& sentence) {
  return value_parameter<P>({key, ParameterType::integer, "", range, {}, "", sentence}, member);
}

/// A whole number beyond 32 bits; at most 2^53, so that it is exact in every JSON reader.
template <class P>
Parameter<P> integer(const std::string& key, std::uint64_t P::*member,
                     const std::string& sentence) {
  return value_parameter<P>(
      {key, ParameterType::integer, "", {0.0, 9007199254740992.0}, {}, "", sentence}, member);
}

/// Two numbers [low, high] with low <= high.
template <class P>
Parameter<P> interval(const std::string& key, std::array<double, 2> P::*member, Range range,
                      const std::string& sentence) {
  return value_parameter<P>({key, ParameterType::interval, "", range, {}, "", sentence}, member);
}

/// A number, or a list of three numbers, one per axis.
template <class P>
Parameter<P> per_axis(const std::string& key, PerAxis P::*member, Range range,
                      const std::string& sentence) {
  return value_parameter<P>({key, ParameterType::per_axis, "", range, {}, "", sentence}, member);
}

template <class P>
Parameter<P> number(const std::string& key, double P::*member, Range range,
                    const std::string& sentence) {
  return value_parameter<P>({key, ParameterType::number, "", range, {}, "", sentence}, member);
}

/// A non-empty string: a path, a name. The key is required unless the struct has a default.
template <class P>
Parameter<P> text(const std::string& key, std::string P::*member, const std::string& sentence) {
  const bool is_required = (P{}.*member).empty();
  return value_parameter<P>({key, ParameterType::text, "", {}, {}, "", sentence, is_required},
                            member);
}

/// Any string; may be empty.
template <class P>
Parameter<P> free_text(const std::string& key, std::string P::*member,
                       const std::string& sentence) {
  ParameterDoc doc{key, ParameterType::text, "", {}, {}, "", sentence};
  doc.is_optional = true;
  doc.may_be_empty = true;
  return value_parameter<P>(doc, member);
}

/// A name that satisfies `rule`.
template <class P>
Parameter<P> name(const std::string& key, std::string P::*member, const NameRule& rule,
                  const std::string& sentence) {
  Parameter<P> row = text(key, member, sentence);
  row.doc.name_rule = rule;
  // The row captures its document by value, so a changed document needs a new row.
  return value_parameter<P>(row.doc, member);
}

/// A list of strings; may be empty.
template <class P>
Parameter<P> texts(const std::string& key, std::vector<std::string> P::*member,
                   const std::string& sentence) {
  return value_parameter<P>({key, ParameterType::texts, "", {}, {}, "", sentence}, member);
}

/// An optional value of any JSON type, kept with its position in the file for code that reads it
/// later. `definition` names the JSON Schema definition that describes it.
template <class P>
Parameter<P> json_value(const std::string& key, std::optional<Node> P::*member,
                        const std::string& definition, const std::string& sentence) {
  ParameterDoc doc{key, ParameterType::json, "", {}, {}, "", sentence};
  doc.is_optional = true;
  doc.definition = definition;
  return {doc,
          [member](P& params, const Node& node, const StageBuilder&) { params.*member = node; },
          [member](const P& params) { return params.*member ? node_json(*(params.*member)) : ""; },
          false};
}

/// A non-empty list of numbers.
template <class P>
Parameter<P> numbers(const std::string& key, std::vector<double> P::*member, Range range,
                     const std::string& sentence) {
  return value_parameter<P>({key, ParameterType::numbers, "", range, {}, "", sentence}, member);
}

/// One of a few words, kept as a string. For an enumeration see choice.hpp.
template <class P>
Parameter<P> choice(const std::string& key, std::string P::*member,
                    const std::vector<std::string>& choices, const std::string& sentence) {
  return value_parameter<P>({key, ParameterType::choice, "", {}, choices, "", sentence}, member);
}

/// A stage of the kind `Kind`; `default_json` describes the stage that is built if the key is
/// missing.
template <class Kind, class P>
Parameter<P> slot(const std::string& key, Slot<Kind> P::*member, const std::string& default_json,
                  const std::string& sentence) {
  return {{key, ParameterType::stage, default_json, {}, {}, Kind::kKind, sentence},
          [member](P& params, const Node& node, const StageBuilder& builder) {
            params.*member = Slot<Kind>(builder.build(Kind::kKind, node));
          },
          [member](const P& params) { return (params.*member).resolved(); },
          true};
}

/// A stage of the kind `Kind`; the key is required.
template <class Kind, class P>
Parameter<P> required_slot(const std::string& key, Slot<Kind> P::*member,
                           const std::string& sentence) {
  return required(slot<Kind>(key, member, "", sentence));
}

/// A list of stages of the kind `Kind`; `default_json` describes those that are built if the key is
/// missing.
template <class Kind, class P>
Parameter<P> slots(const std::string& key, std::vector<Slot<Kind>> P::*member,
                   const std::string& default_json, const std::string& sentence) {
  return {{key, ParameterType::stages, default_json, {}, {}, Kind::kKind, sentence},
          [member](P& params, const Node& node, const StageBuilder& builder) {
            if (!node.is_array()) return;
            for_each_element(node, [&](const Node& element) {
              (params.*member).push_back(Slot<Kind>(builder.build(Kind::kKind, element)));
            });
          },
          [member](const P& params) {
            return list_json(params.*member,
                             [](const Slot<Kind>& slot) { return slot.resolved(); });
          },
          true};
}

/// The same, empty if the key is missing.
template <class Kind, class P>
Parameter<P> slots(const std::string& key, std::vector<Slot<Kind>> P::*member,
                   const std::string& sentence) {
  return slots<Kind>(key, member, "[]", sentence);
}

}  // namespace croon::params
