#include "experiments/store/store_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "experiments/file/start_rule.hpp"
#include "experiments/store/bounded_json.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

constexpr const char* kFormat = "5";
/// The entry of `meta` that marks an unordered store.
constexpr const char* kUnordered = "unordered";

/// A table of names, and the corresponding member of the header.
struct NameTable {
  const char* name;
  const char* detail;
  std::vector<StoredName> StoreHeader::*names;
};

constexpr std::array<NameTable, 3> kNameTables = {
    {{"variants", "pipeline", &StoreHeader::variants},
     {"scenes", "kind", &StoreHeader::scenes},
     {"sensors", "reference", &StoreHeader::sensors}}};

void write_names(Database& database, const NameTable& table, const StoreHeader& header) {
  const std::string name = table.name;
  database.run("UPDATE " + name + " SET place = NULL");
  const std::string detail = table.detail;
  Statement upsert =
      database.prepare("INSERT INTO " + name + "(name, " + detail +
                       ", place) VALUES(?1, ?2, ?3) ON CONFLICT(name) DO UPDATE SET " + detail +
                       " = ?2, place = ?3");
  std::int64_t position = 0;
  for (const StoredName& stored : header.*table.names) {
    upsert.reset();
    upsert.bind(0, stored.name);
    upsert.bind(1, stored.detail);
    if (stored.is_current) upsert.bind(2, position++);
    upsert.next();
  }
}

std::vector<StoredName> read_names(const Database& database, const NameTable& table) {
  std::vector<StoredName> names;
  Statement select =
      database.prepare("SELECT name, " + std::string(table.detail) + ", place FROM " + table.name +
                       " ORDER BY place IS NULL, place, name");
  while (select.next()) names.push_back({select.text(0), select.text(1), !select.is_null(2)});
  return names;
}

/// Removes `name` from `meta` and returns its value; empty if missing.
std::string taken(Provenance& meta, const std::string& name) {
  const auto node = meta.extract(name);
  return node.empty() ? "" : node.mapped();
}

void add_missing(std::vector<StoredName>& to, const std::vector<StoredName>& from) {
  std::unordered_map<std::string, std::size_t> indices;
  for (std::size_t i = 0; i < to.size(); ++i) indices.emplace(to[i].name, i);
  for (const StoredName& stored : from) {
    const auto [entry, is_new] = indices.emplace(stored.name, to.size());
    if (is_new) {
      to.push_back(stored);
    } else if (stored.is_current) {
      // Regardless of the order of folders, a name that is current in any of them is current.
      to[entry->second].is_current = true;
    }
  }
}

/// The number of trials in `text`.
int trials_of(const std::string& text) {
  int trials = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, trials);
  if (read.ec != std::errc() || read.ptr != end || trials < 1 || trials > kMaxTrials) {
    throw std::runtime_error("its number of trials is \"" + text + "\"");
  }
  return trials;
}

using nlohmann::json;

constexpr std::size_t kShownDifferences = 3;
constexpr std::size_t kShownCharacters = 60;

/// `value` on one line, truncated if it is long.
std::string shown(const json& value) {
  const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  return text.size() <= kShownCharacters ? text : text.substr(0, kShownCharacters) + "...";
}

/// A JSON pointer in readable form: "~1" is a slash in a file name.
std::string readable(std::string pointer) {
  for (std::size_t at = pointer.find("~1"); at != std::string::npos; at = pointer.find("~1", at)) {
    pointer.replace(at, 2, "/");
  }
  return pointer;
}

/// Adds the differences of two JSON texts, with pointers below `where`.
void add_differences(std::vector<std::string>& to, const std::string& where,
                     const std::string& stored, const std::string& requested) {
  if (stored == requested) return;
  const json was = parsed_or_discarded(stored);
  const json is = parsed_or_discarded(requested);
  if (was.is_discarded() || is.is_discarded()) {
    to.push_back(where + " differs");
    return;
  }
  for (const json& change : json::diff(was, is)) {
    const json::json_pointer pointer(change["path"].get<std::string>());
    std::string text = where + readable(pointer.to_string());
    if (change["op"] == "add") text += " was missing and is " + shown(change["value"]);
    if (change["op"] == "remove") text += " was " + shown(was[pointer]) + " and is missing";
    if (change["op"] == "replace") {
      text += " was " + shown(was[pointer]) + " and is " + shown(change["value"]);
    }
    to.push_back(text);
  }
}

}  // namespace

std::map<std::string, std::int64_t> ids_of(const Database& database, const std::string& table) {
  std::map<std::string, std::int64_t> ids;
  Statement select = database.prepare("SELECT name, id FROM " + table);
  while (select.next()) ids[select.text(0)] = select.integer(1);
  return ids;
}

StoredIndices::StoredIndices(const Database& database, const StoreHeader& header)
    : variants_(indices_of(database, "variants", header.variants)),
      scenes_(indices_of(database, "scenes", header.scenes)),
      sensors_(indices_of(database, "sensors", header.sensors)) {}

StoredIndices::Indices StoredIndices::indices_of(const Database& database, const std::string& table,
                                                 const std::vector<StoredName>& names) {
  const std::map<std::string, std::int64_t> ids = ids_of(database, table);
  Indices indices;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto id = ids.find(names[i].name);
    if (id != ids.end() && names[i].is_current) indices[id->second] = i;
  }
  return indices;
}

bool StoredIndices::find(const TrialRow& row, TrialIndex& index) const {
  const auto variant = variants_.find(row.variant), scene = scenes_.find(row.scene),
             sensor = sensors_.find(row.sensor);
  if (variant == variants_.end() || scene == scenes_.end() || sensor == sensors_.end()) {
    return false;
  }
  index = {variant->second, scene->second, sensor->second, row.trial};
  return true;
}

StoreHeader read_header(const Database& database) {
  StoreHeader header;
  // A store killed before its first commit has no tables.
  if (!database.prepare("SELECT 1 FROM sqlite_master WHERE name = 'meta'").next()) return header;
  Statement select = database.prepare("SELECT name, value FROM meta");
  while (select.next()) header.provenance[select.text(0)] = select.text(1);
  if (header.provenance.empty()) return header;
  const std::string format = taken(header.provenance, "format");
  if (format != kFormat) {
    throw InputError(database.file(), "",
                     "is a store of format \"" + format + "\", expected \"" + kFormat +
                         "\", of another version of croon; croon run --fresh starts over");
  }
  header.manifest = taken(header.provenance, "manifest");
  header.versions = read_versions(taken(header.provenance, "versions"));
  header.builds = read_builds(taken(header.provenance, "builds"));
  header.trials = trials_of(taken(header.provenance, "trials"));
  taken(header.provenance, kUnordered);
  if (header.provenance.empty()) {
    throw std::runtime_error("its header has no provenance of its trials");
  }
  for (const NameTable& table : kNameTables) header.*table.names = read_names(database, table);
  return header;
}

void write_header(Database& database, const StoreHeader& header) {
  Transaction transaction(database);
  database.run("DELETE FROM meta");
  Statement insert = database.prepare("INSERT INTO meta VALUES(?, ?)");
  Provenance meta = header.provenance;
  meta["format"] = kFormat;
  meta["manifest"] = header.manifest;
  meta["versions"] = versions_json(header.versions);
  meta["builds"] = builds_json(header.builds);
  meta["trials"] = std::to_string(header.trials);
  meta[kUnordered] = "yes";
  for (const auto& [name, value] : meta) {
    insert.reset();
    insert.bind(0, name);
    insert.bind(1, value);
    insert.next();
  }
  for (const NameTable& table : kNameTables) write_names(database, table, header);
  transaction.commit();
}

bool is_in_order(const Database& database) {
  Statement select = database.prepare("SELECT 1 FROM meta WHERE name = ?");
  select.bind(0, kUnordered);
  return !select.next();
}

std::string copy_of_header(const std::string& from) {
  std::string sql = "INSERT INTO main.meta SELECT * FROM " + from + ".meta WHERE name <> '" +
                    kUnordered + "' ORDER BY name;";
  for (const NameTable& table : kNameTables) {
    sql += std::string("INSERT INTO main.") + table.name + " SELECT NULL, name, " + table.detail +
           ", place FROM " + from + "." + table.name + " ORDER BY place IS NULL, place, name;";
  }
  return sql;
}

bool is_same(const StoreHeader& a, const StoreHeader& b) {
  const auto is_same_name = [](const StoredName& x, const StoredName& y) {
    return std::tie(x.name, x.detail, x.is_current) == std::tie(y.name, y.detail, y.is_current);
  };
  return a.provenance == b.provenance && a.versions == b.versions && is_same(a.builds, b.builds) &&
         a.manifest == b.manifest && a.trials == b.trials &&
         std::all_of(kNameTables.begin(), kNameTables.end(), [&](const NameTable& table) {
           const auto& x = a.*table.names;
           const auto& y = b.*table.names;
           return std::equal(x.begin(), x.end(), y.begin(), y.end(), is_same_name);
         });
}

StoreHeader united(StoreHeader a, const StoreHeader& b) {
  for (const NameTable& table : kNameTables) add_missing(a.*table.names, b.*table.names);
  return continued(b, std::move(a));
}

StoreHeader continued(const StoreHeader& stored, StoreHeader requested) {
  requested.versions.insert(stored.versions.begin(), stored.versions.end());
  requested.builds = united(std::move(requested.builds), stored.builds);
  return requested;
}

std::vector<std::string> differences(const StoreHeader& stored, const StoreHeader& requested) {
  std::vector<std::string> found;
  Provenance names = requested.provenance;
  names.insert(stored.provenance.begin(), stored.provenance.end());
  const auto value = [](const Provenance& of, const std::string& name) {
    const auto entry = of.find(name);
    return entry == of.end() ? std::string("null") : entry->second;
  };
  for (const auto& [name, any] : names) {
    const std::string was = value(stored.provenance, name), is = value(requested.provenance, name);
    add_differences(found, "/" + name, was, is);
  }
  for (const auto& [stage, version] : requested.versions) {
    const auto was = stored.versions.find(stage);
    if (was == stored.versions.end() || was->second == version) continue;
    found.push_back("version of " + stage + " was " + std::to_string(was->second) + " and is " +
                    std::to_string(version));
  }
  std::unordered_map<std::string, const std::string*> pipelines;
  for (const StoredName& variant : stored.variants) {
    pipelines.emplace(variant.name, &variant.detail);
  }
  for (const StoredName& variant : requested.variants) {
    const auto was = pipelines.find(variant.name);
    if (was == pipelines.end()) continue;
    add_differences(found, "/variants/" + variant.name, *was->second, variant.detail);
  }
  return found;
}

void refuse_differences(const std::string& file, const StoreHeader& stored,
                        const StoreHeader& requested, const std::string& remedy) {
  const std::vector<std::string> found = differences(stored, requested);
  if (found.empty()) return;
  std::string text;
  for (std::size_t i = 0; i < found.size() && i < kShownDifferences; ++i) {
    text += (i == 0 ? "" : "; ") + found[i];
  }
  if (found.size() > kShownDifferences) {
    text += "; and " + std::to_string(found.size() - kShownDifferences) + " more";
  }
  throw InputError(file, "", "its trials were made from different inputs: " + text + "; " + remedy);
}

void refuse_other_builds(const std::string& file, const StoreHeader& stored,
                         const StoreHeader& requested, const std::string& remedy) {
  if (stored.builds.empty() || is_same(stored.builds, requested.builds)) return;
  // One of several builds may be the requested one.
  const auto other =
      std::find_if(stored.builds.begin(), stored.builds.end(), [&](const Build& build) {
        return std::none_of(requested.builds.begin(), requested.builds.end(),
                            [&](const Build& same) { return is_same({build}, {same}); });
      });
  const Build& shown = other == stored.builds.end() ? stored.builds.front() : *other;
  throw InputError(file, "",
                   "its trials were made by another build of croon, of commit " + shown.commit +
                       ", and --same-build was given; " + remedy);
}

}  // namespace croon::experiments
