#include "experiments/store/stored_places.hpp"

#include <algorithm>

namespace croon::experiments {
namespace {

/// The places of current names in a header, by their ids; -1 for those that have none.
std::vector<std::int64_t> places_of(const Database& database, const std::string& table,
                                    const std::vector<StoredName>& names) {
  const std::map<std::string, std::int64_t> ids = ids_of(database, table);
  std::int64_t largest = 0;
  for (const auto& [name, id] : ids) largest = std::max(largest, id);
  std::vector<std::int64_t> places(static_cast<std::size_t>(largest) + 1, -1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto id = ids.find(names[i].name);
    if (id == ids.end() || !names[i].is_current) continue;
    places[static_cast<std::size_t>(id->second)] = static_cast<std::int64_t>(i);
  }
  return places;
}

}  // namespace

std::map<std::string, std::int64_t> ids_of(const Database& database, const std::string& table) {
  std::map<std::string, std::int64_t> ids;
  Statement select = database.prepare("SELECT name, id FROM " + table);
  while (select.next()) ids[select.text(0)] = select.integer(1);
  return ids;
}

StoredPlaces::StoredPlaces(const Database& database, const StoreHeader& header)
    : variants_(places_of(database, "variants", header.variants)),
      scenes_(places_of(database, "scenes", header.scenes)),
      sensors_(places_of(database, "sensors", header.sensors)) {}

bool StoredPlaces::find(const TrialRow& row, TrialPlace& place) const {
  const std::int64_t variant = variants_.at(static_cast<std::size_t>(row.variant));
  const std::int64_t scene = scenes_.at(static_cast<std::size_t>(row.scene));
  const std::int64_t sensor = sensors_.at(static_cast<std::size_t>(row.sensor));
  place = {variant, scene, sensor, row.trial};
  return variant >= 0 && scene >= 0 && sensor >= 0;
}

}  // namespace croon::experiments
