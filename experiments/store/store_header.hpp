#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/run/trial_record.hpp"
#include "experiments/store/build.hpp"
#include "experiments/store/database.hpp"
#include "experiments/store/trial_rows.hpp"

namespace croon::experiments {

/// Everything that determines the result of every trial of a run, by name ("starts", "inputs"), as
/// JSON or as a digest. Pipelines are not included: a pipeline affects only the results of its
/// variant.
using Provenance = std::map<std::string, std::string>;

/// The name of a variant, scene or sensor, with one property.
struct StoredName {
  std::string name;
  std::string detail;
  bool is_current = true;  ///< If not, the experiment no longer has it and reports omit it.
};

/// The data of a store besides its trials: everything else that a report needs.
struct StoreHeader {
  Provenance provenance;
  params::StageVersions versions;  ///< Versions of the stages of the trials; see versions_of.
  std::vector<Build> builds;       ///< Builds that wrote to the store.
  std::string manifest;            ///< JSON of manifest.json, without "host" and the builds.
  int trials = 0;  ///< Per variant, scene and sensor; larger trial numbers are not current.
  std::vector<StoredName> variants;  ///< In report order, with the JSON of their pipelines.
  std::vector<StoredName> scenes;    ///< In report order, with their kinds.
  std::vector<StoredName>
      sensors;  ///< In report order, with the sensors that they are calibrated to.
};

/// Reads the header; without provenance if none has been written.
StoreHeader read_header(const Database& database);

/// Writes the header. A variant, scene or sensor that is only in the store remains there, but is no
/// longer current. Afterwards the store is not in order.
void write_header(Database& database, const StoreHeader& header);

/// Whether the store is in order: unchanged since it was sorted.
bool is_in_order(const Database& database);

/// SQL that fills the empty header of main from the attached store `from`, in order.
std::string copy_of_header(const std::string& from);

/// Whether the two headers are equal.
bool is_same(const StoreHeader& a, const StoreHeader& b);

/// `a`, followed by the variants, scenes and sensors that only `b` has.
StoreHeader united(StoreHeader a, const StoreHeader& b);

/// `requested` with the versions and builds of `stored`: the header of a store in which a run that
/// requests `requested` continues.
StoreHeader continued(const StoreHeader& stored, StoreHeader requested);

/// The ids of the names in `table`: variants, scenes or sensors.
std::map<std::string, std::int64_t> ids_of(const Database& database, const std::string& table);

/// Maps rows of a store to indices in its header.
class StoredIndices {
 public:
  StoredIndices(const Database& database, const StoreHeader& header);

  /// Finds the index of a trial. Returns false if the experiment no longer has it.
  bool find(const TrialRow& row, TrialIndex& index) const;

 private:
  /// The indices of current names, by id.
  using Indices = std::unordered_map<std::int64_t, std::size_t>;
  static Indices indices_of(const Database& database, const std::string& table,
                            const std::vector<StoredName>& names);

  Indices variants_, scenes_, sensors_;
};

/// The differences that prevent trials of `stored` and of `requested` from sharing a store, each as
/// "/starts/rotation_deg was 45 and is 30". A variant or stage that only one of them has is not a
/// difference, nor is the build.
std::vector<std::string> differences(const StoreHeader& stored, const StoreHeader& requested);

/// How to proceed if the results in a folder were made from different inputs.
inline constexpr const char* kFreshRemedy =
    "--fresh deletes them and starts over, --out writes elsewhere";

/// Throws InputError if there are `differences`. `file` is the store; `remedy` tells the user how
/// to proceed.
void refuse_differences(const std::string& file, const StoreHeader& stored,
                        const StoreHeader& requested, const std::string& remedy);

/// Throws InputError if the trials of `stored` were made by other builds than those of `requested`.
void refuse_other_builds(const std::string& file, const StoreHeader& stored,
                         const StoreHeader& requested, const std::string& remedy);

}  // namespace croon::experiments
