#include "experiments/file/names.hpp"

#include <algorithm>
#include <string_view>

namespace croon::experiments {
namespace {

bool is_made_of(const std::string& name, std::string_view others) {
  const auto is_allowed = [others](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           others.find(c) != std::string_view::npos;
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_allowed);
}

}  // namespace

bool is_folder_name(const std::string& name) {
  return is_made_of(name, "_.-") && name.front() != '.';
}

bool is_step_name(const std::string& name) { return is_made_of(name, "_-"); }

bool is_variant_name(const std::string& name) {
  return is_made_of(name, "_.-+=() ") && name.front() != '.' && name.front() != ' ' &&
         name.back() != ' ';
}

}  // namespace croon::experiments
