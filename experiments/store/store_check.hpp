#pragma once

#include "experiments/store/database.hpp"

namespace croon::experiments {

// A store is input like any other file: it may be damaged, or made to do harm.

/// Throws InputError unless the database has the tables and views of a store and nothing else. Runs
/// in constant time.
void check_schema(const Database& database);

/// Throws InputError unless the store is whole: its pages, and the type and range of every value.
/// Runs in time proportional to the size of the file. Call check_schema before.
void check_content(const Database& database);

}  // namespace croon::experiments
