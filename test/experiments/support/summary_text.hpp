#pragma once

#include <string>

#include "experiments/report/result_sections.hpp"
#include "framework/document/renderers.hpp"

namespace croon::test {

/// The summary as `croon run` prints it.
inline std::string summary_text(const experiments::Summary& summary, bool colours = false) {
  experiments::Results results;
  results.summary = summary;
  return text_section(experiments::summary_section(results), colours);
}

}  // namespace croon::test
