#pragma once

#include <string_view>

namespace croon {

// The parts that all HTML documents share. They are empty in a build without reports.

/// The style sheet.
std::string_view report_style();

/// The scripts, in the order in which they run: three.js, the viewer of clouds, the page.
std::string_view three_script();
std::string_view cloud_view_script();
std::string_view report_script();

}  // namespace croon
