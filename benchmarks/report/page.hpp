#pragma once

#include <string>
#include <vector>

#include "benchmarks/report/measurements.hpp"
#include "framework/picture/drawing.hpp"

namespace croon::benchmarks {

/// A picture on the page, and its file name.
struct PagePicture {
  std::string name;
  Drawing drawing;
};

/// A page of docs/notebook: tables and pictures of runs, with separate tables for each run.
struct Page {
  std::string markdown;
  std::vector<PagePicture> pictures;
};

/// The page of `runs` with all tables that are not in the summary. A table never mixes times of two
/// runs. `date`, "2026-11-30", is in its title.
Page page_of(const std::vector<BenchmarkRun>& runs, const std::string& date);

}  // namespace croon::benchmarks
