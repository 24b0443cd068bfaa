#include "experiments/store/bounded_json.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace croon::experiments {

template <class Json>
Json parse_bounded(const std::string& text) {
  constexpr int kDeepest = 100;
  return Json::parse(text, [](int depth, typename Json::parse_event_t, Json&) {
    if (depth > kDeepest) throw std::runtime_error("its JSON is nested too deeply");
    return true;
  });
}

template <class Json>
Json parsed_or_discarded(const std::string& text) {
  try {
    return parse_bounded<Json>(text);
  } catch (const std::exception&) {
    return Json(Json::value_t::discarded);
  }
}

template nlohmann::json parse_bounded(const std::string& text);
template nlohmann::ordered_json parse_bounded(const std::string& text);
template nlohmann::json parsed_or_discarded(const std::string& text);
template nlohmann::ordered_json parsed_or_discarded(const std::string& text);

}  // namespace croon::experiments
