#include "experiments/store/store_check.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "experiments/file/claims.hpp"
#include "experiments/file/start_rule.hpp"
#include "experiments/run/sensor_pairs.hpp"
#include "experiments/store/bounded_json.hpp"
#include "experiments/store/store_header.hpp"
#include "experiments/store/trial_rows.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

/// A table, view or index: its type and name, and the statement that made it.
using SchemaEntry = std::pair<std::string, std::string>;

/// Longer than a name or what reports show beside it, in bytes. Their tables take time that grows
/// with its square.
constexpr const char* kLongestName = "65536";
/// More names than a store has.
constexpr const char* kLargestId = "1000000000";
/// A rotation or a distance beyond this is in no result, and its square is finite.
constexpr const char* kLargestNumber = "1e15";

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

/// The schema of a store, by a store that is made in memory; stores of format 3 and before have no
/// covariances.
std::vector<SchemaEntry> expected_schema(bool with_covariances) {
  Database database("", Access::memory);
  database.run(header_tables() + record_tables() + (with_covariances ? covariance_table() : ""));
  return schema_of(database);
}

/// A condition in SQL that is true for a row with a fault, and what the fault is.
using RowFault = std::pair<std::string, std::string>;

/// Throws InputError unless no row of `table` has one of `faults`. Reads the table once.
void refuse_rows(const Database& database, const std::string& table,
                 const std::vector<RowFault>& faults) {
  std::string index = "CASE";
  for (std::size_t i = 0; i < faults.size(); ++i) {
    index += " WHEN " + faults[i].first + " THEN " + std::to_string(i);
  }
  index += " END";
  Statement select = database.prepare("SELECT " + index + " AS fault FROM " + table +
                                      " WHERE fault IS NOT NULL LIMIT 1");
  if (!select.next()) return;
  refuse(database, table + ": " + faults.at(static_cast<std::size_t>(select.integer(0))).second);
}

void check_pages(const Database& database) {
  Statement check = database.prepare("PRAGMA quick_check(1)");
  std::string found = check.next() ? check.text(0) : "nothing could be checked";
  std::replace(found.begin(), found.end(), '\n', ' ');
  if (found != "ok") refuse(database, found);
}

/// Whether `text` does no harm in a terminal or a table: it is UTF-8 without control characters and
/// does not begin with a sign by which spreadsheets know a formula.
bool is_harmless(const std::string& text) {
  return printable(text) == text && std::string(kFormulaSigns).find(text[0]) == std::string::npos;
}

/// Checks the texts of `table` that reports show, the names and `detail`, which may be empty. A
/// pipeline is not shown, but must be JSON.
void check_shown_names(const Database& database, const std::string& table,
                       const std::string& detail) {
  const bool is_shown = detail != "pipeline";
  std::int64_t current = 0;
  Statement select =
      database.prepare("SELECT name, place IS NOT NULL, " + detail + " FROM " + table);
  while (select.next()) {
    const std::string name = select.text(0), shown = is_shown ? select.text(2) : "";
    if (!is_shown && parsed_or_discarded(select.text(2)).is_discarded()) {
      refuse(database, table + ": a pipeline is no JSON");
    }
    current += select.integer(1);
    const bool is_name = !name.empty() && is_harmless(name);
    if (is_name && is_harmless(shown)) continue;
    const std::string& bad = is_name ? shown : name;
    refuse(database, table +
                         ": expected a name in UTF-8 without control characters that does not "
                         "begin with = + - or @, found \"" +
                         bad + "\"");
  }
  // An experiment has fewer sensors too; time grows with the square of their number.
  if (current > std::int64_t{kMostVariants} && table != "scenes") {
    refuse(database, "it has " + std::to_string(current) + " " + table + ", expected at most " +
                         std::to_string(kMostVariants));
  }
}

void check_names(const Database& database, const std::string& table, const std::string& detail) {
  const auto is_long = [](const std::string& column) {
    return "length(CAST(" + column + " AS BLOB)) > " + kLongestName;
  };
  const std::string long_detail = detail == "pipeline" ? "" : " OR " + is_long(detail);
  refuse_rows(database, table,
              {{"id NOT BETWEEN 1 AND " + std::string(kLargestId), "an id is out of range"},
               {"typeof(name) <> 'text' OR typeof(" + detail + ") <> 'text'", "a name is no text"},
               {is_long("name") + long_detail, "a name is too long"},
               {"typeof(place) NOT IN ('null', 'integer') OR place < 0 OR place >= (SELECT "
                "count(place) FROM " +
                    table + ")",
                "a place is no index"}});
  const std::string twice = "SELECT 1 FROM " + table + " GROUP BY place HAVING count(place) > 1";
  if (database.prepare(twice).next()) refuse(database, table + ": two names have one place");
  check_shown_names(database, table, detail);
}

/// Throws InputError if a sensor has the name of all sensors together, or if one whose reference is
/// another sensor has not the name of this pair.
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

/// SQL that is true unless each of `columns` holds a number in range, or each of them is null.
std::string not_numbers(const std::vector<std::string>& columns) {
  std::string all_null, all_numbers;
  for (const std::string& column : columns) {
    all_null += (all_null.empty() ? "" : " AND ") + column + " IS NULL";
    all_numbers += (all_numbers.empty() ? "" : " AND ") + ("typeof(" + column) +
                   ") = 'real' AND abs(" + column + ") <= " + kLargestNumber;
  }
  return "NOT ((" + all_null + ") OR (" + all_numbers + "))";
}

/// The faults of the columns that name a trial.
std::vector<RowFault> key_faults() {
  std::vector<RowFault> faults;
  for (const auto& [column, names] :
       {std::pair("variant", "variants"), {"scene", "scenes"}, {"sensor", "sensors"}}) {
    faults.emplace_back(column + std::string(" NOT IN (SELECT id FROM ") + names + ")",
                        std::string("a ") + column + " has no name");
  }
  faults.emplace_back(
      "typeof(trial) <> 'integer' OR trial NOT BETWEEN 0 AND " + std::to_string(kMaxTrials),
      "a number of a trial is out of range");
  return faults;
}

/// Throws InputError if a row of `table`, with `what` in it, is of no trial, or of one that
/// `condition` excludes.
void refuse_orphans(const Database& database, const std::string& table, const std::string& what,
                    const std::string& condition = "") {
  // Both are read in the order of their keys; a lookup per row takes three times as long.
  const std::string key = "SELECT variant, scene, sensor, trial FROM ";
  Statement orphans = database.prepare("SELECT 1 FROM (" + key + table + " EXCEPT " + key +
                                       "trials" + condition + " ORDER BY 1, 2, 3, 4) LIMIT 1");
  if (orphans.next()) refuse(database, what);
}

/// SQL for a list of texts: "'success', 'failed'".
template <class Words>
std::string quoted(const Words& words) {
  std::string list;
  for (const char* word : words) list += (list.empty() ? "'" : ", '") + std::string(word) + "'";
  return list;
}

void check_trials(const Database& database) {
  std::vector<RowFault> faults = key_faults();
  const std::string words = quoted(kStatusNames);
  faults.emplace_back("status NOT IN (" + words + ") OR status IS NULL",
                      "a status is none of " + words);
  faults.emplace_back(
      "typeof(reason) <> 'text' OR length(CAST(reason AS BLOB)) > " + std::string(kLongestName),
      "a reason is no text, or too long");
  const auto [errors, pose] = number_columns();
  faults.emplace_back(not_numbers(errors), "an error is no number");
  faults.emplace_back(not_numbers(pose), "a pose is no number");
  faults.emplace_back("rotation_error_rad NOT BETWEEN 0 AND 3.1416 OR translation_error_m < 0",
                      "an error is out of range");
  // Older stores have a `success` without an error.
  faults.emplace_back("status = 'inaccurate' AND rotation_error_rad IS NULL",
                      "an inaccurate trial has no error");
  faults.emplace_back("status = 'failed' AND (r00 IS NOT NULL OR rotation_error_rad IS NOT NULL)",
                      "a failed trial has a pose or an error");
  faults.emplace_back("status = 'finished' AND rotation_error_rad IS NOT NULL",
                      "a trial without truth has an error");
  refuse_rows(database, "trials", faults);
}

void check_covariance_rows(const Database& database) {
  if (!has_covariances(database)) return;
  std::vector<RowFault> faults = key_faults();
  const std::string words = quoted(kObservabilityNames);
  for (const std::string& column : names_in(stored_covariance_columns())) {
    const bool is_number = column.front() == 'c';
    faults.emplace_back(is_number ? "typeof(" + column + ") <> 'real'"
                                  : column + " IS NULL OR " + column + " NOT IN (" + words + ")",
                        is_number ? "a number has another type" : "a word is none of " + words);
  }
  refuse_rows(database, "covariances", faults);
  refuse_orphans(database, "covariances", "a covariance has no pose", " WHERE r00 IS NOT NULL");
}

void check_steps(const Database& database) {
  std::vector<RowFault> faults = key_faults();
  faults.emplace_back(
      "typeof(place) <> 'integer' OR typeof(step) <> 'text' OR typeof(figures) <> 'text'",
      "a value has another type");
  faults.emplace_back("place NOT BETWEEN 0 AND " + std::string(kLargestId),
                      "a place is out of range");
  faults.emplace_back(
      "information IS NOT NULL AND (typeof(information) <> 'blob' OR length(information) <> 288)",
      "an information matrix has another size");
  refuse_rows(database, "steps", faults);
  refuse_orphans(database, "steps", "a step has no trial");
}

}  // namespace

void check_schema(const Database& database) {
  Statement encoding = database.prepare("PRAGMA encoding");
  if (!encoding.next() || encoding.text(0) != "UTF-8") refuse(database, "its text is not UTF-8");
  const std::vector<SchemaEntry> expected = expected_schema(has_covariances(database));
  const std::vector<SchemaEntry> found = schema_of(database);
  const auto difference =
      std::mismatch(expected.begin(), expected.end(), found.begin(), found.end());
  if (difference.first == expected.end() && difference.second == found.end()) return;
  const bool is_missing =
      difference.first != expected.end() &&
      (difference.second == found.end() || difference.first->first <= difference.second->first);
  refuse(database, is_missing ? "it has no " + difference.first->first + " as a store has it"
                              : "it has a " + difference.second->first + ", which no store has");
}

void check_rotation(const Database& database, const Eigen::Matrix3d& rotation) {
  if (!is_rotation_matrix(rotation)) refuse(database, "trials: a pose has no rotation");
}

void check_rotations(const Database& database) {
  const std::vector<std::string> pose = number_columns().second;
  std::string columns;
  for (std::size_t i = 0; i < 9; ++i) columns += (i == 0 ? "" : ", ") + pose[i];
  Statement select =
      database.prepare("SELECT " + columns + " FROM trials WHERE " + pose[0] + " IS NOT NULL");
  while (select.next()) {
    Eigen::Matrix3d rotation;
    for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = select.real(i);
    check_rotation(database, rotation);
  }
}

void check_covariance(const Database& database, const Matrix6d& matrix) {
  if (!is_covariance(matrix)) refuse(database, "covariances: a matrix is no covariance");
}

void check_covariances(const Database& database) {
  if (!has_covariances(database)) return;
  Statement select = select_covariances(database);
  while (select.next()) check_covariance(database, stored_covariance_of(select).matrix);
}

void check_figures(const Database& database) {
  Statement select = select_figures(database);
  try {
    while (select.next()) figures_of(select);
  } catch (const std::exception& error) {
    refuse(database, std::string("steps: ") + error.what());
  }
}

void check_content(const Database& database) {
  check_pages(database);
  refuse_rows(database, "meta",
              {{"typeof(name) <> 'text' OR typeof(value) <> 'text'", "a value is no text"}});
  const std::string has_header = "EXISTS (SELECT 1 FROM meta)";
  if (database.prepare("SELECT 1 FROM trials WHERE NOT " + has_header + " LIMIT 1").next()) {
    refuse(database, "it has trials, but no header that says what they were made from");
  }
  check_names(database, "variants", "pipeline");
  check_names(database, "scenes", "kind");
  check_names(database, "sensors", "reference");
  check_sensors(database);
  check_trials(database);
  check_covariance_rows(database);
  check_steps(database);
}

}  // namespace croon::experiments
