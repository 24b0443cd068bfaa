#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace croon::experiments {

/// The JSON `text` of a store, as nlohmann::json or nlohmann::ordered_json. Throws std::exception
/// if it is no JSON, or if it is nested so deeply that writing it again would exhaust the stack.
template <class Json = nlohmann::json>
Json parse_bounded(const std::string& text);

/// The same; a discarded value where `parse_bounded` throws.
template <class Json = nlohmann::json>
Json parsed_or_discarded(const std::string& text);

}  // namespace croon::experiments
