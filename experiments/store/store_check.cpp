#include "experiments/store/store_check.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "experiments/run/sensor_pairs.hpp"
#include "experiments/store/bounded_json.hpp"
#include "experiments/store/store_schema.hpp"
#include "experiments/store/trial_rows.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

/// A table, view or index: its type and name, and the statement that created it.
using SchemaEntry = std::pair<std::string, std::string>;

[[noreturn]] void refuse(const Database& database, const std::string& why) {
  throw UnreadableDatabase(database.file(), "", "is damaged: " + why);
}

std::vector<SchemaEntry> schema_of(const Database& database) {
  std::vector<SchemaEntry> schema;
  Statement select =
      database.prepare("SELECT type || ' ' || name, ifnull(sql, '') FROM sqlite_master ORDER BY 1");
  while (select.next()) schema.emplace_back(select.text(0), select.text(1));
  return schema;
}

void check_conditions(const Database& database) {
  for (const TableConditions& of : store_conditions()) {
    std::string index = "CASE";
    for (std::size_t i = 0; i < of.conditions.size(); ++i) {
      index += " WHEN NOT (" + of.conditions[i] + ") THEN " + std::to_string(i);
    }
    Statement select = database.prepare("SELECT " + index + " END AS broken FROM " + of.table +
                                        " WHERE broken IS NOT NULL LIMIT 1");
    if (!select.next()) continue;
    refuse(database, of.table + ": expected rows in which " +
                         of.conditions.at(static_cast<std::size_t>(select.integer(0))));
  }
}

void check_references(const Database& database) {
  Statement check = database.prepare("PRAGMA foreign_key_check");
  if (check.next())
    refuse(database, "a row of " + check.text(0) + " refers to a missing row of " + check.text(2));
  Statement orphan = database.prepare(
      "SELECT 1 FROM covariances JOIN trials USING(variant, scene, sensor, trial) "
      "WHERE r00 IS NULL LIMIT 1");
  if (orphan.next()) refuse(database, "a covariance has no pose");
}

/// Checks the texts of `table` that reports show: the names and `detail`, which may be empty.
void check_names(const Database& database, const std::string& table, const std::string& detail) {
  check_by(database, "integrity_check(" + table + ")");
  Statement positions =
      database.prepare("SELECT ifnull(max(place) + 1, 0), count(place) FROM " + table);
  positions.next();
  if (positions.integer(0) != positions.integer(1))
    refuse(database, table + ": a position is missing");
  // Experiments also have fewer sensors than this; run time grows with the square of their number.
  if (positions.integer(1) > std::int64_t{kMaxVariants} && table != "scenes") {
    refuse(database, "it has " + std::to_string(positions.integer(1)) + " " + table +
                         ", expected at most " + std::to_string(kMaxVariants));
  }
  Statement select = database.prepare("SELECT name, " + detail + " FROM " + table);
  while (select.next()) {
    const std::string name = select.text(0), shown = select.text(1);
    const bool is_name = !name.empty() && is_harmless(name);
    if (is_name && is_harmless(shown)) continue;
    refuse(database, table +
                         ": expected a name in UTF-8 without control characters that does not "
                         "begin with = + - or @, found \"" +
                         (is_name ? shown : name) + "\"");
  }
}

void check_pipelines(const Database& database) {
  Statement select = database.prepare("SELECT pipeline FROM variants");
  while (select.next()) {
    if (!parsed_or_discarded(select.text(0)).is_discarded()) continue;
    refuse(database, "variants: a pipeline is not JSON");
  }
}

/// Throws InputError if a sensor has the name of all sensors together, or if a sensor whose
/// reference is another sensor does not have the name of this pair.
void check_sensors(const Database& database) {
  Statement all = database.prepare("SELECT 1 FROM sensors WHERE name = ?");
  all.bind(0, kAllSensors);
  if (all.next()) {
    refuse(database,
           "sensors: \"" + std::string(kAllSensors) + "\" is the name of all sensors together");
  }
  Statement pairs = database.prepare(
      "SELECT name FROM sensors AS pair WHERE reference IN (SELECT name FROM sensors) AND NOT "
      "EXISTS (SELECT 1 FROM sensors AS source WHERE pair.name = source.name || ? || "
      "pair.reference) LIMIT 1");
  pairs.bind(0, std::string(1, kBetweenSensors));
  if (pairs.next()) {
    refuse(database, "sensors: \"" + pairs.text(0) + "\" is not the name of a pair of sensors");
  }
}

}  // namespace

bool is_harmless(const std::string& text) {
  return printable(text) == text && std::string(kFormulaSigns).find(text[0]) == std::string::npos;
}

void check_by(const Database& database, const std::string& pragma) {
  Statement check = database.prepare("PRAGMA " + pragma);
  std::string found = check.next() ? check.text(0) : "nothing could be checked";
  std::replace(found.begin(), found.end(), '\n', ' ');
  if (found != "ok") refuse(database, found);
}

void check_schema(const Database& database, const std::string& schema) {
  Statement encoding = database.prepare("PRAGMA encoding");
  if (!encoding.next() || encoding.text(0) != "UTF-8") refuse(database, "its text is not UTF-8");
  Database whole("", Access::memory);
  whole.run(schema);
  const std::vector<SchemaEntry> expected = schema_of(whole), found = schema_of(database);
  const auto difference =
      std::mismatch(expected.begin(), expected.end(), found.begin(), found.end());
  if (difference.first == expected.end() && difference.second == found.end()) return;
  const bool is_missing =
      difference.first != expected.end() &&
      (difference.second == found.end() || difference.first->first <= difference.second->first);
  refuse(database, is_missing
                       ? "it lacks the " + difference.first->first + " of this version of croon"
                       : "it has a " + difference.second->first + ", which no store has");
}

void check_rotation(const Database& database, const Eigen::Matrix3d& rotation) {
  if (!is_rotation_matrix(rotation)) refuse(database, "trials: the rotation of a pose is invalid");
}

void check_rotations(const Database& database) {
  Statement select = database.prepare("SELECT " + list_text(rotation_columns()) +
                                      " FROM trials WHERE r00 IS NOT NULL");
  while (select.next()) {
    Eigen::Matrix3d rotation;
    for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = select.real(i);
    check_rotation(database, rotation);
  }
}

void check_covariance(const Database& database, const Matrix6d& matrix) {
  if (!is_covariance(matrix)) refuse(database, "covariances: invalid covariance matrix");
}

void check_covariances(const Database& database) {
  Statement select = select_covariances(database);
  while (select.next()) check_covariance(database, stored_covariance_of(select).matrix);
}

void check_diagnostics(const Database& database) {
  Statement select = select_diagnostics(database);
  try {
    while (select.next()) diagnostics_of(select);
  } catch (const std::exception& error) {
    refuse(database, std::string("steps: ") + error.what());
  }
}

void check_content(const Database& database) {
  check_by(database, "quick_check(1)");
  const std::string has_header = "EXISTS (SELECT 1 FROM meta)";
  if (database.prepare("SELECT 1 FROM trials WHERE NOT " + has_header + " LIMIT 1").next()) {
    refuse(database, "it has trials, but no header with their provenance");
  }
  check_conditions(database);
  check_references(database);
  check_names(database, "variants", "''");
  check_pipelines(database);
  check_names(database, "scenes", "kind");
  check_names(database, "sensors", "reference");
  check_sensors(database);
}

}  // namespace croon::experiments
