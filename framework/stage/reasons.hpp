#pragma once

#include <optional>
#include <string>

namespace croon {

/// Appends `reason` to the reasons of earlier steps, if any, to reject a pose.
inline std::string with_reason(const std::optional<std::string>& before,
                               const std::string& reason) {
  return before ? *before + "; " + reason : reason;
}

/// The reasons `after` a step that had `before`: the part that the step added is prefixed with its
/// `name`.
inline std::string with_name(const std::optional<std::string>& before, const std::string& after,
                             const std::string& name) {
  if (after == before) return after;
  const std::string kept = before ? *before + "; " : "";
  const bool goes_on = after.compare(0, kept.size(), kept) == 0;
  return goes_on ? kept + name + ": " + after.substr(kept.size()) : name + ": " + after;
}

}  // namespace croon
