#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/report/experiment_report.hpp"
#include "experiments/report/panels.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

/// A step of a variant.
struct DrawnStep {
  std::string name;
  std::string parameters;  ///< Canonical JSON, to find differences.
};

struct DrawnPipeline {
  std::string variant;
  std::vector<DrawnStep> steps;
};

std::vector<DrawnPipeline> pipelines_in(const std::string& manifest) {
  std::vector<DrawnPipeline> pipelines;
  const auto json = nlohmann::ordered_json::parse(manifest);
  for (const auto& variant : json.at("experiment").at("variants")) {
    DrawnPipeline pipeline{variant.at("name"), {}};
    for (const auto& step : variant.at("pipeline")) {
      pipeline.steps.push_back({step.at("name"), step.dump()});
    }
    pipelines.push_back(std::move(pipeline));
  }
  return pipelines;
}

bool is_in(const DrawnPipeline& pipeline, const DrawnStep& step) {
  return std::any_of(pipeline.steps.begin(), pipeline.steps.end(), [&](const DrawnStep& other) {
    return other.name == step.name && other.parameters == step.parameters;
  });
}

}  // namespace

Drawing pipeline_chart(const std::string& manifest, const Sheet& sheet) {
  constexpr std::size_t kMaxShown = 12;
  std::vector<DrawnPipeline> pipelines = pipelines_in(manifest);
  const bool is_cut = pipelines.size() > kMaxShown;
  if (is_cut) pipelines.resize(kMaxShown);
  const double text = sheet.small();
  const double width = figure_width(sheet);
  const double gap = 1.4 * text, box_height = 2.2 * text, line_height = 3.0 * text;
  // The layout first, because the number of lines determines the height.
  struct Box {
    double x, y, width;
    std::size_t pipeline, step;
  };
  std::vector<Box> boxes;
  double y = 0.5 * text;
  std::vector<double> title_y;
  for (std::size_t p = 0; p < pipelines.size(); ++p) {
    title_y.push_back(y + text);
    y += 1.6 * text;
    double x = text;
    for (std::size_t s = 0; s < pipelines[p].steps.size(); ++s) {
      const double box_width = text_width(pipelines[p].steps[s].name, text) + 1.2 * text;
      if (x + box_width > width - text && x > text) {
        x = 2.0 * text;
        y += line_height;
      }
      boxes.push_back({x, y, box_width, p, s});
      x += box_width + gap;
    }
    y += line_height + 0.6 * text;
  }
  Drawing drawing(width, y + (is_cut ? 1.5 * text : 0.0), sheet);
  drawing.describe("The steps of each variant");
  drawing.rectangle(0.0, 0.0, width, drawing.height(), "page");
  for (std::size_t p = 0; p < pipelines.size(); ++p) {
    drawing.text(text, title_y[p], cut_in_the_middle(printable(pipelines[p].variant), 90),
                 Anchor::start, "sensor");
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = boxes[i];
    const DrawnStep& step = pipelines[box.pipeline].steps[box.step];
    const bool is_new = box.pipeline > 0 && !is_in(pipelines.front(), step);
    drawing.rectangle(box.x, box.y, box.width, box_height, is_new ? "box c1" : "box c0");
    drawing.text(box.x + box.width / 2.0, box.y + 1.45 * text,
                 (is_new ? "* " : "") + printable(step.name), Anchor::middle, "small");
    const bool is_last = i + 1 == boxes.size() || boxes[i + 1].pipeline != box.pipeline;
    if (is_last || boxes[i + 1].y != box.y) continue;
    const double middle = box.y + box_height / 2.0;
    drawing.line(box.x + box.width, middle, boxes[i + 1].x, middle, "zero");
    drawing.area({{boxes[i + 1].x, middle},
                  {boxes[i + 1].x - 0.5 * text, middle - 0.3 * text},
                  {boxes[i + 1].x - 0.5 * text, middle + 0.3 * text}},
                 "bar");
  }
  if (is_cut) {
    drawing.text(text, drawing.height() - 0.5 * text,
                 "and further variants; manifest.json has all of them", Anchor::start, "small");
  }
  return drawing;
}

}  // namespace croon::experiments
