#pragma once

#include <string>
#include <vector>

namespace croon::experiments {

// The schema of a store declares the permitted values, so that SQLite checks them: types and
// conditions on every insertion; for a store from elsewhere, types, missing values and references
// with quick_check and foreign_key_check.

/// The columns of `trials` after the four that identify a trial: status, reason, error (rad and m)
/// and pose (the rotation by rows, m). Error and pose are null if the trial has none.
std::string result_columns();

/// The columns of the rotation among them, by rows.
std::vector<std::string> rotation_columns();

/// The columns of `covariances` after the four that identify a trial: the upper triangle by rows,
/// `c00` to `c55`, and the observability of each degree of freedom, `roll` to `z`.
std::string stored_covariance_columns();

/// The conditions that every row of a table satisfies.
struct TableConditions {
  std::string table;
  std::vector<std::string> conditions;
};

/// The CHECK constraints of the schema. SQLite (3.40) does not parse them in a file opened for
/// reading, so quick_check does not verify them.
std::vector<TableConditions> store_conditions();

/// SQL that creates the tables of a store, and views of them with names instead of ids.
std::string store_schema();

}  // namespace croon::experiments
