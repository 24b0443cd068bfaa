#include "experiments/store/build.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <future>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "experiments/store/bounded_json.hpp"
#include "framework/base/text.hpp"
#include "framework/base/version.hpp"
#include "framework/io/digest.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFramework = "framework";
constexpr unsigned kMaxVersion = std::numeric_limits<int>::max();

auto key_of(const Build& build) {
  return std::tie(build.version, build.commit, build.program_sha256);
}

/// The content of "croon" in a manifest.
Json program_json(const Build& build) {
  Json json = {{"version", build.version},
               {"commit", build.commit},
               {"program_sha256", build.program_sha256}};
  for (const StageFolder& folder : build.stage_folders) {
    json["stage_folders"].push_back({{"folder", folder.folder}, {"commit", folder.commit}});
  }
  return json;
}

Json libraries_json(const Build& build) {
  Json json = Json::object();
  for (const auto& [library, version] : build.libraries) json[library] = version;
  return json;
}

Json build_json(const Build& build) {
  Json json = program_json(build);
  json["libraries"] = libraries_json(build);
  return json;
}

/// A text of a build made safe for reports, because the store may come from anywhere.
std::string shown(const Json& text) { return printable(text.get<std::string>()); }

Build read_build(const Json& program, const Json& libraries) {
  Build build{shown(program.at("version")),
              shown(program.at("commit")),
              shown(program.at("program_sha256")),
              {},
              {}};
  if (program.contains("stage_folders")) {
    for (const Json& folder : program.at("stage_folders")) {
      build.stage_folders.push_back({shown(folder.at("folder")), shown(folder.at("commit"))});
    }
  }
  for (const auto& [library, version] : libraries.items()) {
    build.libraries.emplace_back(printable(library), shown(version));
  }
  return build;
}

Json list_json(const std::vector<Build>& builds) {
  Json list = Json::array();
  for (const Build& build : builds) list.push_back(build_json(build));
  return list;
}

/// Bytes of paths that are not UTF-8 are replaced.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The file that contains this code: the program, or the module of another program.
std::string loaded_file() {
  const std::string program = "/proc/self/exe";
  const auto address = reinterpret_cast<std::uintptr_t>(&loaded_file);
  std::error_code error;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    std::istringstream(line) >> std::hex >> begin >> dash >> end;
    const std::size_t path = line.find('/');
    if (address < begin || address >= end || path == std::string::npos) continue;
    const std::string file = line.substr(path);
    return std::filesystem::equivalent(file, program, error) || error ? program : file;
  }
  return program;
}

const std::shared_future<std::string>& program_digest() {
  static const std::shared_future<std::string> digest =
      std::async(std::launch::async, [] { return sha256_of_file(loaded_file()); });
  return digest;
}

}  // namespace

void begin_this_build() { program_digest(); }

Build this_build() {
  return {croon_version(), croon_commit(), program_digest().get(), stage_folders(),
          library_versions()};
}

params::StageVersions versions_of(const Experiment& experiment) {
  params::StageVersions versions = experiment.dataset.versions();
  versions[kFramework] = kFrameworkVersion;
  for (const Variant& variant : experiment.variants) {
    for (const NamedStep& step : variant.pipeline) {
      versions.insert(step.step.versions().begin(), step.step.versions().end());
    }
  }
  return versions;
}

std::vector<Build> united(std::vector<Build> a, const std::vector<Build>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end(),
            [](const Build& x, const Build& y) { return key_of(x) < key_of(y); });
  const auto is_equal = [](const Build& x, const Build& y) { return key_of(x) == key_of(y); };
  a.erase(std::unique(a.begin(), a.end(), is_equal), a.end());
  return a;
}

bool is_same(const std::vector<Build>& a, const std::vector<Build>& b) {
  return builds_json(a) == builds_json(b);
}

std::string builds_json(const std::vector<Build>& builds) { return text_of(list_json(builds)); }

std::vector<Build> read_builds(const std::string& text) {
  std::vector<Build> builds;
  for (const Json& json : parse_bounded<Json>(text)) {
    builds.push_back(read_build(json, json.at("libraries")));
  }
  return builds;
}

std::string versions_json(const params::StageVersions& versions) { return text_of(versions); }

params::StageVersions read_versions(const std::string& text) {
  const Json json = parse_bounded<Json>(text);
  params::StageVersions versions;
  if (!json.is_object()) throw std::runtime_error("its versions are not a JSON object");
  for (const auto& [stage, version] : json.items()) {
    const bool is_version = version.is_number_unsigned() && version <= kMaxVersion;
    if (!is_version) throw std::runtime_error("a version of " + stage + " is not a whole number");
    versions[stage] = version;
  }
  return versions;
}

std::string manifest_with_builds(const std::string& manifest, const std::vector<Build>& builds,
                                 const params::StageVersions& versions) {
  const Json json = parse_bounded<Json>(manifest);
  if (builds.empty()) return manifest;
  Json whole = Json::object();
  for (const auto& [key, value] : json.items()) {
    if (key == "inputs") {
      whole["croon"] = program_json(builds.front());
      whole["libraries"] = libraries_json(builds.front());
      if (builds.size() > 1) whole["builds"] = list_json(builds);
      whole["versions"] = versions;
    }
    whole[key] = value;
  }
  return json_bytes(whole);
}

}  // namespace croon::experiments
