#include "registry/schema.hpp"

#include <nlohmann/json.hpp>

#include "registry/schema_parts.hpp"

namespace croon {
namespace {

using nlohmann::ordered_json;

/// Any stage of `kind`. The enumeration of names is what an editor offers before the name is
/// written.
ordered_json kind_schema(const Catalogue& catalogue, const std::string& kind) {
  const std::vector<std::string> names = catalogue.names(kind);
  if (names.empty()) return {{"not", ordered_json::object()}};
  ordered_json one_of = ordered_json::array();
  for (const std::string& name : names) one_of.push_back(definition(kind + "." + name));
  return {{"type", "object"},
          {"properties", {{name_key(kind), {{"enum", names}}}}},
          {"required", ordered_json::array({name_key(kind)})},
          {"oneOf", one_of}};
}

ordered_json definitions(const Catalogue& catalogue) {
  ordered_json all;
  for (const std::string& kind : stage_kinds()) all[kind] = kind_schema(catalogue, kind);
  for (const StageEntry& entry : catalogue.entries()) {
    all[entry.kind + "." + entry.name] = stage_schema(entry);
  }
  return all;
}

}  // namespace

std::string experiment_schema(const Catalogue& catalogue) {
  ordered_json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                         {"title", "An experiment of croon"},
                         {"type", "object"},
                         {"properties", experiment_properties(catalogue)},
                         {"required", {"name", "dataset", "pipeline"}},
                         {"additionalProperties", false},
                         {"$defs", definitions(catalogue)}};
  return schema.dump(2) + "\n";
}

}  // namespace croon
