#include "framework/stage/scene_kinds_file.hpp"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "framework/params/json_file.hpp"
#include "framework/params/node.hpp"

namespace croon {
namespace {

bool is_word(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '_' || c == '-');
  });
}

void read_kind(const params::Node& node, std::string& kind) {
  if (!node.value().is_string() || !is_word(node.value().get<std::string>())) {
    node.expected("a word of letters, digits, \"_\" and \"-\"");
    return;
  }
  kind = node.value().get<std::string>();
}

}  // namespace

SceneKinds read_scene_kinds(const std::filesystem::path& file) {
  std::vector<Fault> faults;
  const nlohmann::json value = params::read_json_file(file, faults);
  const params::Node root(value, file.string(), faults);
  SceneKinds kinds;
  if (root.is_object()) {
    for (const auto& [scene, kind] : value.items()) read_kind(root.member(scene), kinds[scene]);
  }
  if (!faults.empty()) throw InputError(faults);
  return kinds;
}

}  // namespace croon
