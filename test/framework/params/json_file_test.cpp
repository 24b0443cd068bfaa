#include "framework/params/json_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::params {
namespace {

std::vector<Fault> json_faults(const std::string& text) {
  try {
    parse_json(text, "f.json");
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

TEST(ParseJson, FindsEveryDuplicateKeyAndItsPlace) {
  const auto faults =
      json_faults(R"({"a": 1, "b": [{"x": 1}, {"c/d": 1, "y": [], "c/d": 2}], "a": {"a": 1}})");
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].where, "/b/1/c~1d");
  EXPECT_EQ(faults[1].where, "/a");
  EXPECT_EQ(faults[1].file, "f.json");
}

TEST(ParseJson, LetsEqualKeysOfDifferentObjectsPass) {
  EXPECT_TRUE(
      json_faults(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 2}, [], [[1]], {"a": 3}]})").empty());
}

TEST(ParseJson, SaysWhereItIsNotJson) {
  const auto faults = json_faults("{\"a\": 1,\n  oops}");
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].message.find("line 2, column 3"), std::string::npos) << faults[0].message;
  EXPECT_EQ(json_faults("").size(), 1u);
  EXPECT_EQ(json_faults("{} {}").size(), 1u);
}

TEST(ParseJson, RefusesWhatIsNestedTooDeeply) {
  EXPECT_EQ(json_faults(std::string(200000, '[')).size(), 1u);
  EXPECT_TRUE(json_faults(std::string(50, '[') + std::string(50, ']')).empty());
  const auto faults = json_faults(R"({"a": )" + std::string(200, '['));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].where.substr(0, 8), "/a/0/0/0");
  EXPECT_EQ(faults[0].message, "expected at most 100 levels of lists and objects, found more");
}

TEST(ParseJson, RefusesMoreThanTenMegabytes) {
  EXPECT_TRUE(json_faults("[" + std::string(9'999'998, ' ') + "]").empty());
  const auto faults = json_faults("[" + std::string(9'999'999, ' ') + "]");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].message, "expected JSON of at most 10000000 bytes, found 10000001");
}

TEST(ReadJsonText, RefusesALargeFileWithoutReadingIt) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "large.json";
  std::ofstream(path) << "{}";
  EXPECT_EQ(read_json_text(path), "{}");
  // Without blocks on the disk; no machine has the memory for it.
  std::filesystem::resize_file(path, 1'000'000'000'000);
  try {
    read_json_text(path);
    ADD_FAILURE() << "it was read";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1U);
    EXPECT_EQ(error.faults()[0].message,
              "expected JSON of at most 10000000 bytes, found 1000000000000");
  }
}

TEST(ParseJson, RefusesBytesBehindANullByte) {
  const auto faults = json_faults(std::string("{}\n\0{\"a\": oops", 14));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].where, "line 2, column 1");
}

TEST(ParseJson, SaysWhereANumberIsTooLarge) {
  const auto faults = json_faults("{\"a\": 1,\n \"b\": 1e999}");
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].where, "line 2, column 7");
  EXPECT_NE(faults[0].message.find("expected a number of at most 1.8e308, found: "),
            std::string::npos)
      << faults[0].message;
}

TEST(ReadJsonFile, RefusesWhatIsNotAFile) {
  EXPECT_THROW(read_json_file("/no/such/file.json"), InputError);
  EXPECT_THROW(read_json_file("/"), InputError);
}

}  // namespace
}  // namespace croon::params
