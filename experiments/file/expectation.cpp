#include "experiments/file/expectation.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/base/error.hpp"
#include "framework/base/nearest_name.hpp"

namespace croon::experiments {
namespace {

using params::Node;

/// Claims hold no stages.
class NoStages : public params::StageBuilder {
 public:
  params::BuiltStage build(const std::string&, const Node&) const override {
    throw std::logic_error("a claim with a stage in it");
  }
};

/// The objects of the list `key`; none where it is missing.
template <class P>
std::vector<P> read_list(const Node& root, const std::string& key, const params::Table<P>& table,
                         void (*check)(const Node&, const P&)) {
  std::vector<P> list;
  if (!root.has(key) || !root.member(key).is_array()) return list;
  params::for_each_element(root.member(key), [&](const Node& element) {
    if (!element.is_object()) return;
    list.push_back(table.read(element, {}, NoStages()));
    check(element, list.back());
  });
  return list;
}

/// What the keys of an expectation must be together.
void check_expectation(const Node& node, const Expectation& expectation) {
  if (!expectation.statistic.empty()) {
    const bool wants_measure = !is_share(expectation.statistic);
    if (wants_measure) node.require("measure");
    if (!wants_measure && node.has("measure")) {
      node.member("measure").fault("the statistic \"" + expectation.statistic +
                                   "\" is a share and has no measure");
    }
  }
  if (expectation.band.empty()) return;
  if (expectation.band.size() != 2 || expectation.band[0] > expectation.band[1]) {
    node.member("band").expected("[low, high] with low at most high");
  }
}

void check_variant(const Node& node, const std::vector<std::string>& variants,
                   Expectation& expectation) {
  if (variants.empty()) return;
  if (expectation.variant.empty()) {
    expectation.variant = variants.front();
  } else if (std::find(variants.begin(), variants.end(), expectation.variant) == variants.end()) {
    node.member("variant").fault("there is no variant \"" + expectation.variant + "\"" +
                                 name_hint(expectation.variant, variants));
  }
}

/// The members that are known, `{"claim":...}`: what is empty may be left out.
template <class P>
std::string object_json(const params::Table<P>& table, const P& params) {
  std::string text;
  for (const params::Parameter<P>& parameter : table.rows()) {
    const std::string value = parameter.json(params);
    if (value == "\"\"") continue;
    text += (text.empty() ? "\"" : ",\"") + parameter.doc.key + "\":" + value;
  }
  return "{" + text + "}";
}

template <class P>
std::string list_json(const params::Table<P>& table, const std::vector<P>& list) {
  std::string text;
  for (const P& element : list) text += (text.empty() ? "" : ",") + object_json(table, element);
  return "[" + text + "]";
}

}  // namespace

Claims read_claims(const Node& root, const std::vector<std::string>& variants) {
  Claims claims;
  claims.expect = read_list(root, "expect", expectation_table(), check_expectation);
  claims.quoted =
      read_list<Quoted>(root, "quoted", quoted_table(), [](const Node&, const auto&) {});
  for (std::size_t i = 0; i < claims.expect.size(); ++i) {
    check_variant(root.member("expect").element(i), variants, claims.expect[i]);
  }
  return claims;
}

std::string claims_json(const Claims& claims) {
  return "{\"expect\":" + list_json(expectation_table(), claims.expect) +
         ",\"quoted\":" + list_json(quoted_table(), claims.quoted) + "}";
}

Claims claims_of(const std::string& text, const std::string& file) {
  std::vector<Fault> faults;
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  const Node root(json, file, faults);
  Claims claims;
  if (root.is_object()) claims = read_claims(root, {});
  if (!faults.empty()) throw InputError(faults);
  return claims;
}

}  // namespace croon::experiments
