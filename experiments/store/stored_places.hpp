#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "experiments/run/trial_record.hpp"
#include "experiments/store/record_row.hpp"
#include "experiments/store/store_header.hpp"

namespace croon::experiments {

/// The ids that `table`, one of variants, scenes and sensors, has for names.
std::map<std::string, std::int64_t> ids_of(const Database& database, const std::string& table);

/// Turns rows of a store into places in a header.
class StoredPlaces {
 public:
  StoredPlaces(const Database& database, const StoreHeader& header);

  /// The place of a trial; false where the experiment has it no more. Throws std::out_of_range
  /// where the store has no such name.
  bool find(const TrialRow& row, TrialPlace& place) const;

 private:
  std::vector<std::int64_t> variants_, scenes_, sensors_;  ///< Places by ids, -1 for none.
};

}  // namespace croon::experiments
