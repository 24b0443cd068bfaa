#include "experiments/report/named_trials.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>

#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

bool is_variant_common(const std::vector<TrialRecord>& records) {
  return std::all_of(records.begin(), records.end(), [&](const TrialRecord& record) {
    return record.id.variant == records.front().id.variant;
  });
}

std::string name_without_variant(const TrialId& id) {
  return trial_name(id).substr(id.variant.size() + 1);
}

/// The number at the end of a name; 0 if there is none.
int number_at_end(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  const char* const begin = name.data() + (slash == std::string::npos ? 0 : slash + 1);
  int number = 0;
  std::from_chars(begin, name.data() + name.size(), number);
  return number;
}

/// Of each variant, scene and sensor, the stored trial whose number is nearest to that of `name`.
/// Names of all trials would be too many to compare.
std::vector<TrialId> nearest_trials(const std::string& name,
                                    const std::vector<TrialRecord>& records) {
  const std::int64_t number = number_at_end(name);
  std::vector<TrialId> nearest;
  for (const TrialRecord& record : records) {
    const TrialId& id = record.id;
    const bool is_next = nearest.empty() || nearest.back().sensor != id.sensor ||
                         nearest.back().scene != id.scene || nearest.back().variant != id.variant;
    if (is_next) {
      nearest.push_back(id);
    } else if (std::abs(id.trial - number) < std::abs(nearest.back().trial - number)) {
      nearest.back().trial = id.trial;
    }
  }
  return nearest;
}

/// `; did you mean "base/000001/left/0"?`, or what the names of the trials are like.
std::string trial_hint(const std::string& name, const std::vector<TrialRecord>& records,
                       bool is_variant_optional) {
  constexpr std::size_t kMaxListed = 8;
  std::vector<std::string> known;
  for (const TrialId& id : nearest_trials(name, records)) {
    const bool is_whole = !is_variant_optional || name.rfind(id.variant + "/", 0) == 0;
    known.push_back(is_whole ? trial_name(id) : name_without_variant(id));
  }
  if (known.size() > kMaxListed && nearest_name(name, known).empty()) {
    return "; one of them is " + in_quotes(known.front());
  }
  return name_hint(name, known);
}

}  // namespace

std::vector<const TrialRecord*> trials_called(const std::vector<std::string>& names,
                                              const std::vector<TrialRecord>& records) {
  const bool is_variant_optional = is_variant_common(records);
  std::vector<const TrialRecord*> found;
  std::vector<Fault> faults;
  for (const std::string& name : names) {
    bool is_known = false;
    for (const TrialRecord& record : records) {
      if (trial_name(record.id) != name &&
          !(is_variant_optional && name_without_variant(record.id) == name)) {
        continue;
      }
      is_known = true;
      if (std::find(found.begin(), found.end(), &record) == found.end()) found.push_back(&record);
    }
    if (is_known) continue;
    faults.push_back({"", kTrialOption,
                      "expected the name of a stored trial, VARIANT/SCENE/SENSOR/NUMBER, found " +
                          in_quotes(name) + trial_hint(name, records, is_variant_optional)});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return found;
}

}  // namespace croon::experiments
