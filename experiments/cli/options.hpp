#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {

// Options that several commands share, and the checks of their values.

/// Why `text` is not what the option `name` expects; empty if it is. Empty text is refused: an
/// unset variable of a script must not mean the default. An option name is refused too: if such a
/// variable is unquoted, the next option takes the place of the value.
std::string why_no_text(const std::string& name, const std::string& text, const std::string& what);

/// Adds an option for text, or for a list of texts. `what` describes the expected value: "a path".
template <class T>
CLI::Option* add_text(CLI::App& command, const std::string& name, T& option,
                      const std::string& sentence, const std::string& what) {
  return command.add_option(name, option, sentence)->check([name, what](const std::string& text) {
    return why_no_text(name, text, what);
  });
}

/// Adds an option for a path, or for a list of paths.
template <class T>
CLI::Option* add_path(CLI::App& command, const std::string& name, T& option,
                      const std::string& sentence) {
  return add_text(command, name, option, sentence, "a path");
}

/// A word of small letters a to z in capitals.
std::string capitals(const std::string& word);

template <class Number>
CLI::Option* add_number(CLI::App& command, const std::string& name, std::optional<Number>& option,
                        Number min, Number max, const std::string& sentence) {
  // Range accepts NaN.
  const auto why_no_number = [](const std::string& text) {
    const bool has_digit =
        std::any_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    return has_digit ? std::string() : "expected a number, found \"" + printable(text) + "\"";
  };
  return command.add_option(name, option, sentence)
      ->check(why_no_number)
      ->check(CLI::Range(min, max));
}

/// EXPERIMENT and --with.
void add_experiment(CLI::App& command, std::filesystem::path& experiment,
                    std::vector<std::filesystem::path>& workloads);
void add_data(CLI::App& command, std::filesystem::path& option);
void add_jobs(CLI::App& command, int& option);
void add_trials(CLI::App& command, int& option, const std::string& sentence);
/// --width, the width of a figure.
void add_width(CLI::App& command, std::string& option);

/// The row called `name`. Throws InputError for the option `option` if there is none.
template <class Row>
const Row& called(const std::string& option, const std::string& name,
                  const std::vector<Row>& rows) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    if (name == row.name) return row;
    names.emplace_back(row.name);
  }
  throw InputError("", option,
                   "unknown " + option.substr(2) + " \"" + name + "\"" + name_hint(name, names));
}

/// The names of `rows`: "csv, json".
template <class Row>
std::string names_of(const std::vector<Row>& rows) {
  std::string names;
  for (const Row& row : rows) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

}  // namespace croon::experiments
