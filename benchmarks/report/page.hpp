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

/// The page of `runs`. A table never mixes times of two runs.
Page page_of(const std::vector<BenchmarkRun>& runs);

}  // namespace croon::benchmarks
