#include "framework/io/pcd_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "framework/io/point_cloud_file.hpp"
#include "test/framework/io/cloud_bytes.hpp"
#include "test/support/data_root.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using test::FieldSpec;
using test::PcdSpec;
using ::testing::HasSubstr;

/// Whole numbers that every type of a PCD file can hold.
Points small_numbers(Rng& rng, int count) {
  Points cloud;
  for (int i = 0; i < count; ++i) {
    cloud.push_back({static_cast<float>(rng.below(128)), static_cast<float>(rng.below(128)),
                     static_cast<float>(rng.below(128))});
  }
  return cloud;
}

FieldSpec random_field(Rng& rng, const std::string& name) {
  const char type = "FIU"[rng.below(3)];
  const std::size_t sizes[] = {4, 8, 1, 2};
  return {name, type, sizes[rng.below(type == 'F' ? 2 : 4)], 1};
}

PcdSpec random_spec(Rng& rng) {
  PcdSpec spec;
  spec.fields.clear();
  for (const char* name : {"x", "y", "z"}) spec.fields.push_back(random_field(rng, name));
  for (std::uint64_t i = rng.below(3); i > 0; --i) {
    spec.fields.push_back(random_field(rng, "extra" + std::to_string(i)));
    spec.fields.back().count = rng.below(4);
  }
  for (std::size_t i = spec.fields.size() - 1; i > 0; --i) {
    std::swap(spec.fields[i], spec.fields[rng.below(i + 1)]);
  }
  const char* const versions[] = {".5", ".6", ".7", "0.7"};
  spec.version = versions[rng.below(4)];
  if (rng.below(2) == 0) spec.line_end = "\r\n";
  return spec;
}

TEST(PcdFile, ReadsEveryEncodingOfEveryOrderAndType) {
  Rng rng = test::test_rng();
  const test::TempFolder folder;
  for (int i = 0; i < 200; ++i) {
    PcdSpec spec = random_spec(rng);
    const Points cloud = small_numbers(rng, static_cast<int>(rng.below(40)));
    for (const char* data : {"ascii", "binary", "binary_compressed"}) {
      spec.data = data;
      const auto path = folder.write("a.pcd", test::pcd_bytes(spec, cloud));
      ASSERT_EQ(test::input_error([&] { check_point_cloud_file(path); }), "")
          << test::pcd_header(spec, 0);
      const LoadedCloud loaded = read_point_cloud(path);
      EXPECT_EQ(loaded.points, cloud) << test::pcd_header(spec, cloud.size());
      EXPECT_EQ(loaded.dropped_non_finite, 0u);
    }
  }
}

TEST(PcdFile, KeepsEveryBitOfAFloat) {
  Rng rng = test::test_rng();
  const test::TempFolder folder;
  const Points cloud = test::random_cloud(rng, 500, 100.0);
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    PcdSpec spec;
    spec.data = data;
    EXPECT_EQ(read_point_cloud(folder.write("a.pcd", test::pcd_bytes(spec, cloud))).points, cloud)
        << data;
  }
}

TEST(PcdFile, DropsAndCountsWhatIsNotFinite) {
  const test::TempFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const Points cloud = {{1, 2, 3}, {nan, 2, 3}, {1, -inf, 3}, {4, 5, 6}, {1, 2, inf}};
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    PcdSpec spec;
    spec.data = data;
    const LoadedCloud loaded =
        read_point_cloud(folder.write("a.pcd", test::pcd_bytes(spec, cloud)));
    EXPECT_EQ(loaded.points, (Points{{1, 2, 3}, {4, 5, 6}})) << data;
    EXPECT_EQ(loaded.dropped_non_finite, 3u) << data;
  }
}

TEST(PcdFile, AcceptsCapitalsAndAnImageOfNoSize) {
  const test::TempFolder folder;
  const std::string header =
      "VERSION 0.7\nFIELDS X Y Z INTENSITY\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
      "WIDTH 0\nHEIGHT 0\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n";
  const auto path = folder.write("a.pcd", header + "1 2 3 4\n5 6 7 8\n");
  EXPECT_EQ(check_point_cloud_file(path), std::vector<std::string>{kIntensity});
  const LoadedCloud cloud = read_point_cloud(path);
  EXPECT_EQ(cloud.points, (Points{{1, 2, 3}, {5, 6, 7}}));
  EXPECT_EQ(channel_values(cloud, kIntensity), (std::vector{4.0, 8.0}));
  EXPECT_TRUE(cloud.notes.empty());
}

TEST(PcdFile, MentionsAViewpointOtherThanTheIdentity) {
  const test::TempFolder folder;
  const Points cloud = {{1, 2, 3}};
  EXPECT_THAT(read_point_cloud(folder.write("a.pcd", test::pcd_bytes({}, cloud))).notes,
              ::testing::ElementsAre("The viewpoint \"1 2 3 0 1 0 0\" is not applied: the points "
                                     "are used as they are stored."));
}

TEST(PcdFile, SaysWhichLineOfTextIsWrong) {
  const test::TempFolder folder;
  PcdSpec spec;
  spec.data = "ascii";
  const auto error = [&](const std::string& body) {
    const auto path = folder.write("a.pcd", test::pcd_header(spec, 2) + body);
    return test::input_error([&] { read_point_cloud(path); });
  };
  EXPECT_EQ(error("1 2 3\n\n+4 5e0 -6"), "");
  EXPECT_THAT(error("1 2 3\n1 2,5 3\n"),
              HasSubstr("a.pcd: line 13: expected a number for y, found \"2,5\""));
  EXPECT_THAT(error("1 2 3\n1 2\n4 5\n"), HasSubstr("line 13: expected 3 numbers, found 2"));
  EXPECT_THAT(error("1 2 3\n1 2 3\n1 2 3\n"), HasSubstr("line 14: expected 2 points, found more"));
  EXPECT_THAT(error("1.000000000 2 3\n"), HasSubstr("expected 2 points, found 1"));
}

/// A good header with one line of it replaced.
std::string header_with(const std::string& keyword, const std::string& line) {
  std::string text = test::pcd_header(PcdSpec{}, 10);
  const std::size_t start = text.find("\n" + keyword) + 1;
  return text.replace(start, text.find('\n', start) + 1 - start, line);
}

struct WrongHeader {
  const char* keyword;
  const char* line;
  const char* message;
};

TEST(PcdFile, SaysWhatIsWrongWithAHeader) {
  const test::TempFolder folder;
  const WrongHeader cases[] = {
      {"VERSION", "VERSION 0.8\n", "expected version"},
      {"VERSION", "COLOUR red\n", "line 2: is not a PCD file"},
      {"HEIGHT", "HIGHT 1\n", "did you mean \"HEIGHT\""},
      {"FIELDS", "", "no line FIELDS"},
      {"FIELDS", "FIELDS x y\n", "line 4: expected SIZE of 2 fields, found 3"},
      {"FIELDS", "FIELDS x y intensity\n", "line 3: the field z is missing"},
      {"FIELDS", "FIELDS x y x\n", "duplicate field x"},
      {"FIELDS", "FIELDS x y z\nFIELDS x y z\n", "line 4: the header has a duplicate line FIELDS"},
      {"TYPE", "TYPE F F\n", "line 5: expected TYPE of 3 fields, found 2"},
      {"TYPE", "TYPE F F Q\n", "found \"Q\" of 4"},
      {"SIZE", "SIZE 4 4 2\n", "found \"F\" of 2"},
      {"SIZE", "SIZE 4 4 -4\n", "found \"-4\""},
      {"COUNT", "COUNT 1 1\n", "line 6: expected COUNT of 3 fields, found 2"},
      {"COUNT", "COUNT 1 1 2\n", "expected one number in the field z"},
      {"COUNT", "COUNT 1 1 99999999999\n", "cannot have"},
      {"WIDTH", "WIDTH -10\n", "line 7: expected a number of at least 0, found \"-10\""},
      {"WIDTH", "WIDTH 18446744073709551615\n", "implausibly large"},
      {"HEIGHT", "HEIGHT 2\n", "expected POINTS to be WIDTH times HEIGHT, 20, found 10"},
      {"POINTS", "POINTS 11\n", "line 10: expected POINTS to be WIDTH times HEIGHT, 10, found 11"},
      {"DATA", "DATA zip\n", "expected DATA ascii, binary or binary_compressed, found \"zip\""},
      {"DATA", "#", "ends without a line DATA"},
      {"DATA", "DATA binary\n", "expected 10 points of 12 bytes, found 119 bytes after the header"},
      {"DATA", "DATA ascii\n", "expected 10 points"},
  };
  for (const WrongHeader& wrong : cases) {
    const std::string body(std::string(wrong.line) == "DATA ascii\n" ? 58 : 119, '\0');
    const auto path = folder.write("a.pcd", header_with(wrong.keyword, wrong.line) + body);
    const std::string error = test::input_error([&] { check_point_cloud_file(path); });
    EXPECT_THAT(error, HasSubstr(wrong.message)) << wrong.line;
    EXPECT_THAT(error, HasSubstr(path.string())) << wrong.line;
    EXPECT_NE(test::input_error([&] { read_point_cloud(path); }), "") << wrong.line;
  }
}

TEST(PcdFile, BelievesNoSizeThatTheFileCannotHold) {
  const test::TempFolder folder;
  const auto error = [&](const std::string& data, const std::string& body) {
    PcdSpec spec;
    spec.data = data;
    // 12 terabytes, if it were true.
    const auto path = folder.write("a.pcd", test::pcd_header(spec, 1000000000000) + body);
    const std::string checked = test::input_error([&] { check_point_cloud_file(path); });
    EXPECT_EQ(test::input_error([&] { read_point_cloud(path); }), checked);
    return checked;
  };
  const auto sizes = [](double compressed, double uncompressed) {
    return test::scalar_bytes('U', 4, compressed, ByteOrder::little) +
           test::scalar_bytes('U', 4, uncompressed, ByteOrder::little);
  };
  EXPECT_THAT(error("ascii", "1 2 3\n"), HasSubstr("expected 1000000000000 points"));
  EXPECT_THAT(error("binary", std::string(1000, 'x')), HasSubstr("found 1000 bytes"));
  EXPECT_THAT(error("binary_compressed", "1234"), HasSubstr("found 4 bytes"));
  EXPECT_THAT(error("binary_compressed", sizes(5, 60) + "1234"),
              HasSubstr("expected 5 compressed bytes, found 4"));
  EXPECT_THAT(error("binary_compressed", sizes(4, 4e9) + "1234"),
              HasSubstr("cannot contain 4000000000"));
  EXPECT_THAT(error("binary_compressed", sizes(4, 300) + "1234"),
              HasSubstr("found 300 uncompressed bytes"));
}

TEST(PcdFile, ReadsTheAuthorsSamplesToTheLastPoint) {
  CROON_SKIP_WITHOUT_DATA();
  const std::filesystem::path root = test::data_root() / "opencalib";
  const std::pair<const char*, std::size_t> samples[] = {{"carla/004069/top.pcd", 89021},
                                                         {"carla/004553/back.pcd", 19813},
                                                         {"real/0001/top.pcd", 92677},
                                                         {"real/0001/left.pcd", 8572},
                                                         {"real/0002/right.pcd", 9487}};
  for (const auto& [name, points] : samples) {
    check_point_cloud_file(root / name);
    const LoadedCloud cloud = read_point_cloud(root / name);
    EXPECT_EQ(cloud.points.size() + cloud.dropped_non_finite, points) << name;
    for (const Eigen::Vector3f& point : cloud.points) ASSERT_LT(point.norm(), 1000.0f) << name;
  }
}

}  // namespace
}  // namespace croon
