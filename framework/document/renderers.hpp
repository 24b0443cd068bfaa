#pragma once

#include <string>

#include "framework/document/document.hpp"

namespace croon {

/// The document as one self-contained HTML file, without a link to any other resource. A
/// Content-Security-Policy allows only the scripts of this library to run, whatever names the data
/// contain. Same document, same bytes. Throws std::logic_error in a build without reports.
std::string html_document(const Document& document);

/// Whether this build can write HTML (`-DCROON_WITH_REPORT=ON`).
bool can_write_html();

/// The section for a terminal, in UTF-8, without figures. Its own title is omitted; the sections in
/// it have theirs.
std::string text_section(const Section& section, bool colours = false);

/// The section as Markdown (GitHub's dialect), without figures.
std::string markdown_section(const Section& section);

}  // namespace croon
