#include "experiments/store/trial_rows.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "experiments/store/bounded_json.hpp"
#include "experiments/store/store_check.hpp"
#include "experiments/store/store_schema.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

using nlohmann::ordered_json;

constexpr int kKeyColumns = 4;
constexpr int kErrorColumns = 8;
constexpr int kPoseColumns = 12;
constexpr int kCovarianceColumns = 21 + 6;
constexpr int kResultColumns = 2 + kErrorColumns + kPoseColumns;

std::string question_marks(int count) {
  std::string text = "?";
  for (int i = 1; i < count; ++i) text += ", ?";
  return text;
}

Status status_of(const std::string& word) {
  for (std::size_t i = 0; i < kStatusNames.size(); ++i) {
    if (word == kStatusNames[i]) return static_cast<Status>(i);
  }
  throw std::logic_error("invalid status in the store: \"" + word + "\"");
}

/// JSON has no infinities and no NaN; they are written as strings.
ordered_json json_of(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

/// The number written by `json_of`. Throws std::exception for other values.
double number_of(const ordered_json& stored) {
  if (stored == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (stored == "inf") return std::numeric_limits<double>::infinity();
  if (stored == "-inf") return -std::numeric_limits<double>::infinity();
  if (!stored.is_number()) throw std::runtime_error("a diagnostic is not a number");
  return stored.get<double>();
}

/// `{"rmse_m": 0.02, ...}`
std::string diagnostics_text(const std::vector<Diagnostic>& diagnostics) {
  ordered_json object = ordered_json::object();
  for (const auto& [name, value] : diagnostics) object[name] = json_of(value);
  return object.dump();
}

/// The 36 numbers by rows, as in memory: little-endian on all supported machines.
std::string bytes_of(const Matrix6d& information) {
  const Eigen::Matrix<double, 6, 6, Eigen::RowMajor> rows = information;
  return {reinterpret_cast<const char*>(rows.data()), sizeof(double) * 36};
}

void bind_key(Statement& insert, const TrialRow& row) {
  insert.bind(0, row.variant);
  insert.bind(1, row.scene);
  insert.bind(2, row.sensor);
  insert.bind(3, static_cast<std::int64_t>(row.trial));
}

void bind_covariance(Statement& insert, const PoseCovariance& covariance) {
  int column = kKeyColumns;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) insert.bind(column++, covariance.matrix(i, j));
  }
  for (const Observability word : covariance.dofs) insert.bind(column++, name_of(word));
}

void bind_result(Statement& insert, const TrialRecord& record) {
  int column = kKeyColumns;
  insert.bind(column++, status_name(record.status));
  insert.bind(column++, record.reason);
  if (record.error) {
    for (int i = 0; i < 6; ++i) insert.bind(column + i, record.error->dof(i));
    insert.bind(column + 6, record.error->rotation_rad);
    insert.bind(column + 7, record.error->translation_m);
  }
  column += kErrorColumns;
  if (!record.T_reference_sensor) return;
  const RigidTransform& T = *record.T_reference_sensor;
  for (int i = 0; i < 9; ++i) insert.bind(column + i, T.rotation(i / 3, i % 3));
  for (int i = 0; i < 3; ++i) insert.bind(column + 9 + i, T.translation(i));
}

}  // namespace

RecordInserter::RecordInserter(const Database& database)
    : trial_(database.prepare("INSERT INTO trials VALUES(" +
                              question_marks(kKeyColumns + kResultColumns) + ")")),
      covariance_(database.prepare("INSERT INTO covariances VALUES(" +
                                   question_marks(kKeyColumns + kCovarianceColumns) + ")")),
      step_(database.prepare("INSERT INTO steps VALUES(" + question_marks(kKeyColumns + 4) + ")")) {
}

void RecordInserter::add(const TrialRow& row, const TrialRecord& record) {
  bind_key(trial_, row);
  bind_result(trial_, record);
  trial_.next();
  trial_.reset();
  if (record.covariance) {
    bind_key(covariance_, row);
    bind_covariance(covariance_, *record.covariance);
    covariance_.next();
    covariance_.reset();
  }
  std::int64_t index = 0;
  for (const StepRecord& step : record.steps) {
    bind_key(step_, row);
    step_.bind(kKeyColumns, index++);
    step_.bind(kKeyColumns + 1, step.name);
    step_.bind(kKeyColumns + 2, diagnostics_text(step.diagnostics));
    if (step.information) step_.bind_bytes(kKeyColumns + 3, bytes_of(*step.information));
    step_.next();
    step_.reset();
  }
}

Statement select_results(const Database& database) {
  return database.prepare("SELECT variant, scene, sensor, trial, " + result_columns() +
                          " FROM trials");
}

TrialRow row_of(const Statement& select) {
  return {select.integer(0), select.integer(1), select.integer(2),
          static_cast<int>(select.integer(3))};
}

TrialRecord result_of(const Statement& select) {
  TrialRecord record;
  int column = kKeyColumns;
  record.status = status_of(select.text(column++));
  // A reason may quote the name of a file, and a store may come from anywhere.
  record.reason = printable(select.text(column++));
  if (!select.is_null(column)) {
    record.error.emplace();
    for (int i = 0; i < 6; ++i) record.error->dof(i) = select.real(column + i);
    record.error->rotation_rad = select.real(column + 6);
    record.error->translation_m = select.real(column + 7);
  }
  column += kErrorColumns;
  if (!select.is_null(column)) {
    RigidTransform& T = record.T_reference_sensor.emplace();
    for (int i = 0; i < 9; ++i) T.rotation(i / 3, i % 3) = select.real(column + i);
    for (int i = 0; i < 3; ++i) T.translation(i) = select.real(column + 9 + i);
  }
  return record;
}

Statement select_covariances(const Database& database) {
  return database.prepare("SELECT variant, scene, sensor, trial, " + stored_covariance_columns() +
                          " FROM covariances");
}

PoseCovariance stored_covariance_of(const Statement& select) {
  PoseCovariance covariance;
  int column = kKeyColumns;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      covariance.matrix(i, j) = covariance.matrix(j, i) = select.real(column++);
    }
  }
  for (Observability& dof : covariance.dofs) {
    const auto word = observability_of(select.text(column++));
    if (!word) throw std::runtime_error("covariances: invalid observability");
    dof = *word;
  }
  return covariance;
}

Statement select_diagnostics(const Database& database) {
  return database.prepare("SELECT variant, scene, sensor, trial, step, figures FROM steps");
}

std::pair<std::string, std::vector<Diagnostic>> diagnostics_of(const Statement& select) {
  const auto shown = [](const std::string& name) {
    if (name.empty() || !is_harmless(name)) {
      throw std::runtime_error("the name of a step or diagnostic is not printable");
    }
    return name;
  };
  std::vector<Diagnostic> diagnostics;
  const auto object = parsed_or_discarded<ordered_json>(select.text(kKeyColumns + 1));
  if (!object.is_object())
    throw std::runtime_error("the diagnostics of a step are not a JSON object");
  for (const auto& item : object.items()) {
    diagnostics.emplace_back(shown(item.key()), number_of(item.value()));
  }
  return {shown(select.text(kKeyColumns)), std::move(diagnostics)};
}

}  // namespace croon::experiments
