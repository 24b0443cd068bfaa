// Files without a binary header: text, and rows of floats; and what a NumPy header may not say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/io/point_cloud_file.hpp"
#include "test/framework/io/cloud_bytes.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;

TEST(TextCloud, SaysWhichLineIsWrong) {
  const test::TempFolder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"", "expected lines of numbers x, y, z, found none"},
      {"# nothing\n", "found none"},
      {"time,velocity\n1,2\n", "line 1: expected numbers, or a header that names x, y and z"},
      {"x,y\n1,2\n", "line 1: expected numbers, or a header"},
      {"1 2\n", "line 1: expected 3 to 7 numbers x, y, z"},
      {"1 0 0 0 0 1 0 0 0 0 1 0\n", "line 1: expected 3 to 7 numbers x, y, z"},
      {"1 2 3\n\n1 2 3 4\n", "line 3: expected 3 numbers, found 4"},
      {"x,y,z\n1,2,3\n1,2,three\n", "line 3: expected a number for \"z\", found \"three\""},
      {"x;y;z\n1,5;2,5;3\n", "line 2: expected numbers"},
      {"1;2;3\n1,5;2,5;3\n", "found \"1,5\"; write numbers with a decimal point"},
      {"5\n1 2 3\n1 2 3\n", "expected 5 points, found 2"},
      {"x,y,z,label\n1,2,3,car\n", "line 2: expected numbers"},
  };
  for (const auto& [text, message] : cases) {
    const auto path = folder.write("a.csv", text);
    EXPECT_THAT(test::input_error([&] { read_point_cloud(path); }), HasSubstr(message)) << text;
  }
}

TEST(TextCloud, AcceptsWhatProgramsWrite) {
  const test::TempFolder folder;
  const Points expected = {{1, 2, 3}, {4, 5, 6}};
  for (const char* text : {
           "1 2 3\n4 5 6",
           "  1\t 2  3 \r\n4 5 6\r\n\r\n",
           "2\n1 2 3\n4 5 6\n",
           "1, 2, 3,\n4, 5, 6,\n",
           "//X Y Z\n1 2 3\n4 5 6\n",
           "\"Points:0\",\"Points:1\",\"Points:2\"\n1,2,3\n4,5,6\n",
           "z,Y,x\n3,2,1\n6,5,4\n",
           "Points_m_XYZ:0,X,Y,Z\n9,1,2,3\n9,4,5,6\n",
           "x_m y_m z_m\n1 2 3\n# a comment\n4 5 6\n",
           "% MATLAB\n1e0 +2 3.0\n4 5 6\n",
       }) {
    const auto path = folder.write("a.txt", text);
    EXPECT_EQ(test::input_error([&] { check_point_cloud_file(path); }), "") << text;
    EXPECT_EQ(read_point_cloud(path).points, expected) << text;
  }
  EXPECT_EQ(check_point_cloud_file(folder.write("a.xyz", "1 2 3 255 0 7\n")),
            (std::vector<std::string>{"column_4", "column_5", "column_6"}));
}

/// Rows of `columns` floats: a scan, and whole numbers from the fifth column on.
std::string scan_rows(Rng& rng, int points, std::size_t columns) {
  std::string rows;
  for (const Eigen::Vector3f& point : test::random_cloud(rng, points, 60.0)) {
    for (std::size_t c = 0; c < columns; ++c) {
      const double value = c < 2    ? static_cast<double>(point(static_cast<int>(c)))
                           : c == 2 ? 0.05 * static_cast<double>(point.z()) - 1.5
                           : c == 3 ? 0.01 * static_cast<double>(rng.below(100))
                                    : static_cast<double>(rng.below(32));
      rows += test::scalar_bytes('F', 4, value, ByteOrder::little);
    }
  }
  return rows;
}

TEST(FloatRows, AreNeverReadWithAnotherNumberOfColumns) {
  const test::TempFolder folder;
  Rng rng = test::test_rng();
  int read = 0;
  for (const int points : {20, 40, 60, 120, 420, 840}) {
    for (std::size_t columns = 3; columns <= 8; ++columns) {
      const auto path = folder.write("a.bin", scan_rows(rng, points, columns));
      LoadedCloud cloud;
      const std::string error = test::input_error([&] { cloud = read_point_cloud(path); });
      EXPECT_EQ(test::input_error([&] { check_point_cloud_file(path); }), error);
      if (error.empty()) {
        ++read;
        EXPECT_EQ(cloud.channels.size(), columns - 3) << points << " points of " << columns;
      } else {
        EXPECT_THAT(error, HasSubstr("specify their number (columns), rename nuScenes files"));
      }
      EXPECT_TRUE(error.empty() || points < 400) << columns << error;
      EXPECT_EQ(read_point_cloud(path, {columns}).size(), static_cast<std::size_t>(points));
    }
  }
  EXPECT_GT(read, 20);
}

TEST(FloatRows, OfAnotherTypeOrSizeAreRefused) {
  const test::TempFolder folder;
  Rng rng = test::test_rng();
  std::string doubles;
  for (int i = 0; i < 400; ++i) {
    doubles += test::scalar_bytes('F', 8, 1.0 + 0.01 * rng.uniform(0.0, 1.0), ByteOrder::little);
  }
  const auto error = [&](const std::string& bytes, std::size_t columns) {
    const auto path = folder.write("a.bin", bytes);
    return test::input_error([&] { check_point_cloud_file(path, {columns}); });
  };
  EXPECT_THAT(error(doubles, 0),
              testing::AnyOf(HasSubstr("beyond 1 km"), HasSubstr("cannot distinguish")));
  EXPECT_THAT(error(std::string(17, '\0'), 0), HasSubstr("found 17 bytes"));
  EXPECT_THAT(error(std::string(44, '\0'), 0), HasSubstr("expected rows of 4 or 5 floats"));
  EXPECT_THAT(error(std::string(44, '\0'), 5), HasSubstr("expected rows of 5 floats"));
  EXPECT_THAT(error(std::string(44, '\0'), 11), HasSubstr("expected rows of 3 to 8 floats"));
  EXPECT_EQ(error("", 0), "");
}

/// A NumPy file with this header.
std::string npy(const std::string& header, const std::string& body) {
  return "\x93NUMPY" + std::string("\1\0", 2) +
         test::scalar_bytes('U', 2, static_cast<double>(header.size()), ByteOrder::little) +
         header + body;
}

TEST(NpyFile, SaysWhatIsWrong) {
  const test::TempFolder folder;
  const std::string xyz = "[('x', '<f4'), ('y', '<f4'), ('z', '<f4')";
  const auto header = [](const std::string& descr, const std::string& shape) {
    return "{'descr': " + descr + ", 'fortran_order': False, 'shape': " + shape + ", }\n";
  };
  const std::pair<std::string, const char*> cases[] = {
      {"\x93NUMPY", "is not a NumPy array"},
      {npy("    ", ""), "expected the header of a NumPy array, found \"    \""},
      {npy("{'descr': '<f4'}", ""), "the header has no fortran_order"},
      {npy("{'descr': __import__('os')}", ""), "expected the header of a NumPy array"},
      {npy(header("'<f4'", "(3,)"), ""), "found the shape (3)"},
      {npy(header("'<f4'", "(5, 2)"), ""), "found the shape (5×2)"},
      {npy(header("'<c8'", "(5, 3)"), ""), "found the type \"<c8\""},
      {npy(header("'|O'", "(5, 3)"), ""), "found the type \"|O\""},
      {npy(header("'<f4'", "(2, 3)"), "1234"), "expected 2 points of 24 bytes, found 4 bytes"},
      {npy(header("'<f4'", "(99999999999999999999, 3)"), ""), "expected a whole number"},
      {npy(header("'<f8'", "(999999999999999999, 3)"), ""), "implausibly large"},
      {npy(header("[('x', '<f4'), ('y', '<f4')]", "(2,)"), ""), "no field z"},
      {npy(header(xyz + ", ('n', '<f4', (3, 99999999))]", "(2,)"), ""), "implausibly large"},
  };
  for (const auto& [bytes, message] : cases) {
    const auto path = folder.write("a.npy", bytes);
    EXPECT_THAT(test::input_error([&] { read_point_cloud(path); }), HasSubstr(message));
    EXPECT_THAT(test::input_error([&] { check_point_cloud_file(path); }), HasSubstr(message));
  }
  const std::string floats = test::scalar_bytes('F', 4, 1.0, ByteOrder::little) +
                             test::scalar_bytes('F', 4, 2.0, ByteOrder::little) +
                             test::scalar_bytes('F', 4, 3.0, ByteOrder::little);
  const LoadedCloud cloud = read_point_cloud(folder.write(
      "a.npy", npy(header(xyz + ", ('', '|V2'), ('n', '|u1', (2,))]", "(1L,)"), floats + "??ab")));
  EXPECT_EQ(cloud.points, (Points{{1, 2, 3}}));
  ASSERT_EQ(cloud.channels.size(), 1U);
  EXPECT_EQ(cloud.channels[0].bytes, "ab");
}

}  // namespace
}  // namespace croon
