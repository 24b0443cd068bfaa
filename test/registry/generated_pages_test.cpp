// The committed reference pages and JSON Schema are what the program writes: else run `make docs`.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "registry/help.hpp"
#include "registry/registry.hpp"
#include "test/support/tree.hpp"

namespace croon {
namespace {

const std::string kDocs = CROON_SOURCE_DIR "/docs/";

std::string bytes_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

class GeneratedPages : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<std::string> of_the_tree = test::tree_files("stages/", ".cpp");
    for (const StageEntry& entry : registry().entries()) {
      // Stages from outside the tree have no pages in it.
      const std::string file = "stages/" + entry.kind + "/" + entry.name + ".cpp";
      if (std::binary_search(of_the_tree.begin(), of_the_tree.end(), file)) catalogue_.add(entry);
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
