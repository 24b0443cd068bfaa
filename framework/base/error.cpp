#include "framework/base/error.hpp"

#include <set>
#include <utility>

namespace croon {
namespace {

std::string joined_lines(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += '\n';
    text += fault.line();
  }
  return text;
}

}  // namespace

std::string Fault::line() const {
  std::string text;
  if (!file.empty()) text += file + ": ";
  if (!where.empty()) text += where + ": ";
  text += message;
  // What the user wrote may hold line breaks; a fault is one line all the same.
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  }
  return text;
}

void collect_faults(std::vector<Fault>& faults, const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    faults.insert(faults.end(), error.faults().begin(), error.faults().end());
  }
}

std::vector<Fault> without_repeats(const std::vector<Fault>& faults) {
  std::vector<Fault> once;
  std::set<std::string> lines;
  for (const Fault& fault : faults) {
    if (lines.insert(fault.line()).second) once.push_back(fault);
  }
  return once;
}

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(joined_lines(faults)), faults_(std::move(faults)) {}

InputError::InputError(std::string file, std::string where, std::string message)
    : InputError(std::vector<Fault>{Fault{std::move(file), std::move(where), std::move(message)}}) {
}

}  // namespace croon
