// The recordings beside this file were written by test/support/write_recordings.mjs.
#include "framework/io/recording_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/whole_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/support/temp_folder.hpp"
#include "test/support/tree.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr double kStart_s = 1700000000.123456789;
constexpr double kMaxTimeError_s = 1e-6;

fs::path stored(const std::string& name) {
  return test::source_root() / "test/framework/io/recordings" / name;
}

/// When the script fired the ray of point `index` of `count`, dropped ones included.
double fired_s(double stamp_s, std::size_t index, std::size_t count) {
  return stamp_s + 0.1 * static_cast<double>(index) / static_cast<double>(count);
}

/// The indices of the points that the script did not make NaN or zero.
std::vector<std::size_t> kept_points(std::size_t count) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 13 != 5 && i % 17 != 3) kept.push_back(i);
  }
  return kept;
}

void expect_times(const PointCloud& cloud, double stamp_s, std::size_t count) {
  const std::vector<double> times = times_s(cloud);
  const std::vector<std::size_t> kept = kept_points(count);
  ASSERT_EQ(times.size(), kept.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(times[i], fired_s(stamp_s, kept[i], count), kMaxTimeError_s);
  }
}

/// Expects the points and all channels but the time of `file` in `cloud`.
void expect_same(const LoadedCloud& cloud, const fs::path& file) {
  const LoadedCloud expected = read_point_cloud(file);
  EXPECT_EQ(cloud.points, expected.points);
  EXPECT_EQ(cloud.dropped_non_finite, expected.dropped_non_finite);
  EXPECT_EQ(cloud.dropped_zero, expected.dropped_zero);
  EXPECT_THAT(cloud.sha256, SizeIs(64));
  ASSERT_EQ(cloud.channels.size(), expected.channels.size());
  for (std::size_t i = 0; i < cloud.channels.size(); ++i) {
    EXPECT_EQ(cloud.channels[i].name, expected.channels[i].name);
    if (cloud.channels[i].name == kTime) continue;
    EXPECT_EQ(cloud.channels[i].type, expected.channels[i].type);
    EXPECT_EQ(cloud.channels[i].bytes, expected.channels[i].bytes);
  }
}

void expect_recording(const fs::path& path) {
  SCOPED_TRACE(path.filename().string());
  EXPECT_TRUE(is_recording(path));
  const std::vector<CloudTopic> topics = read_recording(path);
  ASSERT_THAT(topics, SizeIs(2));
  EXPECT_EQ(topics[0].name, "/left/points");
  EXPECT_EQ(topics[0].frame, "left_lidar");
  EXPECT_EQ(topics[1].name, "/top/points");
  EXPECT_EQ(topics[1].frame, "top_lidar");
  for (std::size_t sensor = 0; sensor < 2; ++sensor) {
    ASSERT_THAT(topics[sensor].clouds, SizeIs(3));
    for (std::size_t i = 0; i < 3; ++i) {
      const RecordedCloud& cloud = topics[sensor].clouds[i];
      const double stamp_s =
          kStart_s + 0.1 * static_cast<double>(i) + 0.004 * static_cast<double>(sensor);
      EXPECT_NEAR(cloud.stamp_s, stamp_s, kMaxTimeError_s);
      const LoadedCloud loaded = cloud.load();
      const std::string name = (sensor == 0 ? "left_" : "top_") + std::to_string(i) + ".pcd";
      expect_same(loaded, stored(name));
      expect_times(loaded, stamp_s, 104);
    }
  }
}

TEST(RecordingFile, HasTheCloudsOfItsTopics) {
  for (const char* name :
       {"plain.mcap", "chunks.mcap", "lz4.mcap", "zstd.mcap", "plain.db3", "messages_zstd.db3"}) {
    expect_recording(stored(name));
  }
}

TEST(RecordingFile, HasTimesInTheConventionsOfDrivers) {
  const std::vector<CloudTopic> topics = read_recording(stored("conventions.mcap"));
  std::vector<std::string> names;
  for (const CloudTopic& topic : topics) {
    SCOPED_TRACE(topic.name);
    names.push_back(topic.name);
    ASSERT_THAT(topic.clouds, SizeIs(1));
    const LoadedCloud cloud = topic.clouds[0].load();
    EXPECT_EQ(cloud.points, topics[0].clouds[0].load().points);
    if (topic.name != "/all_types") expect_times(cloud, kStart_s, 40);
  }
  EXPECT_THAT(names, ElementsAre("/all_types", "/big_endian", "/hesai", "/livox", "/nebula",
                                 "/ouster", "/robosense", "/velodyne"));
}

TEST(RecordingFile, HasChannelsOfAllDatatypes) {
  const LoadedCloud cloud = read_recording(stored("conventions.mcap"))[0].clouds[0].load();
  EXPECT_THAT(cloud.channels, SizeIs(8));
  const std::vector<std::size_t> kept = kept_points(40);
  for (const Channel& channel : cloud.channels) {
    const bool is_unsigned = channel.type.kind == ScalarKind::unsigned_integer;
    EXPECT_EQ(channel.count, 2U);
    ASSERT_EQ(channel.bytes.size(), cloud.size() * channel.bytes_per_point());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double ring = static_cast<double>(kept[i] % 16) - (is_unsigned ? 0.0 : 8.0);
      const char* const second =
          channel.bytes.data() + i * channel.bytes_per_point() + channel.type.size;
      EXPECT_EQ(channel.value(i), ring) << channel.name;
      EXPECT_EQ(decode_scalar(channel.type, ByteOrder::little, second), ring + 1) << channel.name;
    }
  }
}

std::string metadata(const std::vector<std::string>& files) {
  std::string text = "rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths:\n";
  for (const std::string& file : files) text += "    - " + file + "\n";
  return text + "  topics_with_message_count:\n    - topic_metadata:\n        name: /left/points\n";
}

TEST(RecordingFile, IsAFolderOfSplitFiles) {
  const test::TempFolder folder;
  fs::copy_file(stored("lz4.mcap"), folder.path() / "drive_1.mcap");
  fs::copy_file(stored("plain.db3"), folder.path() / "drive_0.db3");
  fs::copy_file(stored("zstd.mcap"), folder.path() / "of_another_drive.mcap");
  folder.write("metadata.yaml", metadata({"drive_0.db3.zstd", "'drive/drive_1.mcap'"}));
  EXPECT_TRUE(is_recording(folder.path()));
  const std::vector<CloudTopic> topics = read_recording(folder.path());
  ASSERT_THAT(topics, SizeIs(2));
  ASSERT_THAT(topics[0].clouds, SizeIs(6));
  for (std::size_t i = 1; i < 6; ++i) {
    EXPECT_GE(topics[0].clouds[i].stamp_s, topics[0].clouds[i - 1].stamp_s);
  }
  folder.write("metadata.yaml", metadata({"drive_0.db3", "drive_2.db3"}));
  EXPECT_THAT(test::input_error([&] { read_recording(folder.path()); }),
              HasSubstr("expected the file \"drive_2.db3\" beside it"));
  fs::remove(folder.path() / "metadata.yaml");
  EXPECT_TRUE(is_recording(folder.path()));
  EXPECT_THAT(read_recording(folder.path())[0].clouds, SizeIs(9));
}

TEST(RecordingFile, OthersAreNone) {
  const test::TempFolder folder;
  EXPECT_FALSE(is_recording(folder.path()));
  EXPECT_FALSE(is_recording(folder.path() / "missing"));
  folder.write("metadata.yaml", "title: holiday\n");
  folder.write("a.pcd", "");
  EXPECT_FALSE(is_recording(folder.path()));
  EXPECT_FALSE(is_recording(folder.path() / "a.pcd"));
}

TEST(RecordingFile, NamesTheWayToConvertOthers) {
  const test::TempFolder folder;
  const auto error_of = [](const fs::path& path) {
    EXPECT_TRUE(is_recording(path)) << path;
    return test::input_error([&] { read_recording(path); });
  };
  EXPECT_THAT(error_of(folder.write("drive.bag", "#ROSBAG V2.0\n")),
              HasSubstr("\"rosbags-convert --src drive.bag --dst drive\""));
  EXPECT_THAT(error_of(folder.write("drive.db3.zstd", "x")),
              HasSubstr("\"zstd -d drive.db3.zstd -o drive.db3\""));
  EXPECT_THAT(error_of(stored("ros1.mcap")), HasSubstr("rosbags-convert"));
  EXPECT_THAT(error_of(stored("livox.mcap")), HasSubstr("xfer_format is 0"));
  EXPECT_THAT(error_of(stored("json.mcap")),
              HasSubstr("/points: expected messages in cdr, found \"json\""));
  EXPECT_THAT(error_of(folder.write("text.mcap", "text")), HasSubstr("is not an MCAP file"));
  EXPECT_THAT(error_of(folder.write("text.db3", "text, and not a database")),
              HasSubstr("is not an SQLite file"));
  EXPECT_THAT(error_of(folder.path() / "missing.mcap"), HasSubstr("missing.mcap"));
}

/// The number of clouds of a recording that can be read; each of the others is one InputError.
std::size_t readable_clouds(const std::vector<CloudTopic>& topics) {
  std::size_t readable = 0;
  for (const CloudTopic& topic : topics) {
    for (const RecordedCloud& cloud : topic.clouds) {
      const std::string error = test::input_error([&] { cloud.load(); });
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
      readable += error.empty() ? 1 : 0;
    }
  }
  return readable;
}

TEST(RecordingFile, IsReadUpToItsDamage) {
  const test::TempFolder folder;
  for (const char* name :
       {"plain.mcap", "chunks.mcap", "lz4.mcap", "zstd.mcap", "plain.db3", "messages_zstd.db3"}) {
    SCOPED_TRACE(name);
    const std::string bytes = read_whole_file(stored(name));
    std::size_t before = 0;
    for (std::size_t size = bytes.size() / 23; size < bytes.size(); size += bytes.size() / 23) {
      const fs::path cut = folder.write(std::string("cut_") + name, bytes.substr(0, size));
      std::vector<std::string> notices;
      std::vector<CloudTopic> topics;
      const std::string error = test::input_error([&] { topics = read_recording(cut, &notices); });
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
      const std::size_t readable = readable_clouds(topics);
      EXPECT_GE(readable, before);
      EXPECT_EQ(error.empty(), readable > 0);
      if (readable < 6) {
        EXPECT_THAT(test::input_error([&] { read_recording(cut); }),
                    AnyOf(HasSubstr("the recording was interrupted"),
                          HasSubstr("the recording is damaged or incomplete")));
      }
      for (const std::string& notice : notices) {
        EXPECT_THAT(notice, HasSubstr("before that are used"));
      }
      before = readable;
    }
    EXPECT_GE(before, 5U);
  }
}

TEST(RecordingFile, WithWrongBytesIsAnErrorOrARecording) {
  const test::TempFolder folder;
  for (const char* name : {"plain.mcap", "lz4.mcap", "zstd.mcap", "plain.db3"}) {
    const std::string bytes = read_whole_file(stored(name));
    for (std::size_t i = 0; i < 200; ++i) {
      std::string wrong = bytes;
      const std::size_t at = i < 100 ? i * 7 : i * bytes.size() / 200;
      for (std::size_t k = at; k < std::min(at + 1 + i % 9, bytes.size()); ++k) wrong[k] ^= '\xff';
      const fs::path file = folder.write(std::string("wrong") + name, wrong);
      std::vector<std::string> notices;
      const std::string error =
          test::input_error([&] { readable_clouds(read_recording(file, &notices)); });
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
  }
}

TEST(RecordingFile, NoticesAWrongChecksum) {
  const test::TempFolder folder;
  std::string bytes = read_whole_file(stored("zstd.mcap"));
  // The checksum of the first chunk, and the length of the name of its compression, precede it.
  const std::size_t name = bytes.find("zstd");
  ASSERT_NE(name, std::string::npos);
  bytes[name - 5] ^= 1;
  const fs::path file = folder.write("wrong.mcap", bytes);
  EXPECT_THAT(test::input_error([&] { read_recording(file); }), HasSubstr("checksum"));
}

}  // namespace
}  // namespace croon
