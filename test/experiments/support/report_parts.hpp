#pragma once

#include <string>
#include <vector>

#include "framework/document/document.hpp"

namespace croon::test {

/// The ids of all sections, outer ones first.
std::vector<std::string> section_ids(const Document& document);

/// All charts of the document, also those in rows of figures.
std::vector<Drawing> charts_in(const Document& document);

/// Expects a readable page: unique ids, readable charts, exactly the three scripts of the program
/// that a browser runs, and no tag in data scripts that could end or nest them. Returns its HTML.
std::string expect_sound_page(const Document& document);

}  // namespace croon::test
