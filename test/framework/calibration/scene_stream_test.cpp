// The scenes of a folder that grows, one after the other.
#include "framework/calibration/scene_stream.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

/// A folder with a folder of clouds for each of three sensors.
class GrowingFolder {
 public:
  /// Writes a cloud that has last changed `age_s` ago; with half of its bytes if not `is_whole`.
  void put(const std::string& sensor, const std::string& scan, double age_s = 100.0,
           bool is_whole = true) const {
    std::string rows;
    for (int i = 0; i < 8; ++i) rows += std::string("\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40", 12);
    const std::string head =
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 8\nHEIGHT 1\n"
        "POINTS 8\nDATA binary\n";
    const std::string bytes = head + rows.substr(0, is_whole ? rows.size() : rows.size() / 2);
    const fs::path file = folder_.write(sensor + "/" + scan + ".pcd", bytes);
    const auto age = std::chrono::duration_cast<fs::file_time_type::duration>(
        std::chrono::duration<double>(age_s));
    fs::last_write_time(file, fs::file_time_type::clock::now() - age);
  }
  void put_all(const std::string& scan) const {
    for (const char* sensor : {"top", "left", "right"}) put(sensor, scan);
  }
  SceneStream stream() const {
    RecordingOptions options;
    options.reference = "top";
    options.max_scenes = 1000000;
    return {recorded_scenes({folder_.path().string()}, options), options.max_time_gap_s};
  }

 private:
  test::TempFolder folder_;
};

constexpr double kWritingAge_s = 1.0;
constexpr double kAbandonedAge_s = SceneStream::kPatience_s + 60.0;

TEST(SceneStream, ReturnsScansInTheirOrderAsTheyAppear) {
  const GrowingFolder folder;
  folder.put_all("000001");
  folder.put_all("000000");
  SceneStream stream = folder.stream();
  EXPECT_TRUE(stream.is_growing());
  EXPECT_EQ(stream.reference(), "top");
  EXPECT_EQ(stream.sensors(), (std::vector<std::string>{"left", "right"}));
  for (const char* name : {"000000", "000001"}) {
    const std::optional<Scene> scene = stream.next();
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->name, name);
    EXPECT_EQ(scene->sensors.size(), 2U);
    EXPECT_EQ(scene->reference.load().size(), 8U);
  }
  EXPECT_FALSE(stream.next());
  folder.put_all("000002");
  EXPECT_EQ(stream.next().value().name, "000002");
}

TEST(SceneStream, PairsNamesThatAreTimes) {
  const GrowingFolder timed;
  timed.put("top", "1700000000.000000");
  timed.put("left", "1700000000.020000");
  timed.put("right", "1700000000.300000");
  timed.put("top", "1700000000.300000");
  SceneStream stream = timed.stream();
  const Scene first = stream.next().value();
  ASSERT_EQ(first.sensors.size(), 1U);
  EXPECT_EQ(first.sensors.front().sensor, "left");
  const Scene second = stream.next().value();
  ASSERT_EQ(second.sensors.size(), 1U);
  EXPECT_EQ(second.sensors.front().sensor, "right");
}

TEST(SceneStream, WaitsForAFileThatIsBeingWritten) {
  const GrowingFolder folder;
  folder.put_all("000000");
  SceneStream stream = folder.stream();
  EXPECT_TRUE(stream.next());
  folder.put_all("000001");
  folder.put("left", "000001", kWritingAge_s, false);
  EXPECT_FALSE(stream.next());
  folder.put("left", "000001", 0.0);
  EXPECT_FALSE(stream.next());  // It may be a part of a cloud.
  folder.put("left", "000001", kWritingAge_s);
  EXPECT_EQ(stream.next().value().sensors.size(), 2U);
}

TEST(SceneStream, GoesOnWithoutASensorThatFails) {
  const GrowingFolder folder;
  folder.put_all("000000");
  SceneStream stream = folder.stream();
  EXPECT_TRUE(stream.next());
  folder.put("top", "000001", kWritingAge_s);
  folder.put("left", "000001");
  EXPECT_FALSE(stream.next());
  folder.put("top", "000001", kAbandonedAge_s);
  EXPECT_EQ(stream.next().value().sensors.size(), 1U);
  folder.put_all("000002");
  folder.put("right", "000002", kAbandonedAge_s, false);
  const Scene damaged = stream.next().value();
  EXPECT_EQ(damaged.sensors.size(), 2U);
  EXPECT_THROW(damaged.sensors.back().load(), InputError);
}

}  // namespace
}  // namespace croon
