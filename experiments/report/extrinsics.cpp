#include <nlohmann/json.hpp>

#include "experiments/report/result_tables.hpp"
#include "framework/base/angles.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {
namespace {

using Json = nlohmann::ordered_json;

/// An element of "extrinsics", without its scenes.
struct Extrinsics {
  const SummaryRow* row;
  std::string reference_sensor;
};

/// The covariance of an agreed pose; no columns if the results have no covariances.
Columns<AgreedPose> agreed_covariance_columns(bool has_covariances) {
  Columns<AgreedPose> columns;
  if (has_covariances) columns.add(covariance_columns("/covariance"), &AgreedPose::covariance);
  return columns;
}

Columns<Extrinsics> extrinsics_columns(bool has_covariances) {
  using E = Extrinsics;
  Columns<E> columns;
  return columns.add({"variant"}, [](const E& e) { return e.row->variant; })
      .add({"sensor"}, [](const E& e) { return e.row->sensor; })
      .add({"reference_sensor"}, [](const E& e) { return nothing_if_empty(e.reference_sensor); })
      .add(agreed_pose_columns(), [](const E& e) { return agreed_pose(*e.row); })
      .add(agreed_covariance_columns(has_covariances),
           [](const E& e) { return agreed_pose(*e.row); });
}

Columns<SceneSummary> scene_columns(bool has_covariances) {
  using S = SceneSummary;
  const auto pose = [](const S& scene) { return agreed_pose(scene); };
  Columns<S> columns;
  return columns.add({"scene"}, &S::scene)
      .add(agreed_pose_columns(), pose)
      .add(agreed_covariance_columns(has_covariances), pose);
}

/// The 4x4 matrix of a pose.
Eigen::Matrix4d homogeneous(const RigidTransform& T) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = T.rotation;
  matrix.topRightCorner<3, 1>() = T.translation;
  return matrix;
}

template <class OfTrials>
AgreedPose agreed_pose_of(const OfTrials& of) {
  AgreedPose agreed{{}, of.outcomes.trials, of.agreeing, {}};
  if (const RigidTransform* pose = agreed_consensus(of)) {
    agreed.pose = *pose;
    agreed.covariance = of.covariance;
  }
  return agreed;
}

/// Whether any scene has a covariance.
bool has_covariance(const Summary& summary) {
  for (const SummaryRow& row : summary.rows) {
    for (const SceneSummary& scene : row.scenes) {
      if (scene.covariance) return true;
    }
  }
  return false;
}

}  // namespace

Columns<RigidTransform> pose_columns(const std::string& path, const std::string& rotation) {
  using Pose = RigidTransform;
  Columns<Pose> columns;
  for (const int i : {0, 1, 2}) {
    columns.add({std::string("t") + "xyz"[i], "m", path + "/translation_m/" + std::to_string(i), 4},
                [i](const Pose& pose) { return pose.translation(i); });
  }
  for (const int i : {0, 1, 2, 3}) {
    columns.add({std::string("q") + "xyzw"[i], "", path + rotation + "/" + std::to_string(i), 6},
                [i](const Pose& pose) { return unit_quaternion(pose.rotation).coeffs()(i); });
  }
  return columns;
}

Columns<AgreedPose> agreed_pose_columns() {
  using A = AgreedPose;
  const std::string path = "/T_reference_sensor";
  Columns<RigidTransform> matrix;
  for (const int i : {0, 1, 2, 3}) {
    for (const int j : {0, 1, 2, 3}) {
      const std::string index = std::to_string(i) + "/" + std::to_string(j);
      matrix.add({"m" + std::to_string(i) + std::to_string(j), "", path + "/matrix/" + index},
                 [=](const RigidTransform& T) { return homogeneous(T)(i, j); });
    }
  }
  Columns<RigidTransform> angles;
  for (const int i : {0, 1, 2}) {
    angles.add(
        {kMeasures[static_cast<std::size_t>(i)].name, "deg",
         path + "/roll_pitch_yaw_deg/" + std::to_string(i), 3},
        [=](const RigidTransform& T) { return deg_from_rad(rpy_from_rotation(T.rotation)(i)); });
  }
  const auto spread = [](double Agreeing::*of) {
    return [=](const A& agreed) {
      return agreed.agreeing.count > 0 ? std::optional<double>(agreed.agreeing.*of) : std::nullopt;
    };
  };
  Columns<A> columns;
  return columns.add(matrix, &A::pose)
      .add(pose_columns(path, "/quaternion_xyzw"), &A::pose)
      .add(angles, &A::pose)
      .add({"trials"}, &A::trials)
      .add({"agreeing"}, [](const A& agreed) { return agreed.agreeing.count; })
      .add({"spread", "deg", "/spread/rotation_deg", 3}, spread(&Agreeing::rotation_deg))
      .add({"spread", "m", "/spread/translation_m", 4}, spread(&Agreeing::translation_m));
}

AgreedPose agreed_pose(const SummaryRow& row) { return agreed_pose_of(row); }

AgreedPose agreed_pose(const SceneSummary& scene) { return agreed_pose_of(scene); }

std::string extrinsics_json(const Summary& summary,
                            const std::map<std::string, std::string>& references) {
  std::vector<Extrinsics> extrinsics;
  const bool has_covariances = has_covariance(summary);
  for (const SummaryRow& row : summary.rows) {
    const auto reference = references.find(row.sensor);
    extrinsics.push_back({&row, reference == references.end() ? "" : reference->second});
  }
  Json json;
  json["method"] =
      "per scene the medoid of the trials' poses, with distances cut off at the bounds, then the "
      "mean of the poses within the bounds of it; over scenes the same of the scenes' poses, each "
      "with as many votes as trials of its scene agree with it; null if no two trials agree "
      "(docs/statistics.md)";
  json["bounds"] = {{"rotation_deg", summary.bounds.rotation_deg},
                    {"translation_m", summary.bounds.translation_m}};
  json["roll_pitch_yaw"] = "R = Rz(yaw) Ry(pitch) Rx(roll)";
  if (has_covariances) {
    json["covariance"] =
        "of the error (roll, pitch, yaw of T_estimate T_truth^-1, t_estimate - t_truth), rad and "
        "m, in the reference's frame; of the pose of all scenes: of the mean of independent scenes "
        "(docs/trust.md)";
  }
  json["extrinsics"] = json_rows(extrinsics_columns(has_covariances).table(extrinsics));
  for (std::size_t i = 0; i < extrinsics.size(); ++i) {
    json["extrinsics"][i]["scenes"] =
        json_rows(scene_columns(has_covariances).table(extrinsics[i].row->scenes));
  }
  return json_bytes(json);
}

}  // namespace croon::experiments
