#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/params/json_file.hpp"
#include "framework/params/table.hpp"

namespace croon::params {
namespace {

using ::testing::HasSubstr;

struct Params {
  std::string path;
  std::string name = "unnamed";
};

const Table<Params> kTable = {text("path", &Params::path, "A path."),
                              text("name", &Params::name, "A name.")};

Params read(const std::string& json, std::vector<Fault>& faults) {
  const nlohmann::json value = parse_json(json, "test");
  return kTable.read(Node(value, "test", faults), {}, NoStages{});
}

TEST(TextParameter, IsAnyTextAndIsWrittenAsJson) {
  std::vector<Fault> faults;
  const Params params = read(R"({"path": "a \"b\"/ü"})", faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(params.path, "a \"b\"/ü");
  EXPECT_EQ(kTable.json(params), R"({"path":"a \"b\"/ü","name":"unnamed"})");
}

TEST(TextParameter, IsRequiredWhereItHasNoDefault) {
  std::vector<Fault> faults;
  read("{}", faults);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_THAT(faults[0].message, HasSubstr("the key \"path\" is missing"));
  EXPECT_TRUE(kTable.docs()[0].is_required);
  EXPECT_FALSE(kTable.docs()[1].is_required);
}

TEST(TextParameter, RefusesNumbersAndNothing) {
  for (const char* json : {R"({"path": 1})", R"({"path": ""})", R"({"path": null})"}) {
    std::vector<Fault> faults;
    read(json, faults);
    ASSERT_EQ(faults.size(), 1u) << json;
    EXPECT_EQ(faults[0].where, "/path");
    EXPECT_THAT(faults[0].message, HasSubstr("expected a string"));
  }
}

}  // namespace
}  // namespace croon::params
