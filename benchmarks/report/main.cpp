// Writes benchmarks.md and its pictures to a folder: benchmark_report FOLDER FILE...
#include <iostream>

#include "benchmarks/report/page.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/picture/writers.hpp"

int main(int argc, char** argv) {
  using namespace croon;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 2) {
    std::cerr << "usage: benchmark_report FOLDER FILE...\n";
    return 2;
  }
  try {
    std::vector<benchmarks::BenchmarkRun> runs;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
      runs.push_back(benchmarks::read_run(arguments[i]));
    }
    const benchmarks::Page page = benchmarks::page_of(runs);
    const std::filesystem::path folder = arguments[0];
    for (const benchmarks::PagePicture& picture : page.pictures) {
      write_whole_file(folder / "pictures" / picture.name, svg_bytes(picture.drawing));
    }
    write_whole_file(folder / "benchmarks.md", page.markdown);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) std::cerr << fault.line() << '\n';
    return 2;
  }
  return 0;
}
