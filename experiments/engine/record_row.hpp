#pragma once

#include <string>

#include "experiments/engine/database.hpp"
#include "experiments/engine/trial_record.hpp"

namespace croon::experiments {

/// The columns of a record in the store, for CREATE TABLE. Error and pose are null where the record
/// has none: angles in rad, lengths in m, the rotation by rows.
std::string record_columns();

/// The statement that adds a record; bind_record sets its parameters.
std::string record_insert();
void bind_record(Statement& insert, const TrialRecord& record);

/// The record in the row at which `select`, of all columns in their order, stands.
TrialRecord record_of(const Statement& select);

}  // namespace croon::experiments
