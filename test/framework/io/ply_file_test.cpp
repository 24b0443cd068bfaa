#include "framework/io/ply_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/whole_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/framework/io/cloud_bytes.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;

/// Two vertices of mixed properties, with lists in them and an element of lists before them.
const char* const kElements =
    "comment made by hand\nobj_info nothing\n"
    "element face 2\nproperty list uchar int vertex_indices\nproperty float area\n"
    "element vertex 2\nproperty uchar red\nproperty double z\nproperty list ushort float normal\n"
    "property int16 x\nproperty float32 y\n"
    "element edge 1\nproperty int from\nend_header\n";
const Points kVertices = {{-3, 2.5f, 1.25f}, {300, -0.5f, 8}};

std::string binary_ply(ByteOrder order) {
  const auto number = [order](char type, std::size_t size, double value) {
    return test::scalar_bytes(type, size, value, order);
  };
  std::string body = number('U', 1, 3) + number('I', 4, 0) + number('I', 4, 1) + number('I', 4, 2) +
                     number('F', 4, 0.5) + number('U', 1, 0) + number('F', 4, 0.0);
  for (const Eigen::Vector3f& vertex : kVertices) {
    body += number('U', 1, 200) + number('F', 8, static_cast<double>(vertex.z())) +
            number('U', 2, 1) + number('F', 4, 9) +
            number('I', 2, static_cast<double>(vertex.x())) +
            number('F', 4, static_cast<double>(vertex.y()));
  }
  const char* const name = order == ByteOrder::little ? "little" : "big";
  return std::string("ply\nformat binary_") + name + "_endian 1.0\n" + kElements + body +
         number('I', 4, 0);
}

TEST(PlyFile, FindsTheVerticesAmongWhateverElseThereIs) {
  const test::TempFolder folder;
  const std::string text = std::string("ply\nformat ascii 1.0\n") + kElements +
                           "3 0 1 2 0.5\n0 0\n\n200 1.25 1 9 -3 2.5\r\n200 8 2 9 9 300 -.5\n0";
  for (const std::string& bytes :
       {text, binary_ply(ByteOrder::little), binary_ply(ByteOrder::big)}) {
    const auto path = folder.write("a.PLY", bytes);
    check_point_cloud_file(path);
    EXPECT_EQ(read_point_cloud(path).points, kVertices) << bytes.substr(0, 40);
  }
}

TEST(PlyFile, ReadsWindowsHeaders) {
  const test::TempFolder folder;
  const std::string header =
      "ply\r\nformat ascii 1.0\r\nelement vertex 1\r\nproperty float x\r\n"
      "property float y\r\nproperty float z\r\nend_header\r\n";
  EXPECT_EQ(read_point_cloud(folder.write("a.ply", header + "1 2 nan\r\n")).dropped_non_finite, 1u);
  EXPECT_EQ(read_point_cloud(folder.write("a.ply", header + "1 2 3\r\n")).points,
            (Points{{1, 2, 3}}));
}

TEST(PlyFile, HasBoolProperties) {
  const test::TempFolder folder;
  const std::string header =
      "element vertex 2\nproperty float X\nproperty float Y\nproperty float Z\n"
      "property bool is_noise\nend_header\n";
  std::string binary = "ply\nformat binary_little_endian 1.0\n" + header;
  for (const double x : {1.0, 2.0}) {
    for (const double value : {x, 5.0, 6.0}) {
      binary += test::scalar_bytes('F', 4, value, ByteOrder::little);
    }
    binary += x == 1.0 ? '\1' : '\0';
  }
  for (const std::string& bytes :
       {binary, "ply\nformat ascii 1.0\n" + header + "1 5 6 1\n2 5 6 0\n"}) {
    const LoadedCloud cloud = read_point_cloud(folder.write("a.ply", bytes));
    EXPECT_EQ(cloud.points, (Points{{1, 5, 6}, {2, 5, 6}}));
    EXPECT_EQ(channel_values(cloud, "is_noise"), (std::vector{1.0, 0.0}));
  }
}

TEST(PlyFile, ReadsWhatWasWritten) {
  Rng rng = test::test_rng();
  const test::TempFolder folder;
  for (const int count : {0, 1, 1000}) {
    const Points cloud = test::random_cloud(rng, count, 100.0);
    for (const PlyFormat format : {PlyFormat::binary_little_endian, PlyFormat::ascii}) {
      write_ply(folder.path() / "a.ply", cloud, format);
      check_point_cloud_file(folder.path() / "a.ply");
      EXPECT_EQ(read_point_cloud(folder.path() / "a.ply").points, cloud);
    }
  }
  EXPECT_NE(test::input_error([&] { write_ply(folder.path() / "no" / "a.ply", {}); }), "");
}

TEST(PlyFile, FusesTheRigInTheReferencesFrame) {
  Rng rng = test::test_rng();
  const test::TempFolder folder;
  const RigidTransform T = test::random_pose(rng, 5.0);
  const Points top = test::random_cloud(rng, 3, 10.0), left = test::random_cloud(rng, 2, 10.0);
  const auto path = folder.path() / "fused.ply";
  write_fused_ply(path, {{"top", top, {}}, {"left\nelement", left, T}});
  Points expected = top;
  for (const Eigen::Vector3f& point : transformed(left, T)) expected.push_back(point);
  EXPECT_EQ(read_point_cloud(path).points, expected);
  const std::string bytes = read_whole_file(path);
  EXPECT_THAT(bytes, HasSubstr("comment left?element is 230 159 0\n"));
  EXPECT_EQ(bytes.substr(bytes.size() - 3), "\xE6\x9F" + std::string(1, '\0'));
  EXPECT_TRUE(is_fused_ply(path));
  write_ply(path, top);
  EXPECT_FALSE(is_fused_ply(path));
  EXPECT_FALSE(is_fused_ply(folder.path() / "none.ply"));
}

TEST(PlyFile, SaysWhatIsWrong) {
  const test::TempFolder folder;
  const std::string start = "ply\nformat ascii 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string good = start + "element vertex 2\n" + xyz + "end_header\n";
  const std::pair<std::string, const char*> cases[] = {
      {"", "line 1: is not a PLY file"},
      {"plyx\n", "found \"plyx\""},
      {start + "element vertex 1\n" + xyz, "ends without end_header"},
      {"ply\nformat ascii 2.0\n", "line 2: expected \"format"},
      {"ply\nformat text 1.0\n", "expected the format ascii"},
      {start + xyz, "expected an element before its properties"},
      {start + "element face 1\n" + xyz + "end_header\n", "the element vertex is missing"},
      {start + "element vertex -1\n", "expected a number of elements"},
      {start + "element vertex 1\nproperty flaot x\n", "did you mean \"float\""},
      {start + "element vertex 1\nproperty list float int x\n", "a list whose length"},
      {start + "element vertex 1\nproperty list uchar float x\nend_header\n",
       "vertex property x is missing"},
      {start + "element vertex 1\n" + xyz + "property int x\nend_header\n1 2 3 4\n",
       "line 7: expected each coordinate once, found \"property int x\""},
      {good.substr(0, good.size() - 11) + "element vertex 3\n",
       "line 7: expected each element once, found \"element vertex 3\""},
      {start + "element vertex 99999999999999\n" + xyz + "end_header\n1 2 3\n",
       "expected 99999999999999"},
      {good + "1 2 3\n4 5 a\n", "line 9: expected a number for z, found \"a\""},
      {good + "1 2 3\n4 5 6 7\n", "line 9: expected the line to end, found \"7\""},
      {good + "1.00000 2.00 3\n", "ends inside the element \"vertex\""},
  };
  for (const auto& [bytes, message] : cases) {
    const auto path = folder.write("a.ply", bytes);
    EXPECT_THAT(test::input_error([&] { read_point_cloud(path); }), HasSubstr(message)) << bytes;
  }
}

}  // namespace
}  // namespace croon
