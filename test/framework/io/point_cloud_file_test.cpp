#include "framework/io/point_cloud_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/whole_file.hpp"
#include "framework/io/ply_file.hpp"
#include "test/framework/io/cloud_bytes.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;

TEST(PointCloudFile, GoesByTheSuffixInAnyCase) {
  const test::TempFolder folder;
  const Points cloud = {{1, 2, 3}};
  EXPECT_EQ(read_point_cloud(folder.write("a.PCD", test::pcd_bytes({}, cloud))).points, cloud);
  for (const char* name : {"a.abc", "a", "pcd"}) {
    const auto path = folder.write(name, "x");
    EXPECT_THAT(test::input_error([&] { read_point_cloud(path); }), HasSubstr(".pcd, .ply, .bin"));
    EXPECT_THAT(test::input_error([&] { check_point_cloud_file(path); }), HasSubstr(path.string()));
  }
}

TEST(PointCloudFile, NeedsAFile) {
  const test::TempFolder folder;
  std::filesystem::create_directory(folder.path() / "folder.pcd");
  for (const char* name : {"none.pcd", "none.ply", "none.bin", "folder.pcd"}) {
    const auto path = folder.path() / name;
    EXPECT_THAT(test::input_error([&] { check_point_cloud_file(path); }), HasSubstr(path.string()));
    EXPECT_THAT(test::input_error([&] { read_point_cloud(path); }), HasSubstr(path.string()));
  }
}

TEST(KittiFile, IsRecordsOfFourFloats) {
  Rng rng = test::test_rng();
  const test::TempFolder folder;
  const Points cloud = test::random_cloud(rng, 20, 100.0);
  std::string bytes;
  for (const Eigen::Vector3f& p : cloud) {
    for (const float value : {p.x(), p.y(), p.z(), 0.5f}) {
      bytes += test::scalar_bytes('F', 4, static_cast<double>(value), ByteOrder::little);
    }
  }
  const auto path = folder.write("a.bin", bytes);
  check_point_cloud_file(path);
  EXPECT_EQ(read_point_cloud(path).points, cloud);
  const auto cut = folder.write("b.bin", bytes.substr(1));
  EXPECT_THAT(test::input_error([&] { check_point_cloud_file(cut); }),
              HasSubstr("rows of 4 or 5 floats"));
  EXPECT_THAT(test::input_error([&] { read_point_cloud(cut); }),
              HasSubstr("rows of 4 or 5 floats"));
}

/// A valid file of each kind, by suffix.
std::vector<std::pair<std::string, std::string>> valid_files(Rng& rng,
                                                             const test::TempFolder& folder) {
  const Points cloud = test::random_cloud(rng, 12, 100.0);
  std::vector<std::pair<std::string, std::string>> files;
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    test::PcdSpec spec;
    spec.fields.push_back({"extra", 'U', 2, 3});
    spec.data = data;
    files.push_back({".pcd", test::pcd_bytes(spec, cloud)});
  }
  write_ply(folder.path() / "valid.ply", cloud);
  files.push_back({".ply", read_whole_file(folder.path() / "valid.ply")});
  const std::string lists =
      "element face 3\nproperty list int uint8 v\nelement vertex 2\nproperty list char double n\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n";
  files.push_back(
      {".ply", "ply\nformat ascii 1.0\n" + lists + "1 1\n0\n2 3 4\n0 1 2 3\n1 9 1 2 3\n"});
  files.push_back(
      {".ply", "ply\nformat binary_big_endian 1.0\n" + lists + std::string(12 + 2 * 13, '\0')});
  files.push_back({".bin", std::string(64, '\1')});
  files.push_back({".xyz", "# a comment\n1 2 3 4\n5 6 7 8\n"});
  files.push_back({".csv", "x,y,z,ring\n1,2,3,4\n5,6,7,8\n"});
  const std::string array =
      "{'descr': [('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('n', '|u1', (2,))],"
      " 'fortran_order': False, 'shape': (2,)}";
  files.push_back({".npy", std::string("\x93NUMPY\1\0", 8) + static_cast<char>(array.size()) +
                               std::string(1, '\0') + array + std::string(28, '\1')});
  return files;
}

std::string damaged(std::string bytes, Rng& rng) {
  if (rng.below(3) == 0) bytes.resize(rng.below(bytes.size() + 1));
  for (std::uint64_t flips = rng.below(4); flips > 0 && !bytes.empty(); --flips) {
    char& byte = bytes[rng.below(bytes.size())];
    // Digits for digits half of the time: those damages get past the first checks.
    byte = byte >= '0' && byte <= '9' && rng.below(2) == 0 ? static_cast<char>('0' + rng.below(10))
                                                           : static_cast<char>(rng.below(256));
  }
  return bytes;
}

TEST(PointCloudFile, ADamagedFileIsReadOrRefused) {
  Rng rng = test::test_rng();
  const test::TempFolder folder;
  int read = 0, refused = 0;
  for (const auto& [suffix, bytes] : valid_files(rng, folder)) {
    for (int i = 0; i < 300; ++i) {
      const auto path = folder.write("fuzz" + suffix, damaged(bytes, rng));
      const bool is_wrong = !test::input_error([&] { check_point_cloud_file(path); }).empty();
      LoadedCloud cloud;
      const bool is_refused = !test::input_error([&] { cloud = read_point_cloud(path); }).empty();
      EXPECT_TRUE(is_refused || !is_wrong) << "the check refuses what can be read";
      for (const Eigen::Vector3f& point : cloud.points) EXPECT_TRUE(point.allFinite());
      (is_refused ? refused : read) += 1;
    }
  }
  EXPECT_GT(read, 300);
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace croon
