// The same cloud in each format that is read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/base/text.hpp"
#include "framework/io/pcd_file.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/framework/io/cloud_bytes.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/script.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::size_t kPoints = 600;

/// Points of a scan with intensity, ring and time, and rays without a return among them: zeros of
/// either sign and NaN.
PointCloud sample_cloud(Rng& rng) {
  PointCloud cloud = test::random_cloud(rng, kPoints, 60.0);
  for (Eigen::Vector3f& point : cloud.points) point.z() = 0.05F * point.z() - 1.5F;
  for (std::size_t i = 0; i < kPoints; i += 50) cloud.points[i] = {0.0F, -0.0F, 0.0F};
  for (std::size_t i = 7; i < kPoints; i += 50) {
    cloud.points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  std::vector<float> intensity;
  std::vector<std::uint16_t> ring;
  std::vector<double> time;
  for (std::size_t i = 0; i < kPoints; ++i) {
    intensity.push_back(static_cast<float>(rng.below(1000)) / 1000.0F);
    ring.push_back(static_cast<std::uint16_t>(i % 32));
    time.push_back(1e-4 * static_cast<double>(i));
  }
  cloud.channels = {make_channel(kIntensity, intensity), make_channel(kRing, ring),
                    make_channel(kTime, time)};
  return cloud;
}

/// The same points, dropped ones and values of the channels of `expected` that a format can hold.
void expect_same(const std::filesystem::path& path, const LoadedCloud& expected,
                 const std::vector<std::string>& channels) {
  SCOPED_TRACE(path.filename().string());
  EXPECT_EQ(check_point_cloud_file(path), channels);
  const LoadedCloud found = read_point_cloud(path);
  EXPECT_EQ(found.points, expected.points);
  EXPECT_EQ(found.dropped_zero, expected.dropped_zero);
  EXPECT_EQ(found.dropped_non_finite, expected.dropped_non_finite);
  ASSERT_EQ(found.channels.size(), channels.size());
  for (const std::string& name : channels) {
    EXPECT_EQ(channel_values(found, name), channel_values(expected, name)) << name;
  }
}

/// One line per point with x, y, z, intensity, ring and time.
std::string text_of(const PointCloud& cloud, const std::string& separator) {
  std::string text;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const ScalarType type = scalar_type_of<float>();
      text += scalar_text(type, reinterpret_cast<const char*>(&cloud.points[i](axis))) + separator;
    }
    text += shortest_number(cloud.channels[0].value(i)) + separator +
            shortest_number(cloud.channels[1].value(i)) + separator +
            shortest_number(cloud.channels[2].value(i)) + "\n";
  }
  return text;
}

/// Rows of the first `columns` of x, y, z, intensity, ring and time as float.
std::string rows_of(const PointCloud& cloud, std::size_t columns) {
  std::string rows;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t c = 0; c < columns; ++c) {
      const double value = c < 3 ? static_cast<double>(cloud.points[i](static_cast<int>(c)))
                                 : cloud.channels[c - 3].value(i);
      rows += test::scalar_bytes('F', 4, value, ByteOrder::little);
    }
  }
  return rows;
}

const std::vector<std::string> kAll = {kIntensity, kRing, kTime};

TEST(PointCloudFormats, OfACroonCloudAndOfTextHaveTheSamePointsAndChannels) {
  const test::TempFolder folder;
  Rng rng = test::test_rng();
  const PointCloud cloud = sample_cloud(rng);
  write_pcd(folder.path() / "a.pcd", cloud);
  const LoadedCloud expected = read_point_cloud(folder.path() / "a.pcd");
  EXPECT_EQ(expected.dropped_zero, 12U);
  EXPECT_EQ(expected.dropped_non_finite, 12U);
  EXPECT_EQ(expected.size(), kPoints - 24U);
  write_pcd(folder.path() / "compressed.pcd", cloud, PcdEncoding::binary_compressed);
  expect_same(folder.path() / "compressed.pcd", expected, kAll);
  write_pcd(folder.path() / "ascii.pcd", cloud, PcdEncoding::ascii);
  expect_same(folder.path() / "ascii.pcd", expected, kAll);
  write_ply(folder.path() / "a.ply", cloud);
  expect_same(folder.path() / "a.ply", expected, kAll);
  const std::string names = "x y z intensity ring time\n";
  expect_same(folder.write("a.csv", "X,Y,Z,Intensity,Ring,Timestamp\r\n" + text_of(cloud, ",")),
              expected, kAll);
  expect_same(folder.write("b.csv", "\xEF\xBB\xBF\"x (m)\";\"y (m)\";\"z (m)\";i;laser_id;t\n" +
                                        text_of(cloud, ";")),
              expected, kAll);
  expect_same(folder.write("a.txt", "//X Y Z intensity ring time\n600\n" + text_of(cloud, " ")),
              expected, kAll);
  expect_same(folder.write("a.xyz", "# made by hand\n#" + names + "\n" + text_of(cloud, "\t")),
              expected, kAll);
}

TEST(PointCloudFormats, OfRowsOfFloatsHaveTheSamePointsAndChannels) {
  const test::TempFolder folder;
  Rng rng = test::test_rng();
  PointCloud cloud = sample_cloud(rng);
  std::vector<float> time;
  for (std::size_t i = 0; i < kPoints; ++i) time.push_back(1e-4F * static_cast<float>(i));
  cloud.channels[2] = make_channel("column_6", time);
  write_pcd(folder.path() / "a.pcd", cloud);
  const LoadedCloud expected = read_point_cloud(folder.path() / "a.pcd");
  const std::vector<std::string> names = {kIntensity, kRing, "column_6"};
  for (std::size_t columns = 3; columns <= 6; ++columns) {
    // 600 points: each of these numbers of columns divides each of these files.
    const std::vector<std::string> channels(names.begin(),
                                            names.begin() + static_cast<int>(columns) - 3);
    const std::string rows = rows_of(cloud, columns);
    expect_same(folder.write(std::to_string(columns) + ".bin", rows), expected, channels);
  }
  expect_same(folder.write("a.pcd.bin", rows_of(cloud, 5)), expected, {kIntensity, kRing});
}

/// Writes a.csv as NumPy arrays of every kind.
constexpr const char* kWriteArrays = R"(/usr/bin/python3 - <<'END'
import numpy as np
a = np.genfromtxt('a.csv', delimiter=',', names=True)
kind = [('x', 'f4'), ('y', '<f4'), ('z', '>f4'), ('intensity', 'f4'), ('ring', 'u2'), ('t', 'f8')]
s = np.zeros(len(a), np.dtype(kind))
for name, _ in kind: s[name] = a[name]
np.save('structured.npy', s)
np.save('image.npy', s.reshape(20, 30))
np.save('aligned.npy', s.astype(np.dtype(kind, align=True)))
xyzi = np.stack([s['x'], s['y'], s['z'], s['intensity']], 1)
np.save('c.npy', xyzi)
np.save('fortran.npy', np.asfortranarray(xyzi))
np.save('double.npy', xyzi.astype(np.float64))
np.save('big.npy', xyzi.astype('>f4'))
np.save('three.npy', xyzi[:, :3])
np.save('range_image.npy', xyzi.reshape(20, 30, 4))
np.save('turned.npy', xyzi[:50].T)
np.save('half.npy', xyzi.astype(np.float16))
np.savez('stored.npz', other=np.arange(3), points=s)
np.savez_compressed('deflated.npz', s)
np.savez('two.npz', one=xyzi, two=xyzi)
np.savetxt('numpy.txt', xyzi, fmt='%.17g')
END
)";

TEST(PointCloudFormats, OfNumPyHaveTheSamePointsAndChannels) {
  const test::TempFolder folder;
  if (test::run_script("/usr/bin/python3 -c 'import numpy'", folder.path()).status != 0) {
    GTEST_SKIP() << "python3-numpy is not here";
  }
  Rng rng = test::test_rng();
  const PointCloud cloud = sample_cloud(rng);
  write_pcd(folder.path() / "a.pcd", cloud);
  const LoadedCloud expected = read_point_cloud(folder.path() / "a.pcd");
  folder.write("a.csv", "x,y,z,intensity,ring,t\n" + text_of(cloud, ","));
  const test::Finished written = test::run_script(kWriteArrays, folder.path());
  ASSERT_EQ(written.status, 0) << written.output;
  for (const char* name :
       {"structured.npy", "image.npy", "aligned.npy", "stored.npz", "deflated.npz"}) {
    expect_same(folder.path() / name, expected, kAll);
  }
  for (const char* name :
       {"c.npy", "fortran.npy", "double.npy", "big.npy", "range_image.npy", "numpy.txt"}) {
    expect_same(folder.path() / name, expected, {kIntensity});
  }
  expect_same(folder.path() / "three.npy", expected, {});
  const auto error = [&](const char* name) {
    const std::string read = test::input_error([&] { read_point_cloud(folder.path() / name); });
    EXPECT_EQ(test::input_error([&] { check_point_cloud_file(folder.path() / name); }), read);
    return read;
  };
  EXPECT_THAT(error("turned.npy"), HasSubstr("(4×50); save array.T"));
  EXPECT_THAT(error("half.npy"), HasSubstr("\"<f2\"; save array.astype(numpy.float32)"));
  EXPECT_THAT(error("two.npz"), HasSubstr("found \"one\", \"two\""));
}

TEST(PointCloudFormats, GoByTheContentBeforeTheSuffix) {
  const test::TempFolder folder;
  Rng rng = test::test_rng();
  const Points cloud = test::random_cloud(rng, 9, 10.0);
  for (const char* name : {"cloud", "cloud.bin", "cloud.txt", "cloud.las"}) {
    EXPECT_EQ(read_point_cloud(folder.write(name, test::pcd_bytes({}, cloud))).points, cloud);
  }
  write_ply(folder.path() / "cloud.ply", cloud);
  std::filesystem::rename(folder.path() / "cloud.ply", folder.path() / "ply.pcd");
  EXPECT_EQ(read_point_cloud(folder.path() / "ply.pcd").points, cloud);
}

TEST(PointCloudFormats, OfOthersAreNamedWithTheWayToConvertThem) {
  const test::TempFolder folder;
  const std::tuple<const char*, std::string, const char*> cases[] = {
      {"a.las", "LASF1234", "pdal translate in.las"},
      {"a.laz", "LASF1234", "pdal translate in.laz"},
      {"a.bin", "LASF1234", "a LAS file"},
      {"a.e57", "ASTM-E57", "pdal translate in.e57"},
      {"a.pcap", "\xD4\xC3\xB2\xA1", "network packets"},
      {"a", "\x0A\x0D\x0D\x0A", "network packets"},
      {"a.bag", "#ROSBAG V2.0\n", "rosbags-convert"},
      {"a.mcap", "\x89MCAP0\r\n", "croon calibrate"},
      {"a.db3", "SQLite format 3", "croon calibrate"},
      {"a.obj", "v 1 2 3\n", "EXTRACT_VERTICES"},
      {"a.stl", "solid\n", "EXTRACT_VERTICES"},
      {"a.bin", "CCB2", "CloudCompare"},
      {"a.pkl", "x", "numpy.save"},
      {"a.png", "\x89PNG", "an image"},
      {"a.zip", "PK\x03\x04", "ZIP archive"},
      {"a.xyzrgb", "1 2 3 4 5 6\n", ".xyz"},
  };
  for (const auto& [name, bytes, message] : cases) {
    const auto path = folder.write(name, bytes);
    EXPECT_THAT(test::input_error([&] { read_point_cloud(path); }), HasSubstr(message)) << name;
    EXPECT_THAT(test::input_error([&] { check_point_cloud_file(path); }), HasSubstr(message));
  }
}

TEST(PointCloudFormats, InFoldersAreToldFromOtherText) {
  const test::TempFolder folder;
  for (const char* name : {"a.pcd", "a.PLY", "a.bin", "a.npy", "a.npz", "a.xyz", "a.asc"}) {
    EXPECT_TRUE(has_point_cloud_suffix(name)) << name;
    EXPECT_TRUE(looks_like_point_cloud(name)) << name;
  }
  for (const char* name : {"a.csv", "a.txt", "a.las", "a"}) {
    EXPECT_FALSE(has_point_cloud_suffix(name)) << name;
  }
  EXPECT_TRUE(looks_like_point_cloud(folder.write("a.txt", "1 2 3\n")));
  EXPECT_TRUE(looks_like_point_cloud(folder.write("a.csv", "X,Y,Z\n1,2,3\n")));
  EXPECT_FALSE(looks_like_point_cloud(folder.write("a.txt", "1 2 3 4 5 6 7 8 9 10 11 12\n")));
  EXPECT_FALSE(looks_like_point_cloud(folder.write("a.txt", "2011-09-26 13:02:25\n")));
  EXPECT_FALSE(looks_like_point_cloud(folder.write("a.csv", "sensor,verdict\ntop,accepted\n")));
  EXPECT_FALSE(looks_like_point_cloud(folder.path() / "none.txt"));
}

TEST(CommonOffset, OfAMapIsSubtractedInDoublePrecision) {
  const test::TempFolder folder;
  Rng rng = test::test_rng();
  const Points local = test::random_cloud(rng, 100, 50.0);
  std::string text = "0 0 0\n7e8 7e8 7e8\n", single = "x,y,z\n";
  for (const Eigen::Vector3f& point : local) {
    const Eigen::Vector3d map = point.cast<double>() + Eigen::Vector3d(691e3, 5336e3, 515.0);
    text += shortest_number(map.x()) + " " + shortest_number(map.y()) + " " +
            shortest_number(map.z()) + "\n";
    single += fixed_number(static_cast<double>(static_cast<float>(map.x())), 6) + "," +
              fixed_number(static_cast<double>(static_cast<float>(map.y())), 6) + ",1\n";
  }
  const LoadedCloud cloud = read_point_cloud(folder.write("a.xyz", text));
  EXPECT_EQ(cloud.origin_m, Eigen::Vector3d(691e3, 5336e3, 0.0));
  ASSERT_EQ(cloud.size(), 101U) << "all but the point at zero";
  EXPECT_EQ(cloud.dropped_zero, 1U);
  for (std::size_t i = 0; i < local.size(); ++i) {
    const Eigen::Vector3f expected = local[i] + Eigen::Vector3f(0, 0, 515);
    EXPECT_LT((cloud.points[i + 1] - expected).norm(), 1e-4F);
  }
  EXPECT_THAT(
      cloud.notes,
      ElementsAre("The coordinates are map coordinates: (691000, 5336000, 0) m is subtracted."));
  EXPECT_THAT(read_point_cloud(folder.write("b.csv", single)).notes,
              ElementsAre(HasSubstr("single precision, with steps of 0.5 m")));
  EXPECT_TRUE(read_point_cloud(folder.write("c.xyz", "1 2 3\n4 5 6\n9e5 9e5 9e5\n")).notes.empty());
}

TEST(TimesOfAFile, ThatStartAgainInEveryPacketAreNotUsed) {
  const test::TempFolder folder;
  Rng rng = test::test_rng();
  PointCloud cloud = test::random_cloud(rng, 2000, 50.0);
  std::vector<float> time;
  for (int i = 0; i < 2000; ++i) time.push_back(1e-5F * static_cast<float>(i % 100));
  cloud.channels = {make_channel(kTime, time)};
  write_pcd(folder.path() / "a.pcd", cloud);
  const LoadedCloud found = read_point_cloud(folder.path() / "a.pcd");
  EXPECT_EQ(find_channel(found, kTime), nullptr);
  EXPECT_NE(find_channel(found, kTimeInPacket), nullptr);
  EXPECT_THAT(found.notes, ElementsAre(HasSubstr("restart in every packet")));
  std::vector<std::uint32_t> microseconds;
  for (std::uint32_t i = 0; i < 2000; ++i) microseconds.push_back(50 * i);
  cloud.channels = {make_channel(kTime, microseconds)};
  write_pcd(folder.path() / "a.pcd", cloud);
  const LoadedCloud in_seconds = read_point_cloud(folder.path() / "a.pcd");
  EXPECT_THAT(in_seconds.notes, ElementsAre("The times are assumed to be in microseconds."));
  EXPECT_NEAR(times_s(selected(in_seconds, {1999})).front(), 1999 * 50e-6, 1e-12);
}

}  // namespace
}  // namespace croon
