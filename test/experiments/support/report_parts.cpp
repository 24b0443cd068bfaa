#include "test/experiments/support/report_parts.hpp"

#include <gtest/gtest.h>

#include <set>

#include "framework/document/renderers.hpp"
#include "test/experiments/support/readable.hpp"
#include "test/support/occurrences.hpp"

namespace croon::test {
namespace {

void add_ids(std::vector<std::string>& ids, const std::vector<Section>& sections) {
  for (const Section& section : sections) ids.push_back(section.id);
  for (const Section& section : sections) add_ids(ids, section.sections);
}

void add_charts(std::vector<Drawing>& charts, const std::vector<Section>& sections) {
  for (const Section& section : sections) {
    for (const Block& block : section.blocks) {
      if (const auto* chart = std::get_if<Chart>(&block)) charts.push_back(chart->drawing);
      const auto* row = std::get_if<FigureRow>(&block);
      if (row == nullptr) continue;
      for (const auto& figure : row->figures) {
        if (const auto* chart = std::get_if<Chart>(&figure)) charts.push_back(chart->drawing);
      }
    }
    add_charts(charts, section.sections);
  }
}

/// The number of scripts that a browser runs.
int running_scripts(const std::string& page) {
  int running = 0;
  for (std::size_t at = page.find("<script"); at != std::string::npos;) {
    const std::size_t begin = page.find('>', at) + 1, end = page.find("</script", begin);
    const std::string tag = page.substr(at, begin - at), body = page.substr(begin, end - begin);
    if (tag.find("type=") == std::string::npos) {
      ++running;
    } else {
      EXPECT_EQ(occurrences(body, "<!--") + occurrences(body, "<script"), 0U) << tag;
    }
    at = page.find("<script", end);
  }
  return running;
}

}  // namespace

std::vector<std::string> section_ids(const Document& document) {
  std::vector<std::string> ids;
  add_ids(ids, document.sections);
  return ids;
}

std::vector<Drawing> charts_in(const Document& document) {
  std::vector<Drawing> charts;
  add_charts(charts, document.sections);
  return charts;
}

std::string expect_sound_page(const Document& document) {
  const std::vector<std::string> ids = section_ids(document);
  for (const std::string& id : ids) EXPECT_NE(id, "");
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
  for (const Drawing& chart : charts_in(document)) {
    EXPECT_EQ(unreadable_parts(chart), std::vector<std::string>()) << chart.description();
  }
  if (!can_write_html()) return "";
  const std::string page = html_document(document);
  EXPECT_EQ(running_scripts(page), 3);
  return page;
}

}  // namespace croon::test
