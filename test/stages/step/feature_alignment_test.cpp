#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/rig_files.hpp"
#include "framework/stage/step.hpp"
#include "test/support/data_root.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

Estimate estimate_of(const Points& target, const Points& source) {
  Estimate estimate;
  estimate.target = std::make_shared<const Cloud>(target, StreamKey(1).with("target"));
  estimate.source = std::make_shared<const Cloud>(source, StreamKey(1).with("source"));
  return estimate;
}

/// The reason that the step gives for not finding a pose; empty if it finds one.
std::string failure_of(const std::string& json, const Points& target, const Points& source) {
  Rng rng = test::test_rng();
  try {
    test::stage<Step>(json)->advance(estimate_of(target, source), rng);
  } catch (const StageError& error) {
    return error.what();
  }
  return "";
}

TEST(FeatureAlignment, FindsThePoseAmongClutterThatOneSensorAloneSees) {
  Rng rng = test::test_rng();
  const auto step = test::stage<Step>(R"({"step": "feature_alignment"})");
  for (std::uint64_t i = 0; i < 2; ++i) {
    test::StreetPair pair =
        test::street_pair(rng, i, test::random_pose(rng, 1.0), 20000, 12000, 0.01);
    const Points clutter = test::random_cloud(rng, 3000, 15.0);
    pair.source.insert(pair.source.end(), clutter.begin(), clutter.end());
    const Estimate found = step->advance(estimate_of(pair.target, pair.source), rng);
    const PoseError error = pose_error(found.T_target_source, pair.T_target_source);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.5) << "street " << i;
    EXPECT_LT(error.translation_m, 0.1) << "street " << i;
  }
}

TEST(FeatureAlignment, SaysHowManyFeaturesAgreeIfTheyAreTooFew) {
  Rng rng = test::test_rng(2);
  const Points street = test::random_street(rng, 1, 4000, 0.01);
  const Points three(3, Eigen::Vector3f(1, 2, -2));
  EXPECT_EQ(failure_of(R"({"step": "feature_alignment"})", street, three),
            "of 0 feature correspondences, at most 0 agree with each other; a pose needs 5");
  const std::string demanding = failure_of(R"({"step": "feature_alignment", "min_clique": 200})",
                                           street, test::random_street(rng, 2, 4000, 0.01));
  EXPECT_NE(demanding.find("agree with each other; a pose needs 200"), std::string::npos)
      << demanding;
}

/// The largest error of the sensors of a scene of the samples.
PoseError worst_of(const std::filesystem::path& scene, const RigPoses& poses) {
  const auto step = test::stage<Step>(R"({"step": "feature_alignment"})");
  const auto crop = test::stage<Preprocessor>(R"({"type": "range_crop", "min_m": 1.0})");
  const Points top = read_point_cloud(scene / "top.pcd").points;
  PoseError worst;
  for (const auto& [sensor, T_top_sensor] : poses) {
    Rng rng = test::test_rng();
    const PointCloud cloud = crop->apply(read_point_cloud(scene / (sensor + ".pcd")));
    const Estimate found = step->advance(estimate_of(top, cloud.points), rng);
    const PoseError error = pose_error(found.T_target_source, T_top_sensor);
    worst.rotation_rad = std::max(worst.rotation_rad, error.rotation_rad);
    worst.translation_m = std::max(worst.translation_m, error.translation_m);
  }
  return worst;
}

TEST(FeatureAlignment, FindsTheSamplesPosesWithNoStart) {
  CROON_SKIP_WITHOUT_DATA();
  const std::filesystem::path root = test::data_root() / "opencalib";
  const PoseError carla =
      worst_of(root / "carla/004069", read_rig_poses(root / "carla/truth.json"));
  EXPECT_LT(deg_from_rad(carla.rotation_rad), 0.5);
  EXPECT_LT(carla.translation_m, 0.3);
  const PoseError real = worst_of(root / "real/0001", read_rig_poses(root / "real/nominal.json"));
  EXPECT_LT(deg_from_rad(real.rotation_rad), 3.0);  // The nominal pose is a drawing's.
  EXPECT_LT(real.translation_m, 0.3);
}

}  // namespace
}  // namespace croon
