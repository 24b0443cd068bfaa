#pragma once

#include <string>
#include <vector>

#include "benchmarks/report/measurements.hpp"
#include "framework/picture/drawing.hpp"

namespace croon::benchmarks {

/// A picture of the page, and the name of its file.
struct PagePicture {
  std::string name;
  Drawing drawing;
};

/// A page of docs/notebook: tables and pictures of runs, each run in tables of its own.
struct Page {
  std::string markdown;
  std::vector<PagePicture> pictures;
};

/// The page of `runs`. Times of two runs are never in one table.
Page page_of(const std::vector<BenchmarkRun>& runs);

}  // namespace croon::benchmarks
