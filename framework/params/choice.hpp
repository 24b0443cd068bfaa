#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "framework/params/table.hpp"

namespace croon::params {

/// The values of the enumeration `E`, each with its word in JSON, in the order of help and errors.
template <class E>
using Words = std::vector<std::pair<std::string, E>>;

/// Only the words of `words`.
template <class E>
std::vector<std::string> word_list(const Words<E>& words) {
  std::vector<std::string> list;
  for (const auto& [word, value] : words) list.push_back(word);
  return list;
}

/// The word for `value`. A value without a word is a std::logic_error.
template <class E>
const std::string& word_of(const Words<E>& words, E value) {
  for (const auto& [word, candidate] : words) {
    if (candidate == value) return word;
  }
  throw std::logic_error("a value of an enumeration has no word");
}

/// A value of the enumeration `E`; in JSON one of `words`.
template <class P, class E, class = std::enable_if_t<std::is_enum_v<E>>>
Parameter<P> choice(const std::string& key, E P::*member, const Words<E>& words,
                    const std::string& sentence) {
  const auto json = [=](const P& params) { return value_json(word_of(words, params.*member)); };
  const auto read = [=, list = word_list(words)](P& params, const Node& node, const StageBuilder&) {
    if (const auto index = read_word(node, list)) params.*member = words[*index].second;
  };
  return {{key, ParameterType::choice, json(P{}), {}, word_list(words), "", sentence},
          read,
          json,
          false};
}

/// A non-empty list of distinct values of the enumeration `E`; in JSON a list of `words`.
template <class P, class E, class = std::enable_if_t<std::is_enum_v<E>>>
Parameter<P> choices(const std::string& key, std::vector<E> P::*member, const Words<E>& words,
                     const std::string& sentence) {
  const auto json = [=](const P& params) {
    std::vector<std::string> list;
    for (const E value : params.*member) list.push_back(word_of(words, value));
    return value_json(list);
  };
  ParameterDoc doc{key, ParameterType::choices, json(P{}), {}, word_list(words), "", sentence};
  const auto read = [=](P& params, const Node& node, const StageBuilder&) {
    std::vector<E> values;
    for (const std::size_t index : read_words(node, doc.choices)) {
      values.push_back(words[index].second);
    }
    if (!values.empty()) params.*member = std::move(values);
  };
  return {doc, read, json, false};
}

}  // namespace croon::params
