// What holds for the files of the tree.
#include <gtest/gtest.h>

#include <regex>

#include "test/support/script.hpp"
#include "test/support/temp_folder.hpp"
#include "test/support/tree.hpp"

namespace croon::test {
namespace {

TEST(Stages, AreSourceFilesWithoutHeaders) {
  for (const std::string& file : tree_files("stages/", "")) {
    EXPECT_TRUE(ends_with(file, ".cpp") || file == "stages/CMakeLists.txt") << file;
  }
}

TEST(Files, NameNoMachineAndNoPackageRegistry) {
  // Put together here, or this file would find itself.
  const std::vector<std::string> words = {
      std::string("/wo") + "rk/",      std::string("/ro") + "ot/",
      std::string("pypi") + ".org",    std::string("npm") + "js.org",
      std::string("arti") + "factory", std::string("deb.de") + "bian."};
  for (const std::string& file : tree_files()) {
    for (const Line& line : lines_of(file)) {
      for (const std::string& word : words) {
        EXPECT_EQ(line.text.find(word), std::string::npos) << line.place() << ": " << word;
      }
    }
  }
}

TEST(Files, HaveNoUnfinishedWork) {
  const std::vector<std::string> words = {std::string("TO") + "DO", std::string("FIX") + "ME",
                                          std::string("for ") + "now"};
  for (const char* ending : {".cpp", ".hpp", ".txt", ".cmake", ".md", "Makefile"}) {
    for (const std::string& file : tree_files("", ending)) {
      for (const Line& line : lines_of(file)) {
        for (const std::string& word : words) {
          EXPECT_EQ(line.text.find(word), std::string::npos) << line.place() << ": " << word;
        }
      }
    }
  }
}

TEST(Files, AreShort) {
  for (const char* ending : {".cpp", ".hpp"}) {
    for (const std::string& file : tree_files("", ending)) {
      EXPECT_LT(lines_of(file).size(), 450U) << file << " is two files";
    }
  }
}

TEST(Scripts, WithoutArgumentsSayHowTheyAreCalled) {
  const TempFolder folder;
  int scripts = 0;
  for (const std::string& file : tree_files("experiments/", ".py")) {
    const std::vector<Line> lines = lines_of(file);
    const auto is_start = [](const Line& line) { return starts_with(line.text, "if __name__"); };
    if (std::none_of(lines.begin(), lines.end(), is_start)) continue;
    ++scripts;
    const std::string name = file.substr(file.rfind('/') + 1);
    const Finished ended =
        run_script("python3 -B '" + (source_root() / file).string() + "' 2>&1", folder.path());
    EXPECT_NE(ended.status, 0) << file;
    EXPECT_NE(ended.output.find("\n" + name + " "), std::string::npos) << ended.output;
    EXPECT_EQ(ended.output.find("Traceback"), std::string::npos) << ended.output;
  }
  EXPECT_GT(scripts, 5);
}

TEST(Files, AreSnakeCase) {
  static const std::regex name(R"([a-z0-9_]+\.(cpp|hpp))");
  for (const char* ending : {".cpp", ".hpp"}) {
    for (const std::string& file : tree_files("", ending)) {
      EXPECT_TRUE(std::regex_match(file.substr(file.rfind('/') + 1), name)) << file;
    }
  }
}

}  // namespace
}  // namespace croon::test
