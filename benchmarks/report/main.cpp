// Writes benchmarks.md to the folder DOCS, and DATE-what-each-part-costs.md with its pictures to
// DOCS/notebook: benchmark_report DOCS DATE FILE...
#include <iostream>

#include "benchmarks/report/page.hpp"
#include "benchmarks/report/summary.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/picture/writers.hpp"

int main(int argc, char** argv) {
  using namespace croon;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 3) {
    std::cerr << "usage: benchmark_report DOCS DATE FILE...\n";
    return 2;
  }
  try {
    std::vector<benchmarks::BenchmarkRun> runs;
    for (std::size_t i = 2; i < arguments.size(); ++i) {
      runs.push_back(benchmarks::read_run(arguments[i]));
    }
    const std::string& date = arguments[1];
    const benchmarks::Page page = benchmarks::page_of(runs, date);
    const std::filesystem::path docs = arguments[0];
    const std::string tables = "notebook/" + date + "-what-each-part-costs.md";
    for (const benchmarks::PagePicture& picture : page.pictures) {
      write_whole_file(docs / "notebook" / "pictures" / picture.name, svg_bytes(picture.drawing));
    }
    write_whole_file(docs / tables, page.markdown);
    write_whole_file(docs / "benchmarks.md", benchmarks::summary_of(runs, tables));
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) std::cerr << fault.line() << '\n';
    return 2;
  }
  return 0;
}
