#include "experiments/store/store_schema.hpp"

#include <utility>

#include "experiments/file/start_rule.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/geometry/pose_covariance.hpp"

namespace croon::experiments {
namespace {

using Names = std::vector<std::string>;

/// The maximum number of bytes of a name, or of its detail.
constexpr const char* kMaxTextBytes = "65536";
/// More names than a store can have.
constexpr const char* kMaxId = "1000000000";
/// No result has a rotation or distance beyond this, and its square is finite.
constexpr const char* kMaxNumber = "1e15";

/// `'success', 'failed'`
template <class Words>
std::string quoted(const Words& words) {
  Names names;
  for (const char* word : words) names.push_back("'" + std::string(word) + "'");
  return list_text(names);
}

std::string is_short(const std::string& column) {
  return "length(CAST(" + column + " AS BLOB)) <= " + kMaxTextBytes;
}

/// A condition: all `columns` are numbers in range, or all are null.
std::string numbers_or_nulls(const Names& columns) {
  Names nulls, numbers;
  for (const std::string& column : columns) {
    nulls.push_back(column + " IS NULL");
    numbers.push_back("typeof(" + column + ") = 'real' AND abs(" + column + ") <= " + kMaxNumber);
  }
  return "(" + list_text(nulls, " AND ") + ") OR (" + list_text(numbers, " AND ") + ")";
}

/// A table: its columns, its other constraints, and the conditions that every row satisfies.
struct TableSchema {
  std::string name;
  std::string columns;
  std::string constraints;
  std::string options;
  Names conditions;
};

std::string statement_of(const TableSchema& table) {
  std::string sql = "CREATE TABLE " + table.name + "(" + table.columns;
  for (const std::string& condition : table.conditions) sql += ", CHECK(" + condition + ")";
  return sql + table.constraints + ") " + table.options + ";";
}

TableSchema name_table(const std::string& name, const std::string& detail, Names conditions) {
  conditions.push_back(std::string("id BETWEEN 1 AND ") + kMaxId);
  conditions.push_back(is_short("name"));
  conditions.emplace_back("place >= 0");
  return {name,
          "id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, " + detail +
              " TEXT NOT NULL, place INTEGER UNIQUE",
          "", "STRICT", std::move(conditions)};
}

constexpr const char* kTrialColumns =
    "variant INTEGER NOT NULL REFERENCES variants, scene INTEGER NOT NULL REFERENCES scenes, "
    "sensor INTEGER NOT NULL REFERENCES sensors, trial INTEGER NOT NULL, ";
constexpr const char* kTrialPrimaryKey = ", PRIMARY KEY(variant, scene, sensor, trial)";
constexpr const char* kOfATrial = ", FOREIGN KEY(variant, scene, sensor, trial) REFERENCES trials";
constexpr const char* kWithoutRowId = "STRICT, WITHOUT ROWID";

std::string is_trial() { return "trial BETWEEN 0 AND " + std::to_string(kMaxTrials); }

Names error_columns() {
  return {"roll_error_rad", "pitch_error_rad", "yaw_error_rad",      "x_error_m",
          "y_error_m",      "z_error_m",       "rotation_error_rad", "translation_error_m"};
}

Names pose_columns() {
  Names names = rotation_columns();
  names.insert(names.end(), {"tx_m", "ty_m", "tz_m"});
  return names;
}

Names numbers_of_covariance() {
  Names names;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) names.push_back("c" + std::to_string(i) + std::to_string(j));
  }
  return names;
}

// Numbers have the type ANY: SQLite then keeps all bits of a double, including those of -0.0.
TableSchema trial_table() {
  return {"trials",
          std::string(kTrialColumns) + "status TEXT NOT NULL, reason TEXT NOT NULL, " +
              list_text(error_columns(), " ANY, ") + " ANY, " +
              list_text(pose_columns(), " ANY, ") + " ANY",
          kTrialPrimaryKey,
          kWithoutRowId,
          {is_trial(), "status IN (" + quoted(kStatusNames) + ")", is_short("reason"),
           numbers_or_nulls(error_columns()), numbers_or_nulls(pose_columns()),
           "rotation_error_rad BETWEEN 0 AND 3.1416 AND translation_error_m >= 0",
           "status NOT IN ('success', 'inaccurate') OR rotation_error_rad IS NOT NULL",
           "status NOT IN ('finished', 'failed') OR rotation_error_rad IS NULL",
           "status <> 'failed' OR r00 IS NULL"}};
}

TableSchema covariance_table() {
  TableSchema table = {"covariances",
                       kTrialColumns,
                       std::string(kTrialPrimaryKey) + kOfATrial,
                       kWithoutRowId,
                       {is_trial()}};
  for (const std::string& name : numbers_of_covariance()) {
    table.columns += name + " ANY NOT NULL, ";
    table.conditions.push_back("typeof(" + name + ") = 'real'");
  }
  table.columns += list_text({kDofNames.begin(), kDofNames.end()}, " TEXT NOT NULL, ");
  table.columns += " TEXT NOT NULL";
  for (const std::string& dof : kDofNames) {
    table.conditions.push_back(dof + " IN (" + quoted(kObservabilityNames) + ")");
  }
  return table;
}

TableSchema step_table() {
  return {"steps",
          std::string(kTrialColumns) +
              "place INTEGER NOT NULL, step TEXT NOT NULL, figures TEXT NOT NULL, information BLOB",
          std::string(", PRIMARY KEY(variant, scene, sensor, trial, place)") + kOfATrial,
          kWithoutRowId,
          {is_trial(), std::string("place BETWEEN 0 AND ") + kMaxId,
           "length(information) = " + std::to_string(36 * sizeof(double))}};
}

std::vector<TableSchema> tables() {
  return {{"meta", "name TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL", "", kWithoutRowId, {}},
          name_table("variants", "pipeline", {}),
          name_table("scenes", "kind", {is_short("kind")}),
          name_table("sensors", "reference", {is_short("reference")}),
          trial_table(),
          step_table(),
          covariance_table()};
}

/// A view of `table` with the names of variants, scenes and sensors instead of their ids.
std::string named_view(const std::string& table, const std::string& columns) {
  return "CREATE VIEW named_" + table +
         " AS SELECT variants.name AS variant, scenes.name AS scene, sensors.name AS sensor, "
         "t.trial, " +
         columns + " FROM " + table +
         " t JOIN variants ON variants.id = t.variant JOIN scenes ON scenes.id = t.scene"
         " JOIN sensors ON sensors.id = t.sensor;";
}

}  // namespace

std::string result_columns() {
  return "status, reason, " + list_text(error_columns()) + ", " + list_text(pose_columns());
}

Names rotation_columns() { return {"r00", "r01", "r02", "r10", "r11", "r12", "r20", "r21", "r22"}; }

std::string stored_covariance_columns() {
  return list_text(numbers_of_covariance(), ", ") + ", " +
         list_text({kDofNames.begin(), kDofNames.end()}, ", ");
}

std::string store_schema() {
  std::string sql;
  for (const TableSchema& table : tables()) sql += statement_of(table);
  return sql + named_view("trials", result_columns()) +
         named_view("steps", "t.place, step, figures, information") +
         named_view("covariances", stored_covariance_columns());
}

std::vector<TableConditions> store_conditions() {
  std::vector<TableConditions> all;
  for (const TableSchema& table : tables()) {
    if (!table.conditions.empty()) all.push_back({table.name, table.conditions});
  }
  return all;
}

}  // namespace croon::experiments
