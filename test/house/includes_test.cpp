// Who may include whom, and where heavy headers stay out.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "test/support/tree.hpp"

namespace croon::test {
namespace {

using Layers = std::map<std::string, std::set<std::string>>;

/// What each layer may include; a layer may always include itself.
const Layers& layers() {
  static const Layers layers = {
      {"framework/base", {}},
      {"framework/geometry", {"framework/base"}},
      {"framework/spatial", {"framework/base", "framework/geometry"}},
      {"framework/picture", {"framework/base", "framework/geometry"}},
      {"framework/table", {"framework/base"}},
      {"framework/openvdb", {"framework/base"}},
      {"framework/io",
       {"framework/base", "framework/geometry", "framework/spatial", "framework/openvdb",
        "framework/picture"}},
      {"framework/simulation",
       {"framework/base", "framework/geometry", "framework/params", "framework/picture"}},
      {"framework/registration",
       {"framework/base", "framework/geometry", "framework/spatial", "framework/params"}},
      {"framework/params", {"framework/base"}},
      {"framework/stage",
       {"framework/base", "framework/geometry", "framework/spatial", "framework/registration",
        "framework/params", "framework/picture"}},
      {"framework/pipeline",
       {"framework/base", "framework/geometry", "framework/spatial", "framework/registration",
        "framework/params", "framework/stage"}},
      {"framework/document", {"framework/base", "framework/table", "framework/picture"}},
      {"framework/recording",
       {"framework/base", "framework/geometry", "framework/io", "framework/stage"}},
      {"framework/calibration",
       {"framework/base", "framework/geometry", "framework/spatial", "framework/registration",
        "framework/params", "framework/stage", "framework/pipeline", "framework/io",
        "framework/table", "framework/picture", "framework/recording"}},
      {"stages", {"framework"}},
      {"registry", {"framework"}},
      {"experiments/file", {"framework", "registry"}},
      {"experiments/run", {"framework", "registry", "experiments/file"}},
      {"experiments/store", {"framework", "registry", "experiments/file", "experiments/run"}},
      {"experiments/analysis",
       {"framework", "registry", "experiments/file", "experiments/run", "experiments/store"}},
      {"experiments/report",
       {"framework", "registry", "experiments/file", "experiments/run", "experiments/store",
        "experiments/analysis"}},
      {"experiments/session",
       {"framework", "registry", "experiments/file", "experiments/run", "experiments/store",
        "experiments/analysis", "experiments/report"}},
      {"experiments/cli", {"framework", "registry", "experiments"}},
      {"experiments/python", {"framework", "registry", "experiments"}},
      {"benchmarks", {"framework", "registry", "experiments", "test/support"}},
      {"test", {"framework", "registry", "experiments", "benchmarks"}},
      {"docs", {"framework"}},
  };
  return layers;
}

bool is_below(const std::string& path, const std::string& folder) {
  return starts_with(path, folder + "/");
}

/// The layer that a file belongs to; empty where it is in none.
std::string layer_of(const std::string& file) {
  for (const auto& [layer, others] : layers()) {
    if (is_below(file, layer)) return layer;
  }
  return "";
}

bool is_allowed(const std::string& layer, const std::string& path) {
  // A stage is one file: it includes no other stage, so not even its own layer.
  if (layer != "stages" && is_below(path, layer)) return true;
  for (const std::string& other : layers().at(layer)) {
    if (is_below(path, other)) return true;
  }
  return false;
}

TEST(Includes, FollowTheLayers) {
  for (const Include& include : tree_includes()) {
    if (!include.is_quoted) continue;
    const std::string layer = layer_of(include.line.file);
    ASSERT_NE(layer, "") << include.line.place() << ": the file is in no layer";
    EXPECT_TRUE(is_allowed(layer, include.path))
        << include.line.place() << ": " << layer << " may not include " << include.path;
  }
}

TEST(Includes, AreWrittenFromTheRoot) {
  for (const Include& include : tree_includes()) {
    if (!include.is_quoted) continue;
    EXPECT_TRUE(std::filesystem::is_regular_file(source_root() / include.path))
        << include.line.place() << ": no such file from the root: " << include.path;
  }
}

TEST(Includes, KeepHeavyHeadersOutOfHeaders) {
  for (const Include& include : tree_includes()) {
    if (!ends_with(include.line.file, ".hpp")) continue;
    for (const char* heavy :
         {"CGAL/", "openvdb/", "nlohmann/json.hpp", "yaml-cpp/", "tinyxml2.h"}) {
      EXPECT_FALSE(starts_with(include.path, heavy))
          << include.line.place() << ": " << include.path << " belongs into a .cpp file";
    }
  }
}

TEST(Includes, OfTheSimulationAreInItsDatasetOnly) {
  for (const Include& include : tree_includes()) {
    if (!is_below(include.path, "framework/simulation")) continue;
    const std::string& file = include.line.file;
    EXPECT_TRUE(is_below(file, "framework/simulation") || is_below(file, "test") ||
                is_below(file, "benchmarks") || file == "stages/dataset/simulated.cpp")
        << include.line.place() << ": only the dataset may include " << include.path;
  }
}

TEST(Includes, OfTheCommandLineAreInTheCommandsOnly) {
  for (const Include& include : tree_includes()) {
    if (!starts_with(include.path, "CLI/")) continue;
    EXPECT_TRUE(is_below(include.line.file, "experiments/cli")) << include.line.place();
  }
}

TEST(Headers, StartWithPragmaOnce) {
  for (const std::string& file : tree_files("", ".hpp")) {
    const std::vector<Line> lines = lines_of(file);
    ASSERT_FALSE(lines.empty()) << file;
    EXPECT_EQ(lines.front().text, "#pragma once") << file;
  }
}

}  // namespace
}  // namespace croon::test
