#pragma once

#include <optional>
#include <string>

namespace croon {

/// Why a pose must not be trusted: the reasons of steps before, if there are any, and then
/// `reason`.
inline std::string with_reason(const std::optional<std::string>& before,
                               const std::string& reason) {
  return before ? *before + "; " + reason : reason;
}

/// The reasons `after` a step that had `before`: what the step adds begins with its `name`.
inline std::string with_name(const std::optional<std::string>& before, const std::string& after,
                             const std::string& name) {
  if (after == before) return after;
  const std::string kept = before ? *before + "; " : "";
  const bool goes_on = after.compare(0, kept.size(), kept) == 0;
  return goes_on ? kept + name + ": " + after.substr(kept.size()) : name + ": " + after;
}

}  // namespace croon
