#include <algorithm>
#include <cmath>

#include "experiments/report/calibration_document.hpp"
#include "experiments/report/rig_charts.hpp"
#include "experiments/report/rig_view_blocks.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/statistics.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/fit_check.hpp"
#include "framework/calibration/rig_view.hpp"
#include "framework/geometry/dof.hpp"

namespace croon::experiments {
namespace {

std::string verdict_name(bool is_accepted) { return is_accepted ? "accepted" : "rejected"; }

/// Poses with their standard deviations, and their distances from the nominal poses.
TableBlock pose_table(const CalibratedRig& rig) {
  using S = CalibratedSensor;
  Columns<S> columns;
  columns.add({"sensor"}, &S::sensor).add({"verdict"}, [](const S& sensor) {
    return verdict_name(sensor.is_accepted) +
           (is_doubtful(sensor) ? ", contradicted by the clouds" : "");
  });
  View view{{{"sensor"}, {"verdict"}}, 2};
  for (const int dof : {3, 4, 5, 0, 1, 2}) {
    const bool is_angle = is_rotation(static_cast<Dof>(dof));
    const std::string name = kDofNames.at(static_cast<std::size_t>(dof));
    const std::string unit = is_angle ? "deg" : "m", column = name + "_" + unit;
    const int decimals = is_angle ? 3 : 4;
    columns
        .add({name, unit, "", decimals},
             [=](const S& sensor) -> std::optional<double> {
               if (!sensor.T_reference_sensor) return std::nullopt;
               const RigidTransform& T = *sensor.T_reference_sensor;
               return is_angle ? deg_from_rad(rpy_from_rotation(T.rotation)(dof))
                               : T.translation(dof - 3);
             })
        .add({column + "_std", "", "", decimals}, [=](const S& sensor) -> std::optional<double> {
          if (!sensor.covariance) return std::nullopt;
          const double deviation = std::sqrt(sensor.covariance->matrix(dof, dof));
          return is_angle ? deg_from_rad(deviation) : deviation;
        });
    view.columns.push_back({name + ", " + unit, "<" + column + "> ± <" + column + "_std>"});
  }
  const auto from_nominal = [](const S& sensor) -> std::optional<PoseError> {
    if (!sensor.nominal || !sensor.T_reference_sensor) return std::nullopt;
    return pose_error(*sensor.T_reference_sensor, *sensor.nominal);
  };
  const bool has_nominal = std::any_of(rig.sensors.begin(), rig.sensors.end(),
                                       [](const S& sensor) { return !!sensor.nominal; });
  if (has_nominal) {
    columns
        .add({"from_nominal", "deg", "", 2},
             [=](const S& sensor) -> std::optional<double> {
               const auto apart = from_nominal(sensor);
               return apart ? std::optional(deg_from_rad(apart->rotation_rad)) : std::nullopt;
             })
        .add({"from_nominal", "mm", "", 0}, [=](const S& sensor) -> std::optional<double> {
          const auto apart = from_nominal(sensor);
          return apart ? std::optional(1e3 * apart->translation_m) : std::nullopt;
        });
    view.columns.push_back({"from nominal", "<from_nominal_deg> deg, <from_nominal_mm> mm"});
  }
  return {"T_" + rig.reference +
              "_sensor ± one standard deviation; the pose of a rejected sensor is "
              "a guess.",
          columns.table(rig.sensors), view};
}

Section view_section(const RigView& view) {
  Section section{"view", "The clouds", {}};
  section.blocks.emplace_back(cloud_view_block(
      view, "Scene " + view.scene +
                ". Drag to turn, scroll to zoom; move the slider through the steps of the "
                "pipeline. Points of right poses lie on common surfaces. A rival is the best "
                "other pose that the global search found."));
  if (FigureRow row = close_up_row(view); !row.figures.empty()) {
    section.blocks.emplace_back(Paragraph{
        "Places where a misalignment would show, from above. Surfaces of a right pose coincide."});
    section.blocks.emplace_back(std::move(row));
  }
  return section;
}

Section graph_section(const RigView& view) {
  using P = SensorAgreement;
  Columns<P> columns;
  columns.add({"sensor"}, &P::a)
      .add({"other"}, &P::b)
      .add({"overlap", "ratio", "", 0}, &P::overlap_ratio)
      .add({"median_distance", "mm", "", 1},
           [](const P& pair) { return 1e3 * pair.median_distance_m; })
      .add({"points"}, [](const P& pair) { return static_cast<long long>(pair.points); });
  const Table table = columns.table(view.pairs);
  return {"graph",
          "Agreement of the sensors",
          {Paragraph{"Overlap is the share of points with a surface of the other sensor within 0.3 "
                     "m; the distance is the median to that surface, along its normal. Only pairs "
                     "with the reference were registered individually: the other pairs are an "
                     "independent check."},
           Chart{"Overlap and median distance of each pair.", sensor_graph(view)},
           TableBlock{"",
                      table,
                      {{{"sensor"},
                        {"other"},
                        {"overlap, %", "<overlap_ratio>"},
                        {"median distance, mm", "<median_distance_mm>"},
                        {"points"}},
                       2}}}};
}

Section residual_section(const RigView& view) {
  constexpr std::size_t kMinResiduals = 200;
  Section section{
      "residuals",
      "Residuals",
      {Paragraph{"Distances to the nearest surfaces of the other sensors, positive if "
                 "the point lies behind the surface: the median, and a band between the "
                 "quartiles. A right pose and a sound sensor show a flat line at zero. A "
                 "wave over azimuth or a slope over elevation shows a wrong angle of the "
                 "pose or of the lasers; an offset over all ranges a range bias; a slope "
                 "over range a range scale; an increase with incidence the width of the "
                 "beam."}}};
  for (const ViewedSensor& sensor : view.sensors) {
    const std::string role = sensor.is_reference ? "reference" : verdict_name(sensor.is_accepted);
    if (sensor.residuals.size() < kMinResiduals) {
      section.blocks.emplace_back(
          Paragraph{sensor.sensor + ": too few points have a surface of another sensor nearby."});
      continue;
    }
    std::vector<double> distances_mm;
    for (const Residual& residual : sensor.residuals) {
      distances_mm.push_back(1e3 * std::abs(residual.distance_m));
    }
    section.blocks.emplace_back(Chart{sensor.sensor + " (" + role + "): median distance " +
                                          fixed_number(median(distances_mm), 1) + " mm, " +
                                          counted(distances_mm.size(), "point"),
                                      residual_chart(sensor)});
  }
  return section;
}

/// A row of the table over scenes.
struct ScenePoseRow {
  std::string sensor, scene, verdict;
  std::optional<double> apart_deg, apart_mm;
};

/// The pose from each single scene, relative to the common pose.
Section scene_section(const CalibratedRig& rig) {
  std::vector<ScenePoseRow> rows;
  for (const CalibratedSensor& sensor : rig.sensors) {
    for (const SceneEstimate& scene : sensor.scenes) {
      ScenePoseRow row{
          sensor.sensor, scene.scene, scene.reason.empty() ? "accepted" : scene.reason, {}, {}};
      if (scene.T_reference_sensor && sensor.T_reference_sensor) {
        const PoseError apart = pose_error(*scene.T_reference_sensor, *sensor.T_reference_sensor);
        row.apart_deg = deg_from_rad(apart.rotation_rad);
        row.apart_mm = 1e3 * apart.translation_m;
      }
      rows.push_back(std::move(row));
    }
  }
  Columns<ScenePoseRow> columns;
  columns.add({"sensor"}, &ScenePoseRow::sensor)
      .add({"scene"}, &ScenePoseRow::scene)
      .add({"from_pose", "deg", "", 3}, &ScenePoseRow::apart_deg)
      .add({"from_pose", "mm", "", 1}, &ScenePoseRow::apart_mm)
      .add({"verdict"}, &ScenePoseRow::verdict);
  const Table table = columns.table(rows);
  View view{{{"sensor"},
             {"scene"},
             {"verdict"},
             {"from the common pose, deg", "<from_pose_deg>"},
             {"from the common pose, mm", "<from_pose_mm>"}},
            3};
  return {"scenes",
          "Consistency over scenes",
          {Paragraph{"The pose from each scene alone, relative to the common pose."},
           TableBlock{"", table, view}}};
}

Section picture_section(const std::vector<RigPicture>& pictures) {
  Section section{"pictures", "Pictures", {}};
  for (const RigPicture& picture : pictures) {
    const std::string what = picture.sensor.empty() ? "The rig" : picture.sensor;
    section.blocks.emplace_back(Picture{what, what + ", from above and in sections", picture.png});
  }
  return section;
}

}  // namespace

Document calibration_report(const CalibratedRig& rig, const std::vector<RigPicture>& pictures,
                            const Facts& provenance) {
  const RigView view = rig_view(rig);
  Document document{
      "Calibration of " + counted(rig.sensors.size(), "sensor") + " to " + rig.reference,
      accepted_sentence(rig) + ".",
      {verdict_section(rig)}};
  document.sections.front().blocks.emplace_back(pose_table(rig));
  if (view.sensors.size() > 1) {
    document.sections.push_back(view_section(view));
    if (!view.pairs.empty()) document.sections.push_back(graph_section(view));
    document.sections.push_back(residual_section(view));
  }
  const bool has_scenes =
      std::any_of(rig.sensors.begin(), rig.sensors.end(),
                  [](const CalibratedSensor& sensor) { return sensor.scenes.size() > 1; });
  if (has_scenes) document.sections.push_back(scene_section(rig));
  if (!pictures.empty()) document.sections.push_back(picture_section(pictures));
  document.sections.push_back({"provenance", "Provenance", {provenance}});
  return document;
}

}  // namespace croon::experiments
