#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/report/calibration_document.hpp"
#include "experiments/report/rig_charts.hpp"
#include "framework/base/angles.hpp"
#include "framework/calibration/fit_check.hpp"
#include "framework/calibration/rig_view.hpp"
#include "framework/document/renderers.hpp"
#include "framework/geometry/dof.hpp"
#include "test/experiments/support/readable.hpp"
#include "test/experiments/support/report_parts.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

const RigidTransform kTopLeft = {rotation_from_rpy({0.1, 0.0, 1.2}), {0.5, 0.6, -0.2}};

/// A sensor and its pose along the pipeline.
void add_sensor(CalibratedRig& rig, const std::string& name, const Points& points,
                const RigidTransform& T, bool is_accepted) {
  CalibratedSensor& sensor = rig.sensors.emplace_back();
  sensor.sensor = name;
  sensor.is_accepted = is_accepted;
  sensor.T_reference_sensor = sensor.nominal = T;
  sensor.covariance.emplace();
  sensor.covariance->matrix = 1e-6 * Matrix6d::Identity();
  if (!is_accepted) sensor.reasons = {"Two poses fit."};
  sensor.scenes = {{"0", T, std::nullopt, ""}, {"1", std::nullopt, std::nullopt, "icp: no plane"}};
  rig.shown.sensors.push_back({name,
                               std::make_shared<const Cloud>(points, StreamKey(1)),
                               {{"coarse", kTopLeft}, {"icp", T}},
                               RigidTransform()});
}

/// A street in which "left" was accepted, at a pose wrong by `offset`, and "right" rejected.
CalibratedRig street_rig(const Vector6d& offset = Vector6d::Zero(),
                         const std::string& left = "left") {
  Rng rng = test::test_rng();
  const test::StreetPair pair = test::street_pair(rng, 1, kTopLeft, 15000, 10000, 0.01);
  CalibratedRig rig;
  rig.reference = "top";
  rig.composition = "best";
  rig.shown = {"0", std::make_shared<const Cloud>(pair.target, StreamKey(1)), {}};
  add_sensor(rig, left, pair.source, moved(kTopLeft, offset), true);
  add_sensor(rig, "right", pair.source, kTopLeft, false);
  set_refits(rig);
  return rig;
}

Document report_of_rig(const CalibratedRig& rig) {
  return calibration_report(rig, {{"left.png", "left", "png"}}, {{{"version", "0.1"}}});
}

/// The cards of the verdicts.
std::vector<Card> cards_of(const Document& report) {
  for (const Block& block : report.sections.front().blocks) {
    if (const auto* cards = std::get_if<Cards>(&block)) return cards->cards;
  }
  return {};
}

TEST(CalibrationReport, IsSoundAndHasItsSections) {
  const Document report = report_of_rig(street_rig());
  test::expect_sound_page(report);
  EXPECT_THAT(test::section_ids(report),
              IsSupersetOf({"view", "graph", "residuals", "scenes", "pictures", "provenance"}));
  EXPECT_EQ(report.lead, "1 of 2 sensors accepted.");
  const std::vector<Card> cards = cards_of(report);
  ASSERT_EQ(cards.size(), 2U);
  EXPECT_EQ(cards[0].tone, Tone::accepted);
  EXPECT_THAT(cards[0].lines, Contains(HasSubstr("Fit check: ")));
  EXPECT_EQ(cards[1].tone, Tone::rejected);
}

TEST(CalibrationReport, WarnsOfAPoseThatTheCloudsContradict) {
  Vector6d wrong = Vector6d::Zero();
  wrong(2) = rad_from_deg(0.3);
  wrong(4) = 0.05;
  const Document report = report_of_rig(street_rig(wrong));
  EXPECT_EQ(report.lead, "1 of 2 sensors accepted, but the clouds contradict the pose of left.");
  const Card card = cards_of(report).front();
  EXPECT_EQ(card.tone, Tone::warning);
  EXPECT_THAT(card.status, HasSubstr("contradicted by the clouds"));
  EXPECT_THAT(card.lines, Contains(HasSubstr("The clouds contradict this pose")));
  const std::string text = calibration_text(street_rig(wrong), false);
  EXPECT_THAT(text, HasSubstr("but the clouds contradict the pose of left"));
  EXPECT_THAT(text, HasSubstr("WARNING   left"));
}

TEST(CalibrationReport, WithoutCloudsHasNoView) {
  CalibratedRig rig = street_rig();
  rig.shown = {};
  rig.sensors[0].T_reference_sensor.reset();
  rig.sensors[0].covariance.reset();
  for (CalibratedSensor& sensor : rig.sensors) sensor.scenes.clear();
  const Document report = calibration_report(rig, {}, {});
  test::expect_sound_page(report);
  EXPECT_THAT(test::section_ids(report), Not(Contains("view")));
  EXPECT_THAT(test::section_ids(report), Not(Contains("scenes")));
}

TEST(CalibrationReport, EscapesHostileNames) {
  for (const std::string hostile : {"\"><script>alert(1)</script>", "</script><!--<script>"}) {
    CalibratedRig rig = street_rig(Vector6d::Zero(), hostile);
    rig.shown.scene = rig.sensors[0].scenes[0].scene = hostile;
    rig.sensors[1].reasons = rig.sensors[1].advice = rig.warnings = rig.unused = {hostile};
    const Document report =
        calibration_report(rig, {{"left.png", hostile, "png"}}, {{{hostile, hostile}}});
    const std::string page = test::expect_sound_page(report);
    EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(page, Not(HasSubstr("</script><!--")));
  }
}

TEST(CalibrationReport, IsTheSameBytesTwice) {
  if (!can_write_html()) GTEST_SKIP() << "a build without reports";
  EXPECT_TRUE(html_document(report_of_rig(street_rig())) ==
              html_document(report_of_rig(street_rig())));
}

TEST(ResidualChart, IsReadableAndHasALinePerAxis) {
  ViewedSensor sensor;
  sensor.sensor = "left";
  Rng rng = test::test_rng();
  for (int i = 0; i < 5000; ++i) {
    sensor.residuals.push_back({rng.uniform(-180.0, 180.0), rng.uniform(-20.0, 20.0),
                                rng.uniform(1.0, 60.0), rng.uniform(0.0, 90.0),
                                0.01 * rng.normal() + (i % 100 == 0 ? 0.3 : 0.0)});
  }
  for (const Sheet& sheet : {Sheet(), kOneColumn, kTwoColumns}) {
    const Drawing drawing = residual_chart(sensor, sheet);
    EXPECT_EQ(test::unreadable_parts(drawing), std::vector<std::string>());
    int curves = 0;
    for (const Drawing::Element& element : drawing.elements()) {
      const auto* line = std::get_if<Drawing::Polyline>(&element);
      if (line != nullptr && line->style.rfind("curve", 0) == 0) ++curves;
    }
    EXPECT_EQ(curves, 4);
  }
}

TEST(SensorGraph, IsReadableAndHasANodePerSensor) {
  for (const std::size_t count : {2U, 3U, 5U, 6U}) {
    RigView view;
    for (std::size_t i = 0; i < count; ++i) {
      ViewedSensor& sensor = view.sensors.emplace_back();
      sensor.sensor = "sensor_" + std::to_string(i);
      sensor.is_reference = i == 0;
      sensor.is_accepted = i + 1 < count;
      if (i > 0) view.pairs.push_back({"sensor_0", sensor.sensor, 0.5, 0.012, 100});
    }
    const Drawing drawing = sensor_graph(view);
    EXPECT_EQ(test::unreadable_parts(drawing), std::vector<std::string>());
    std::size_t nodes = 0, rejected = 0, edges = 0;
    for (const Drawing::Element& element : drawing.elements()) {
      const auto* text = std::get_if<Drawing::Text>(&element);
      if (std::holds_alternative<Drawing::Line>(element)) ++edges;
      if (text == nullptr) continue;
      nodes += text->style == "name" ? 1 : 0;
      rejected += text->text == "REJECTED" ? 1 : 0;
    }
    EXPECT_EQ(nodes, count);
    EXPECT_EQ(rejected, 1U);
    EXPECT_EQ(edges, count - 1);
  }
}

}  // namespace
}  // namespace croon::experiments
