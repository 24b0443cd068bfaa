// The committed reference pages and JSON Schema are what the program writes: else run `make docs`.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "registry/help.hpp"
#include "registry/registry.hpp"

namespace croon {
namespace {

const std::string kDocs = CROON_SOURCE_DIR "/docs/";

std::string bytes_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// The stages that stages/CMakeLists.txt adds, "icp/icpn".
std::set<std::string> stages_of_the_tree() {
  static const std::regex pattern(R"(croon_add_stage\((\w+) (\w+)[ )])");
  const std::string text = bytes_of(CROON_SOURCE_DIR "/stages/CMakeLists.txt");
  std::set<std::string> stages;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), pattern);
       it != std::sregex_iterator(); ++it) {
    stages.insert((*it)[1].str() + "/" + (*it)[2].str());
  }
  return stages;
}

class GeneratedPages : public testing::Test {
 protected:
  void SetUp() override {
    const std::set<std::string> of_the_tree = stages_of_the_tree();
    for (const StageEntry& entry : registry().entries()) {
      // Stages from outside the tree have no pages in it.
      if (of_the_tree.count(entry.kind + "/" + entry.name) > 0) catalogue_.add(entry);
    }
    if (catalogue_.entries().size() != of_the_tree.size()) {
      GTEST_SKIP() << "this build leaves out stages of the tree";
    }
  }
  Catalogue catalogue_;
};

TEST_F(GeneratedPages, ReferencePages) {
  EXPECT_EQ(bytes_of(kDocs + "stages/README.md"),
            stages_help(catalogue_, "", HelpFormat::markdown));
  for (const StageKind& kind : catalogue_.kinds()) {
    EXPECT_EQ(bytes_of(kDocs + "stages/" + kind.name + ".md"),
              stages_help(catalogue_, kind.name, HelpFormat::markdown))
        << kind.name << ": run make docs";
  }
}

}  // namespace
}  // namespace croon
