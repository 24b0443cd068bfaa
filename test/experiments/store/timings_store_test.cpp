#include "experiments/store/timings_store.hpp"

#include <gtest/gtest.h>

#include "framework/base/whole_file.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

TrialId timed(int trial) { return {"base", "scene", "left", trial}; }

Done steps_of(const TrialId& id, double seconds) {
  return {std::nullopt, {{id, "yaw", seconds}, {id, "icp", seconds}}};
}

class TimingsStoreTest : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }

  static std::string rows(const TimingsStore& timings) {
    std::string rows;
    timings.for_each([&](const TimingRow& row) {
      rows += row.id.variant + " " + std::to_string(row.id.trial) + " " + row.step + " " +
              std::to_string(row.seconds) + "\n";
    });
    return rows;
  }

  test::TempFolder folder_;
};

TEST_F(TimingsStoreTest, HasRowsByTrialInTheOrderOfTheSteps) {
  TimingsStore timings(path("t"), Access::write);
  EXPECT_TRUE(timings.is_empty());
  timings.add({steps_of(timed(3), 0.5), steps_of(timed(1), 0.25)});
  timings.add({{std::nullopt, {{{"", "scene", "left", -1}, "reading", 2.0}}}});
  EXPECT_EQ(rows(timings),
            " -1 reading 2.000000\nbase 1 yaw 0.250000\nbase 1 icp 0.250000\n"
            "base 3 yaw 0.500000\nbase 3 icp 0.500000\n");
  EXPECT_FALSE(timings.is_empty());
  EXPECT_TRUE(timings.has(timed(3)));
  EXPECT_FALSE(timings.has(timed(2)));
  EXPECT_EQ(rows(TimingsStore(path("t"), Access::read)), rows(timings));
}

TEST_F(TimingsStoreTest, ToReadIsNotCreated) {
  EXPECT_TRUE(TimingsStore(path("t"), Access::read).is_empty());
  EXPECT_FALSE(fs::exists(path("t")));
}

TEST_F(TimingsStoreTest, HasEachMeasurementOnce) {
  TimingsStore(path("a"), Access::write).add({steps_of(timed(3), 0.5)});
  TimingsStore(path("b"), Access::write).add({steps_of(timed(3), 0.5), steps_of(timed(3), 1.0)});
  TimingsStore merged(path("merged"), Access::write);
  for (const char* part : {"a", "b", "none", "a"}) merged.merge(path(part));
  EXPECT_EQ(rows(merged),
            "base 3 yaw 0.500000\nbase 3 yaw 1.000000\n"
            "base 3 icp 0.500000\nbase 3 icp 1.000000\n");
  EXPECT_FALSE(fs::exists(path("none")));
}

TEST_F(TimingsStoreTest, RefusesOtherFilesAndKeepsThem) {
  Database(path("foreign"), Access::create).run("CREATE TABLE timings(seconds)");
  TimingsStore(path("damaged"), Access::write).add({steps_of(timed(3), 0.5)});
  Database(path("damaged"), Access::write).run("CREATE TABLE more(x)");
  std::string bytes = read_whole_file(path("damaged"));
  folder_.write("cut", bytes.substr(0, 5000));
  folder_.write("text", "this is no database");
  for (const char* name : {"foreign", "damaged", "cut", "text"}) {
    bytes = read_whole_file(path(name));
    for (const Access access : {Access::read, Access::write}) {
      const std::string fault = test::input_error([&] { TimingsStore(path(name), access); });
      EXPECT_EQ(fault.rfind(path(name).string() + ": ", 0), 0U) << fault;
      EXPECT_NE(fault.find("; only wall times are read from this file: move it away"),
                std::string::npos)
          << fault;
    }
    EXPECT_TRUE(read_whole_file(path(name)) == bytes) << name;
  }
}

}  // namespace
}  // namespace croon::experiments
