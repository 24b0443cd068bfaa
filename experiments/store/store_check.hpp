#pragma once

#include <Eigen/Core>
#include <string>

#include "experiments/store/database.hpp"
#include "framework/geometry/dof.hpp"

namespace croon::experiments {

// A store is untrusted input like any other file: it may be damaged or malicious.

/// Whether `text` is safe in a terminal and a table: UTF-8 without control characters, and not
/// beginning with a sign that spreadsheets interpret as the start of a formula.
bool is_harmless(const std::string& text);

/// Throws InputError with the first fault that SQLite's check `pragma` finds.
void check_by(const Database& database, const std::string& pragma);

/// Throws InputError unless the database has exactly the tables and views that the SQL `schema`
/// creates. Runs in constant time.
void check_schema(const Database& database, const std::string& schema);

/// Throws InputError unless the store is intact: its pages, and the type and range of every value,
/// but not the rotations of its poses nor its covariances. Runs in time proportional to the size of
/// the file. Call check_schema first.
void check_content(const Database& database);

/// Throws InputError unless the diagnostics and names of all steps can be read; for callers that do
/// not read them.
void check_diagnostics(const Database& database);

/// Throws InputError unless `rotation`, of a pose in the store, is a rotation matrix. SQL would
/// take several times as long.
void check_rotation(const Database& database, const Eigen::Matrix3d& rotation);

/// The same for all poses; for callers that do not read them.
void check_rotations(const Database& database);

/// Throws InputError unless `matrix`, of the table `covariances`, is a covariance matrix.
void check_covariance(const Database& database, const Matrix6d& matrix);

/// The same for all covariances; for callers that do not read them.
void check_covariances(const Database& database);

}  // namespace croon::experiments
