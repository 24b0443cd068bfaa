#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/report/panels.hpp"

namespace croon::experiments {
namespace {

/// The summaries of all sensors together of one kind of scene, by the index of their variant.
struct KindBars {
  std::string kind;
  int scenes = 0;
  std::map<std::size_t, const SceneKindSummary*> of_variant;
};

std::vector<KindBars> kind_bars(const Summary& summary, const std::vector<std::string>& variants) {
  std::vector<KindBars> kinds;
  for (const SceneKindSummary& row : summary.scene_kinds) {
    if (!row.sensor.empty() || main_share(row).trials == 0) continue;
    const auto is_it = [&](const KindBars& bars) { return bars.kind == row.scene_kind; };
    auto found = std::find_if(kinds.begin(), kinds.end(), is_it);
    if (found == kinds.end()) found = kinds.insert(found, {row.scene_kind, 0, {}});
    const auto variant = std::find(variants.begin(), variants.end(), row.variant);
    found->of_variant[static_cast<std::size_t>(variant - variants.begin())] = &row;
    found->scenes = std::max(found->scenes, row.scene_count);
  }
  return kinds;
}

/// Draws the bar of a share, its marker and its interval at `x`.
void draw_share(Drawing& drawing, const Plot& plot, double x, double width, const Share& share,
                std::size_t series) {
  const double y = plot.y(share.ratio);
  draw_bar(drawing, x - width / 2.0, y, width, plot.y(0.0) - y, series);
  if (share.interval) {
    const std::string style = "line " + box_style(series);
    const double low = plot.y(share.interval->low);
    const double high = plot.y(share.interval->high);
    drawing.line(x, low, x, high, style);
    for (const double end : {low, high}) {
      drawing.line(x - 0.3 * width, end, x + 0.3 * width, end, style);
    }
  }
  draw_marker(drawing, x, y, std::min(0.25 * drawing.sheet().small(), 0.4 * width), series);
}

}  // namespace

Drawing kinds_chart(const Summary& summary, const FigureOptions& options) {
  constexpr double kUsed = 0.8;      // Share of the width of a kind that its bars use.
  constexpr double kMinPitch = 1.0;  // Of bars, in multiples of the size of text.
  const double text = options.sheet.small();
  const std::vector<std::string> variants = variants_of(summary);
  const std::vector<KindBars> kinds = kind_bars(summary, variants);
  std::vector<std::string> kind_labels;
  double min_width = kMinPitch / kUsed * text * static_cast<double>(variants.size());
  for (const KindBars& bars : kinds) {
    kind_labels.push_back(bars.kind + " (" + std::to_string(bars.scenes) + ")");
    min_width = std::max(min_width, text_width(kind_labels.back(), text) + text);
  }
  // Kinds that do not fit beside each other continue in the next panel.
  const auto fitting = static_cast<std::size_t>(
      std::max(1.0, std::floor(plot_width_of(options.sheet, 1) / min_width)));
  const std::size_t panels = (kinds.size() + fitting - 1) / fitting;
  const std::size_t per_panel = (kinds.size() + panels - 1) / std::max<std::size_t>(panels, 1);
  const bool has_truth =
      std::none_of(summary.scene_kinds.begin(), summary.scene_kinds.end(), lacks_truth);
  const std::string what = has_truth ? "Success" : "Agreement";
  const std::string explanation =
      "All sensors together; 95 % intervals over scenes (require at least " +
      std::to_string(kMinScenes) + " scenes)";
  const std::vector<std::string> labels = line_labels(variants);
  auto [grid, drawing] = panel_figure(options.sheet, what + " in % by kind of scene", explanation,
                                      panels, 1, is_wide(options.sheet) ? 0.25 : 0.5, labels);
  for (std::size_t p = 0; p < panels; ++p) {
    const Plot plot = plot_of(grid, p, {0.0, static_cast<double>(per_panel)}, {0.0, 1.0});
    draw_percent_ticks(drawing, plot);
    draw_side_text(drawing, grid, p, plot, has_truth ? "success, %" : "agreement, %");
    draw_panel_texts(drawing, plot, "", "kind of scene (number of scenes)");
    const std::size_t end = std::min(kinds.size(), (p + 1) * per_panel);
    for (std::size_t k = p * per_panel; k < end; ++k) {
      const double left = static_cast<double>(k - p * per_panel);
      const double pitch = kUsed / static_cast<double>(variants.size());
      for (const auto& [variant, row] : kinds[k].of_variant) {
        const double middle =
            left + (1.0 - kUsed) / 2.0 + pitch * (0.5 + static_cast<double>(variant));
        draw_share(drawing, plot, plot.x(middle), 0.8 * (plot.x(pitch) - plot.left),
                   main_share(*row), variant);
      }
      drawing.text(plot.x(left + 0.5), plot.top + plot.height + 1.4 * text, kind_labels[k],
                   Anchor::middle, "small");
    }
  }
  draw_panel_legend(drawing, grid, labels, SeriesMark::bar);
  return drawing;
}

}  // namespace croon::experiments
