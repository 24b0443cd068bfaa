// Reminds who changes what decides results of the version that it declares.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <sstream>

#include "framework/base/version.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/digest.hpp"
#include "registry/registry.hpp"
#include "test/support/tree.hpp"

namespace croon::test {
namespace {

constexpr const char* kTable = "test/house/stage_versions.txt";
constexpr const char* kVariable = "CROON_WRITE_STAGE_VERSIONS";
constexpr std::size_t kDigits = 16;

constexpr const char* kHead =
    "# The versions that stages and the framework declare, and a digest of each stage's source "
    "files "
    "without comments and spaces.\n"
    "# Written by CROON_WRITE_STAGE_VERSIONS=1 build/test/bin/test_house "
    "--gtest_filter='StageVersions.*'\n";

/// The code without comments and without white space, but for that in literals.
std::string code_of(const std::string& text) {
  std::string code;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "/*") == 0) {
      i = text.find("*/", i) + 1;
    } else if (c == '"' || c == '\'') {
      std::size_t end = i + 1;
      while (end < text.size() && text[end] != c && text[end] != '\n')
        end += text[end] == '\\' ? 2 : 1;
      code += text.substr(i, end - i + 1);
      i = end;
    } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      code += c;
    }
  }
  return code;
}

/// What has a version, and the beginnings of the paths of its source files.
struct Versioned {
  int version = 1;
  std::vector<std::string> sources;
};

/// The stages of the tree, the simulation with the dataset that it makes, and all else as one,
/// without a digest: it changes in most commits, and seldom the results.
std::map<std::string, Versioned> versioned() {
  std::map<std::string, Versioned> all;
  all["framework"].version = kFrameworkVersion;
  for (const StageEntry& entry : registry().entries()) {
    const std::string name = entry.kind + "/" + entry.name;
    const std::string source = "stages/" + name + ".cpp";
    if (tree_files(source, "").empty()) continue;
    all[name] = {entry.version, {source}};
  }
  for (const std::string& file : tree_files("framework/simulation/", "")) {
    if (ends_with(file, ".cpp") || ends_with(file, ".hpp")) {
      all["dataset/simulated"].sources.push_back(file);
    }
  }
  return all;
}

std::string digest_of(const std::vector<std::string>& sources) {
  if (sources.empty()) return "-";
  std::string code;
  for (const std::string& file : sources) {
    code += file + "\n" + code_of(read_whole_file(source_root() / file)) + "\n";
  }
  return sha256_of_text(code).substr(0, kDigits);
}

struct Row {
  int version = 0;
  std::string digest;
};

std::map<std::string, Row> rows_of_table() {
  std::map<std::string, Row> rows;
  for (const Line& line : lines_of(kTable)) {
    std::istringstream words(line.text);
    std::string name;
    Row row;
    if (words >> name >> row.version >> row.digest && name != "#") rows[name] = row;
  }
  return rows;
}

TEST(StageVersions, AreRaisedWithTheResults) {
  const auto all = versioned();
  if (std::getenv(kVariable) != nullptr) {
    std::string text = kHead;
    for (const auto& [name, what] : all) {
      text += name + " " + std::to_string(what.version) + " " + digest_of(what.sources) + "\n";
    }
    write_whole_file(source_root() / kTable, text);
  }
  const std::map<std::string, Row> rows = rows_of_table();
  const std::string remedy =
      std::string(
          "; if the same experiment now gives other results, raise its version "
          "(stage_entry, framework/base/version.hpp); then run\n  ") +
      kVariable + "=1 build/test/bin/test_house --gtest_filter='StageVersions.*'";
  for (const auto& [name, what] : all) {
    const auto row = rows.find(name);
    ASSERT_NE(row, rows.end()) << name << " is not in " << kTable << remedy;
    EXPECT_EQ(row->second.version, what.version)
        << "the version of " << name << " changed" << remedy;
    EXPECT_EQ(row->second.digest, digest_of(what.sources))
        << "the code of " << name << " changed" << remedy;
  }
  // A build without CGAL lacks stages.
  for (const auto& [name, row] : rows) {
    EXPECT_TRUE(name == "framework" || !tree_files("stages/" + name + ".cpp", "").empty())
        << name << " of " << kTable << " is no stage" << remedy;
  }
}

TEST(StageVersions, IgnoreCommentsAndSpaces) {
  EXPECT_EQ(code_of("int a = 1;  // one\n/* two */ int b;\n"), "inta=1;intb;");
  EXPECT_EQ(code_of("f(\"a // b\", '\"', \"\\\" c\");"), "f(\"a // b\",'\"',\"\\\" c\");");
  EXPECT_NE(code_of("f(1);"), code_of("f(2);"));
}

}  // namespace
}  // namespace croon::test
