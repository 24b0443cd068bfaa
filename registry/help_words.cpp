#include "registry/help_parts.hpp"

#include <set>
#include <stdexcept>

#include "framework/params/group.hpp"
#include "framework/params/values.hpp"

namespace croon {
namespace {

using params::ParameterDoc;
using params::ParameterType;
using Mark = std::function<std::string(const std::string&)>;

std::string marked_list(const std::vector<std::string>& words, const Mark& mark) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + mark(word);
  return text;
}

std::string with_article(const std::string& kind, const std::string& marked) {
  const bool has_vowel = std::string("aeiou").find(kind.front()) != std::string::npos;
  return (has_vowel ? "an " : "a ") + marked + " stage";
}

std::string group_words(const ParameterDoc& doc, const Mark& mark) {
  if (doc.choices.empty()) return "an object";
  return "one of " + marked_list(doc.choices, mark) + ", or an object, which may start from one (" +
         mark(params::kLikeKey) + ")";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> flow_lines(const params::DataFlow& flow,
                                                            const Mark& mark) {
  std::vector<std::pair<std::string, std::string>> lines;
  std::set<std::string> channels = flow.target_channels;
  channels.insert(flow.source_channels.begin(), flow.source_channels.end());
  for (const std::string& channel : channels) {
    lines.emplace_back("Needs", "the channel " + mark(channel));
  }
  const auto add = [&](const char* verb, const std::vector<params::ExtraDoc>& extras) {
    for (const params::ExtraDoc& extra : extras) {
      lines.emplace_back(verb, "the extra " + mark(extra.name) + ", " + extra.meaning);
    }
  };
  for (const std::string& channel : flow.optional_channels) {
    lines.emplace_back("Reads", "the channel " + mark(channel) + " of clouds that have it");
  }
  add("Needs", flow.takes);
  add("Provides", flow.gives);
  return lines;
}

std::string kind_phrase(const std::string& kind) { return with_article(kind, kind); }

std::vector<PlacedParameter> placed_parameters(const std::vector<ParameterDoc>& parameters,
                                               const std::string& above) {
  std::vector<PlacedParameter> placed;
  for (const ParameterDoc& parameter : parameters) {
    const std::string path = above + parameter.key;
    placed.push_back({path, &parameter});
    const bool is_map = parameter.type == ParameterType::map;
    const auto below = placed_parameters(parameter.members, path + (is_map ? ".<name>." : "."));
    placed.insert(placed.end(), below.begin(), below.end());
  }
  return placed;
}

std::string type_words(const ParameterDoc& doc, const Mark& mark) {
  switch (doc.type) {
    case ParameterType::boolean:
      return mark("true") + " or " + mark("false");
    case ParameterType::integer:
      return params::range_words("a whole number", doc.range);
    case ParameterType::number:
      return params::range_words("a number", doc.range);
    case ParameterType::text:
      return "a string";
    case ParameterType::choice:
      return "one of " + marked_list(doc.choices, mark);
    case ParameterType::numbers:
      return "a list, each " + params::range_words("a number", doc.range);
    case ParameterType::choices:
      return "a list of distinct words out of " + marked_list(doc.choices, mark);
    case ParameterType::stage:
      return with_article(doc.stage_kind, mark(doc.stage_kind));
    case ParameterType::stages:
      return "a list, each " + with_article(doc.stage_kind, mark(doc.stage_kind));
    case ParameterType::group:
      return group_words(doc, mark);
    case ParameterType::interval:
      return "[low, high], each " + params::range_words("a number", doc.range);
    case ParameterType::per_axis:
      return params::range_words("a number", doc.range) + ", or a list of three";
    case ParameterType::texts:
      return "a list of strings";
    case ParameterType::list:
      return "a list of objects";
    case ParameterType::json:
      return "a JSON value";
    case ParameterType::map:
      return "an object with " + doc.name_words + " for each key";
  }
  throw std::logic_error("a parameter type without words");
}

std::string default_words(const ParameterDoc& doc) {
  if (doc.is_optional) return "none";
  return doc.is_required ? "required" : doc.default_json;
}

}  // namespace croon
