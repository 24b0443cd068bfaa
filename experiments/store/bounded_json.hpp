#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace croon::experiments {

/// Parses the JSON `text` of a store as nlohmann::json or nlohmann::ordered_json. Throws
/// std::exception if it is not JSON, or nested so deeply that writing it again would overflow the
/// stack.
template <class Json = nlohmann::json>
Json parse_bounded(const std::string& text);

/// The same, but returns a discarded value instead of throwing.
template <class Json = nlohmann::json>
Json parsed_or_discarded(const std::string& text);

}  // namespace croon::experiments
