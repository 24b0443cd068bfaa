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

/// What decides the result of every trial of a run, by name ("starts", "inputs"), as JSON or as a
/// digest. Pipelines are not in it: a pipeline decides the results of its variant only.
using Provenance = std::map<std::string, std::string>;

/// The name of a variant, scene or sensor, with one property of it.
struct StoredName {
  std::string name;
  std::string detail;
  bool is_current = true;  ///< Else the experiment no longer has it, and no report shows it.
};

/// What a store has beside its trials: all that a report needs.
struct StoreHeader {
  Provenance provenance;
  params::StageVersions versions;  ///< Of the stages that decided the trials; see versions_of.
  std::vector<Build> builds;       ///< That wrote to it.
  std::string manifest;  ///< JSON of manifest.json, without "host" and what the builds say.
  int trials = 0;  ///< Per variant, scene and sensor. Trials with larger numbers are not current.
  std::vector<StoredName> variants;  ///< In report order, with the JSON of their pipelines.
  std::vector<StoredName> scenes;    ///< In report order, with their kinds.
  std::vector<StoredName>
      sensors;  ///< In report order, with the sensors that they are calibrated to.
};

/// Reads the header; without provenance if none was written yet.
StoreHeader read_header(const Database& database);

/// Writes the header. A variant, scene or sensor that is only in the store stays there, but is no
/// longer current. After this the store is not in order.
void write_header(Database& database, const StoreHeader& header);

/// Whether the store is in order: nothing was written since it was sorted.
bool is_in_order(const Database& database);

/// SQL that fills the empty header of main from the attached store `from`, in order.
std::string copy_of_header(const std::string& from);

/// Whether the two headers are equal.
bool is_same(const StoreHeader& a, const StoreHeader& b);

/// `a`, followed by the variants, scenes and sensors that only `b` has.
StoreHeader united(StoreHeader a, const StoreHeader& b);

/// `asked` with the versions and the builds of `stored`: what the header becomes when a run that
/// asks for `asked` goes on in a store.
StoreHeader continued(const StoreHeader& stored, StoreHeader asked);

/// The ids of the names in `table`, which is variants, scenes or sensors.
std::map<std::string, std::int64_t> ids_of(const Database& database, const std::string& table);

/// Maps rows of a store to indices in its header.
class StoredIndices {
 public:
  StoredIndices(const Database& database, const StoreHeader& header);

  /// Finds the index of a trial. Returns false if the experiment no longer has it.
  bool find(const TrialRow& row, TrialIndex& index) const;

 private:
  /// The indices of current names by their ids.
  using Indices = std::unordered_map<std::int64_t, std::size_t>;
  static Indices indices_of(const Database& database, const std::string& table,
                            const std::vector<StoredName>& names);

  Indices variants_, scenes_, sensors_;
};

/// The differences that keep the trials of `stored` and of `asked` apart, each as
/// "/starts/rotation_deg was 45 and is 30". A variant or a stage that only one of them has is no
/// difference, and neither is the build.
std::vector<std::string> differences(const StoreHeader& stored, const StoreHeader& asked);

/// What a user can do about results of something else.
inline constexpr const char* kFreshRemedy =
    "--fresh deletes them and starts over, --out writes elsewhere";

/// Throws InputError if there are `differences`. `file` is the store;
/// `remedy` says what the user can do.
void refuse_differences(const std::string& file, const StoreHeader& stored,
                        const StoreHeader& asked, const std::string& remedy);

/// Throws InputError if the trials of `stored` were made by other builds than those of `asked`.
void refuse_other_builds(const std::string& file, const StoreHeader& stored,
                         const StoreHeader& asked, const std::string& remedy);

}  // namespace croon::experiments
