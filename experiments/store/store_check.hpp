#pragma once

#include <Eigen/Core>

#include "experiments/store/database.hpp"
#include "framework/geometry/dof.hpp"

namespace croon::experiments {

// A store is input like any other file: it may be damaged, or made to do harm.

/// Throws InputError unless the database has the tables and views of a store and nothing else. Runs
/// in constant time.
void check_schema(const Database& database);

/// Throws InputError unless the store is whole: its pages, and the type and range of every value,
/// but neither the rotations of its poses nor its covariances. Runs in time proportional to the
/// size of the file. Call check_schema before.
void check_content(const Database& database);

/// Throws InputError unless the figures and names of all steps can be read, for who does not read
/// them.
void check_figures(const Database& database);

/// Throws InputError unless `rotation`, of a pose of the store, is a rotation. SQL takes several
/// times as long.
void check_rotation(const Database& database, const Eigen::Matrix3d& rotation);

/// The same for all poses, for who does not read them.
void check_rotations(const Database& database);

/// Throws InputError unless `matrix`, of the table `covariances`, is a covariance.
void check_covariance(const Database& database, const Matrix6d& matrix);

/// The same for all covariances, for who does not read them.
void check_covariances(const Database& database);

}  // namespace croon::experiments
