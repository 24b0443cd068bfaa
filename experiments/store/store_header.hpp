#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/store/database.hpp"

namespace croon::experiments {

/// What decides the result of every trial of a run, by name ("starts", "program"), as JSON or as a
/// digest of it. Pipelines decide the results of their variants alone and stand with them.
using Provenance = std::map<std::string, std::string>;

/// A name that trials have, and what there is to know of it.
struct StoredName {
  std::string name;
  std::string detail;
  bool is_current = true;  ///< Else it is of the experiment as it once was, and in no report.
};

/// What a store says of its trials, all that a report needs beside them.
struct StoreHeader {
  Provenance provenance;
  std::string manifest;  ///< JSON of manifest.json, without its host.
  int trials = 0;        ///< Per variant, scene and sensor; those beyond are not current.
  std::vector<StoredName> variants;  ///< In report order, with the JSON of their pipelines.
  std::vector<StoredName> scenes;    ///< In report order, with their kinds.
  std::vector<StoredName> sensors;   ///< In report order, with the sensors they are calibrated to.
};

/// SQL that makes the header's tables where they are missing.
std::string header_tables();

/// The header of the store; without provenance where none was written yet.
StoreHeader read_header(const Database& database);

/// Writes the header. A variant, scene or sensor that the store has and `header` lacks stays, but
/// is no longer current. The store is not in order from then on.
void write_header(Database& database, const StoreHeader& header);

/// Whether nothing was written since the store was put in order.
bool is_in_order(const Database& database);

/// SQL that fills the empty header of main from the attached store `from`, in order.
std::string copy_of_header(const std::string& from);

/// Whether the two say the same.
bool is_same(const StoreHeader& a, const StoreHeader& b);

/// `a` with the variants, scenes and sensors of `b` that it lacks behind its own.
StoreHeader united(StoreHeader a, const StoreHeader& b);

}  // namespace croon::experiments
