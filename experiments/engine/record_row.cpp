#include "experiments/engine/record_row.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

namespace croon::experiments {
namespace {

using nlohmann::json;

constexpr int kErrorColumns = 8;
constexpr int kPoseColumns = 12;

/// All columns in order; those with a type are part of the key or text.
const std::vector<std::string> kColumns = {"variant TEXT",
                                           "scene TEXT",
                                           "sensor TEXT",
                                           "trial INTEGER",
                                           "status TEXT",
                                           "reason TEXT",
                                           "roll_error_rad",
                                           "pitch_error_rad",
                                           "yaw_error_rad",
                                           "x_error_m",
                                           "y_error_m",
                                           "z_error_m",
                                           "rotation_error_rad",
                                           "translation_error_m",
                                           "r00",
                                           "r01",
                                           "r02",
                                           "r10",
                                           "r11",
                                           "r12",
                                           "r20",
                                           "r21",
                                           "r22",
                                           "tx_m",
                                           "ty_m",
                                           "tz_m",
                                           "steps TEXT"};

Status status_of(const std::string& word) {
  for (std::size_t i = 0; i < kStatusNames.size(); ++i) {
    if (word == kStatusNames[i]) return static_cast<Status>(i);
  }
  throw std::logic_error("the store has a status \"" + word + "\"");
}

/// JSON has no infinities and no NaN: they are words.
json json_of(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

double number_of(const json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

/// `[["registration", [["rmse_m", 0.02], ...]], ...]`
std::string steps_text(const std::vector<StepRecord>& steps) {
  json list = json::array();
  for (const StepRecord& step : steps) {
    json figures = json::array();
    for (const auto& [name, value] : step.figures) {
      figures.push_back(json::array({name, json_of(value)}));
    }
    list.push_back(json::array({step.name, figures}));
  }
  return list.dump();
}

std::vector<StepRecord> steps_of(const std::string& text) {
  std::vector<StepRecord> steps;
  for (const json& step : json::parse(text)) {
    steps.push_back({step.at(0).get<std::string>(), 0.0, {}});
    for (const json& figure : step.at(1)) {
      steps.back().figures.emplace_back(figure.at(0).get<std::string>(), number_of(figure.at(1)));
    }
  }
  return steps;
}

}  // namespace

std::string record_columns() {
  std::string text;
  for (const std::string& column : kColumns) text += (text.empty() ? "" : ", ") + column;
  return text;
}

std::string record_insert() {
  std::string places;
  for (std::size_t i = 0; i < kColumns.size(); ++i) places += i == 0 ? "?" : ", ?";
  return "INSERT INTO trials VALUES(" + places + ")";
}

void bind_record(Statement& insert, const TrialRecord& record) {
  int place = 0;
  insert.bind(place++, record.id.variant);
  insert.bind(place++, record.id.scene);
  insert.bind(place++, record.id.sensor);
  insert.bind(place++, static_cast<std::int64_t>(record.id.trial));
  insert.bind(place++, status_name(record.status));
  insert.bind(place++, record.reason);
  if (record.error) {
    for (int i = 0; i < 6; ++i) insert.bind(place + i, record.error->dof(i));
    insert.bind(place + 6, record.error->rotation_rad);
    insert.bind(place + 7, record.error->translation_m);
  }
  place += kErrorColumns;
  if (record.T_reference_sensor) {
    const RigidTransform& T = *record.T_reference_sensor;
    for (int i = 0; i < 9; ++i) insert.bind(place + i, T.rotation(i / 3, i % 3));
    for (int i = 0; i < 3; ++i) insert.bind(place + 9 + i, T.translation(i));
  }
  place += kPoseColumns;
  insert.bind(place, steps_text(record.steps));
}

TrialRecord record_of(const Statement& select) {
  TrialRecord record;
  record.id = {select.text(0), select.text(1), select.text(2), static_cast<int>(select.integer(3))};
  record.status = status_of(select.text(4));
  record.reason = select.text(5);
  int place = 6;
  if (!select.is_null(place)) {
    record.error.emplace();
    for (int i = 0; i < 6; ++i) record.error->dof(i) = select.real(place + i);
    record.error->rotation_rad = select.real(place + 6);
    record.error->translation_m = select.real(place + 7);
  }
  place += kErrorColumns;
  if (!select.is_null(place)) {
    RigidTransform& T = record.T_reference_sensor.emplace();
    for (int i = 0; i < 9; ++i) T.rotation(i / 3, i % 3) = select.real(place + i);
    for (int i = 0; i < 3; ++i) T.translation(i) = select.real(place + 9 + i);
  }
  place += kPoseColumns;
  record.steps = steps_of(select.text(place));
  return record;
}

}  // namespace croon::experiments
