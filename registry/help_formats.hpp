#pragma once

#include <string>
#include <vector>

#include "framework/stage/catalogue.hpp"

namespace croon {

/// Entries of a catalogue, by kind and then by name; they must outlive the list.
using StageList = std::vector<const StageEntry*>;

/// One line for each stage, in columns: kind, name, sentence.
std::string text_table(const StageList& stages);
/// All there is to know of one stage, for a terminal.
std::string text_page(const StageEntry& stage);

/// The stages with their parameters as a JSON array.
std::string json_list(const StageList& stages);

/// The index of the reference pages: the kinds and their stages, with links.
std::string markdown_index(const StageList& stages);
/// The reference page of a kind: each of its stages, `stages`, with its parameters.
std::string markdown_page(const StageList& stages);
/// One stage with its parameters.
std::string markdown_section(const StageEntry& stage);

}  // namespace croon
