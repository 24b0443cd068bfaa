#include "framework/calibration/rig_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "framework/calibration/sensor_picture.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

using Names = std::vector<std::string>;

TEST(FileNames, AreSafeAndDiffer) {
  EXPECT_EQ(
      file_names({"top", "/top/points", "a b", "../x", "", "Rig", "TOP", "top points"}, {"rig"}),
      (Names{"top", "top_points", "a_b", "x", "sensor", "Rig_2", "TOP_2", "top_points_2"}));
  EXPECT_LE(file_names({std::string(3000, 'a')}, {}).front().size(), 110U);
}

TEST(PictureNote, HasTheDeviationsOrTheReason) {
  CalibratedSensor sensor;
  sensor.is_accepted = true;
  EXPECT_EQ(picture_note(sensor), "");
  sensor.covariance.emplace().matrix(5, 5) = 0.002 * 0.002;
  EXPECT_EQ(picture_note(sensor), "std: rpy 0.000, 0.000, 0.000°; xyz 0.0, 0.0, 2.0 mm");
  sensor.is_accepted = false;
  sensor.reasons = {"Too little agrees.", "More."};
  EXPECT_EQ(picture_note(sensor), "Too little agrees.");
}

/// The number of pixels of a colour.
long pixels_of(const Image& image, const Colour& colour) {
  return std::count_if(image.pixels().begin(), image.pixels().end(), [&](const Colour& pixel) {
    return pixel.red == colour.red && pixel.green == colour.green && pixel.blue == colour.blue;
  });
}

constexpr Colour kReference = {0, 114, 178}, kSensor = {230, 159, 0}, kBoth = {34, 34, 34};
constexpr Colour kRejected = {213, 94, 0}, kAccepted = {0, 158, 115};

/// A street, seen twice.
class RigPictures : public ::testing::Test {
 protected:
  RigPictures() {
    Rng rng = test_rng(5);
    T_ = pose_near(rng, {}, 10.0, 0.5);
    pair_ = street_pair(rng, 3, T_, 6000, 6000, 0.005);
    level_ = level_frame(pair_.target);
    level_points_ = transformed(pair_.target, level_.T_level_reference);
  }

  Image drawn(const std::optional<RigidTransform>& before,
              const std::optional<RigidTransform>& after, bool is_accepted = true) const {
    return draw_sensor(
        {"top", "left", "", &level_points_, &pair_.source, before, after, is_accepted, level_});
  }

  RigidTransform T_;
  StreetPair pair_;
  LevelFrame level_;
  Points level_points_;
};

TEST_F(RigPictures, AreLevelOverTheGround) {
  Rng rng = test_rng(1);
  EXPECT_TRUE(level_.has_ground);
  for (int i = 0; i < 5; ++i) {
    const RigidTransform T_tilted_target = pose_near(rng, {}, 30.0, 0.0);
    const LevelFrame level = level_frame(transformed(pair_.target, T_tilted_target));
    ASSERT_TRUE(level.has_ground);
    const RigidTransform T = level.T_level_reference * T_tilted_target;
    EXPECT_GT(T.rotation.row(2).dot(level_.T_level_reference.rotation.row(2)), 0.9999);
    EXPECT_NEAR(T.translation.z(), level_.T_level_reference.translation.z(), 0.03);
  }
  EXPECT_FALSE(level_frame({}).has_ground);
}

TEST_F(RigPictures, ShowWhetherThePoseIsRight) {
  const RigidTransform wrong = moved(T_, Vector6d{0.0, 0.0, 0.02, 0.15, 0.15, 0.0});
  EXPECT_GT(pixels_of(drawn({}, T_), kBoth), pixels_of(drawn({}, wrong), kBoth) * 5 / 4);
  EXPECT_GT(pixels_of(drawn({}, T_), kReference), 1000);
  EXPECT_GT(pixels_of(drawn({}, T_), kSensor), 1000);
  EXPECT_GT(drawn(wrong, T_).width(), 3 * drawn({}, T_).width() / 2);
}

TEST_F(RigPictures, ShowTheVerdict) {
  EXPECT_GT(pixels_of(drawn({}, T_), kAccepted), 1000);
  EXPECT_EQ(pixels_of(drawn({}, T_), kRejected), 0);
  EXPECT_GT(pixels_of(drawn({}, T_, false), kRejected), 1000);
  EXPECT_EQ(pixels_of(drawn({}, T_, false), kAccepted), 0);
  EXPECT_GT(pixels_of(drawn(T_, {}, false), kRejected), 1000);
}

TEST_F(RigPictures, AreWrittenWithTheCloudsInTheFrameOfTheReference) {
  const TempFolder folder;
  const Points empty;
  const std::vector<PosedCloud> sensors = {{"/left/points", &pair_.source, {}, T_, true},
                                           {"rig", &pair_.source, T_, T_, false},
                                           {"empty", &empty, {}, T_, false},
                                           {"none", &pair_.source, {}, {}, false}};
  Names pictures;
  for (const RigPicture& picture : draw_rig_pictures("top", pair_.target, sensors)) {
    EXPECT_EQ(picture.png.substr(1, 3), "PNG");
    pictures.push_back(picture.file);
  }
  EXPECT_EQ(pictures, (Names{"left_points.png", "rig_2.png", "empty.png", "rig.png"}));
  const Names written = write_rig_clouds(folder.path(), "top", pair_.target, sensors);
  EXPECT_EQ(written, (Names{"clouds/top.ply", "clouds/top.pcd", "clouds/left_points.ply",
                            "clouds/left_points.pcd", "clouds/rig_2_rejected.ply",
                            "clouds/rig_2_rejected.pcd", "clouds/empty_rejected.ply",
                            "clouds/empty_rejected.pcd", "clouds/fused.ply", "clouds/fused.pcd"}));
  for (const std::string& path : written) {
    EXPECT_TRUE(std::filesystem::is_regular_file(folder.path() / path)) << path;
  }
  const Points expected = transformed(pair_.source, T_);
  EXPECT_EQ(read_point_cloud(folder.path() / "clouds/left_points.pcd").points, expected);
  EXPECT_EQ(read_point_cloud(folder.path() / "clouds/left_points.ply").points, expected);
  // The reference and the accepted sensor.
  const LoadedCloud fused = read_point_cloud(folder.path() / "clouds/fused.pcd");
  EXPECT_EQ(fused.size(), pair_.target.size() + expected.size());
  EXPECT_EQ(channel_values(fused, "sensor").front(), 0.0);
  EXPECT_EQ(channel_values(fused, "sensor").back(), 1.0);
  EXPECT_EQ(read_point_cloud(folder.path() / "clouds/fused.ply").points, fused.points);
}

}  // namespace
}  // namespace croon::test
