#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace croon {

/// The kind of each scene by the scene's name.
using SceneKinds = std::map<std::string, std::string>;

/// Reads `{"000012": "urban"}`; a kind is a word of letters, digits, `_` and `-`. Throws InputError
/// with every fault.
SceneKinds read_scene_kinds(const std::filesystem::path& file);

}  // namespace croon
