#include "experiments/store/store_check.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "experiments/file/start_rule.hpp"
#include "experiments/store/store_header.hpp"
#include "experiments/store/trial_rows.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

/// A table, view or index: its type and name, and the statement that made it.
using SchemaEntry = std::pair<std::string, std::string>;

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

/// The schema of a store, by a store that is made in memory.
const std::vector<SchemaEntry>& expected_schema() {
  static const std::vector<SchemaEntry> schema = [] {
    Database database("", Access::memory);
    database.run(header_tables() + record_tables());
    return schema_of(database);
  }();
  return schema;
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

void check_names(const Database& database, const std::string& table, const std::string& detail) {
  refuse_rows(database, table,
              {{"id NOT BETWEEN 1 AND " + std::string(kLargestId), "an id is out of range"},
               {"typeof(name) <> 'text' OR typeof(" + detail + ") <> 'text'", "a name is no text"},
               {"typeof(place) NOT IN ('null', 'integer')", "a place is no number"}});
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

void check_trials(const Database& database) {
  std::vector<RowFault> faults = key_faults();
  std::string words;
  for (const char* word : kStatusNames) {
    words += (words.empty() ? "'" : ", '") + std::string(word) + "'";
  }
  faults.emplace_back("status NOT IN (" + words + ") OR status IS NULL",
                      "a status is none of " + words);
  faults.emplace_back("typeof(reason) <> 'text'", "a reason is no text");
  const auto [errors, pose] = number_columns();
  faults.emplace_back(not_numbers(errors), "an error is no number");
  faults.emplace_back(not_numbers(pose), "a pose is no number");
  refuse_rows(database, "trials", faults);
}

void check_steps(const Database& database) {
  std::vector<RowFault> faults = key_faults();
  faults.emplace_back(
      "typeof(place) <> 'integer' OR typeof(step) <> 'text' OR typeof(figures) <> 'text'",
      "a value has another type");
  faults.emplace_back(
      "information IS NOT NULL AND (typeof(information) <> 'blob' OR length(information) <> 288)",
      "an information matrix has another size");
  refuse_rows(database, "steps", faults);
}

}  // namespace

void check_schema(const Database& database) {
  Statement encoding = database.prepare("PRAGMA encoding");
  if (!encoding.next() || encoding.text(0) != "UTF-8") refuse(database, "its text is not UTF-8");
  const std::vector<SchemaEntry>& expected = expected_schema();
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

void check_content(const Database& database) {
  check_pages(database);
  refuse_rows(database, "meta",
              {{"typeof(name) <> 'text' OR typeof(value) <> 'text'", "a value is no text"}});
  check_names(database, "variants", "pipeline");
  check_names(database, "scenes", "kind");
  check_names(database, "sensors", "reference");
  check_trials(database);
  check_steps(database);
}

}  // namespace croon::experiments
