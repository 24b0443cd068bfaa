#include <gtest/gtest.h>

#include <cstring>

#include "framework/io/pcd_file.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

/// A channel of random bytes, but for NaN, whose bits text does not have.
Channel random_channel(Rng& rng, const std::string& name, ScalarType type, std::size_t count,
                       std::size_t points) {
  Channel channel{name, type, count, {}};
  while (channel.bytes.size() < points * channel.bytes_per_point()) {
    std::string bytes;
    for (std::size_t i = 0; i < type.size; ++i) bytes += static_cast<char>(rng.below(256));
    const double value = decode_scalar(type, ByteOrder::little, bytes.data());
    if (value == value) channel.bytes += bytes;
  }
  return channel;
}

/// A cloud with a channel of each type; of several numbers too if `has_lists`.
PointCloud random_channels(Rng& rng, int points, bool has_lists) {
  PointCloud cloud = random_cloud(rng, points, 80.0);
  const auto size = static_cast<std::size_t>(points);
  for (const ScalarKind kind :
       {ScalarKind::floating, ScalarKind::signed_integer, ScalarKind::unsigned_integer}) {
    for (const std::size_t bytes : {1, 2, 4, 8}) {
      const bool is_floating = kind == ScalarKind::floating;
      if (is_floating && bytes < 4) continue;
      if (!is_floating && bytes == 8 && !has_lists) continue;
      const std::string name = "c" + std::to_string(cloud.channels.size());
      cloud.channels.push_back(
          random_channel(rng, name, {kind, bytes}, has_lists ? 1 + rng.below(3) : 1, size));
    }
  }
  cloud.channels.push_back(random_channel(rng, kTime, scalar_type_of<double>(), 1, size));
  return cloud;
}

void expect_equal(const PointCloud& found, const PointCloud& expected) {
  EXPECT_EQ(found.points, expected.points);
  ASSERT_EQ(found.channels.size(), expected.channels.size());
  for (std::size_t i = 0; i < found.channels.size(); ++i) {
    const Channel &a = found.channels[i], &b = expected.channels[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_TRUE(a.type == b.type) << a.name;
    EXPECT_EQ(a.count, b.count) << a.name;
    EXPECT_TRUE(a.bytes == b.bytes) << a.name;
  }
}

std::vector<std::string> names_of(const PointCloud& cloud) {
  std::vector<std::string> names;
  for (const Channel& channel : cloud.channels) names.push_back(channel.name);
  return names;
}

TEST(CloudWriter, PcdIsReadBackBitForBitInEveryEncoding) {
  const TempFolder folder;
  Rng rng = test_rng();
  const auto path = folder.path() / "cloud.pcd";
  for (const int count : {0, 1, 1000}) {
    const PointCloud cloud = random_channels(rng, count, true);
    for (const PcdEncoding encoding :
         {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed}) {
      write_pcd(path, cloud, encoding);
      EXPECT_EQ(check_point_cloud_file(path), names_of(cloud));
      const LoadedCloud read = read_point_cloud(path);
      expect_equal(read, cloud);
      EXPECT_EQ(read.dropped_non_finite, 0U);
    }
  }
}

TEST(CloudWriter, PlyIsReadBackBitForBit) {
  const TempFolder folder;
  Rng rng = test_rng();
  const auto path = folder.path() / "cloud.ply";
  for (const int count : {0, 1, 1000}) {
    const PointCloud cloud = random_channels(rng, count, false);
    for (const PlyFormat format : {PlyFormat::binary_little_endian, PlyFormat::ascii}) {
      write_ply(path, cloud, format);
      EXPECT_EQ(check_point_cloud_file(path), names_of(cloud));
      expect_equal(read_point_cloud(path), cloud);
    }
  }
}

TEST(CloudWriter, RefusesWhatAFileCannotHold) {
  const TempFolder folder;
  const auto path = folder.path() / "cloud";
  PointCloud cloud = Points{{1, 2, 3}};
  const auto faults_of = [&](const Channel& channel) {
    cloud.channels = {channel};
    return input_error([&] { write_pcd(path, cloud); }) + "|" +
           input_error([&] { write_ply(path, cloud); });
  };
  for (const char* name : {"x", "", "two words", "a\nb", "\xff"}) {
    const std::string faults = faults_of({name, {}, 1, "1234"});
    EXPECT_NE(faults.find("distinct names"), faults.rfind("distinct names")) << name;
  }
  EXPECT_NE(faults_of({"short", {}, 1, "123"}).find("as long as the points"), std::string::npos);
  // PLY alone.
  EXPECT_EQ(faults_of({"many", {}, 2, "12345678"}).find("|" + path.string()), 0U);
  EXPECT_EQ(faults_of({"long", {ScalarKind::signed_integer, 8}, 1, "12345678"}).find("|"), 0U);
  EXPECT_FALSE(faults_of({"long", {ScalarKind::signed_integer, 8}, 1, "12345678"}).size() < 2);
  EXPECT_NE(input_error([] { write_pcd("/no/such/folder/cloud.pcd", {}); }).find("cloud.pcd"),
            std::string::npos);
}

TEST(ChannelNames, AreThoseThatStagesAskFor) {
  const TempFolder folder;
  const auto channels_of = [&](const std::string& fields) {
    const auto path =
        folder.write("a.pcd", "VERSION .7\nFIELDS x y z " + fields +
                                  "\nSIZE 4 4 4 4 4\nTYPE F F F F U\nCOUNT 1 1 1 1 1\n"
                                  "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n"
                                  "1 2 3 0.5 4000000000\n");
    EXPECT_EQ(check_point_cloud_file(path), names_of(read_point_cloud(path)));
    return names_of(read_point_cloud(path));
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(channels_of("intensity ring"), (Names{"intensity", "ring"}));
  EXPECT_EQ(channels_of("i timestamp"), (Names{"intensity", "time"}));
  EXPECT_EQ(channels_of("t timestamp"), (Names{"time", "timestamp"}));
  EXPECT_EQ(channels_of("t time"), (Names{"t", "time"}));
  EXPECT_EQ(channels_of("_ a"), (Names{"a"}));
  EXPECT_EQ(channels_of("a a"), (Names{"a"}));
}

TEST(ChannelNames, OfAnyCloudAreReadAsTheyWereOrRefused) {
  const TempFolder folder;
  const std::vector<std::string> names = {"time", "t",         "timestamp", "time_stamp",
                                          "i",    "intensity", "_",         "ring"};
  PointCloud empty;
  empty.points = {{1, 2, 3}};
  for (unsigned chosen = 0; chosen < 1U << names.size(); ++chosen) {
    PointCloud cloud = empty;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if ((chosen >> i & 1U) != 0) cloud.channels.push_back({names[i], {}, 1, "1234"});
    }
    for (const char* file : {"a.pcd", "a.ply"}) {
      const auto path = folder.path() / file;
      const std::string fault = input_error(
          [&] { path.extension() == ".pcd" ? write_pcd(path, cloud) : write_ply(path, cloud); });
      if (fault.empty()) {
        EXPECT_EQ(names_of(read_point_cloud(path)), names_of(cloud));
      }
      // One alone that stages know is written.
      if (chosen == 1U || chosen == 1U << 5U || chosen == 1U << 7U) {
        EXPECT_EQ(fault, "");
      }
    }
  }
  const auto fault_of = [&](const std::string& name) {
    PointCloud cloud = empty;
    cloud.channels.push_back({name, {}, 1, "1234"});
    return input_error([&] { write_pcd(folder.path() / "a.pcd", cloud); });
  };
  for (const char* name : {"t", "timestamp", "time_stamp"}) {
    EXPECT_NE(fault_of(name).find(std::string("\"") + name + "\", which is read as \"time\""),
              std::string::npos);
  }
  EXPECT_NE(fault_of("i").find("which is read as \"intensity\""), std::string::npos);
  EXPECT_NE(fault_of("_").find("padding"), std::string::npos);
}

TEST(ChannelNames, KittiHasIntensity) {
  const TempFolder folder;
  const float numbers[8] = {1, 2, 3, 0.25F, 4, 5, 6, 0.75F};
  std::string bytes(sizeof numbers, '\0');
  std::memcpy(bytes.data(), numbers, sizeof numbers);
  const auto path = folder.write("a.bin", bytes);
  EXPECT_EQ(check_point_cloud_file(path), std::vector<std::string>{kIntensity});
  EXPECT_EQ(channel_values(read_point_cloud(path), kIntensity), (std::vector{0.25, 0.75}));
}

TEST(Channels, OfDroppedPointsAreDroppedToo) {
  const TempFolder folder;
  const auto path = folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar ring\nend_header\n1 2 3 7\nnan 2 3 8\n4 5 6 9\n");
  EXPECT_EQ(channel_values(read_point_cloud(path), kRing), (std::vector{7.0, 9.0}));
}

TEST(Channels, OfAnotherTypeAreDamage) {
  const TempFolder folder;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar ring\nend_header\n1 2 3 ";
  for (const char* word : {"256", "-1", "1.5", "nan"}) {
    const auto path = folder.write("a.ply", header + word + "\n");
    EXPECT_NE(input_error([&] { read_point_cloud(path); })
                  .find("line 9: expected a number of its "
                        "type for \"ring\""),
              std::string::npos)
        << word;
  }
}

}  // namespace
}  // namespace croon::test
