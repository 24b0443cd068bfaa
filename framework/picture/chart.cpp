#include "framework/picture/chart.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "framework/base/text.hpp"

namespace croon {
namespace {

using Parts = std::vector<std::string>;

Parts parts_of(const std::string& name) {
  Parts parts = {""};
  for (const char c : name) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// The number of leading, or trailing, parts that all of `names` share; each name keeps at least
/// one part.
std::size_t shared_parts(const std::vector<Parts>& names, bool are_last) {
  std::size_t shared = 0;
  const auto part = [&](const Parts& parts) {
    return are_last ? parts[parts.size() - 1 - shared] : parts[shared];
  };
  while (std::all_of(names.begin(), names.end(), [&](const Parts& parts) {
    return shared + 1 < parts.size() && part(parts) == part(names.front());
  })) {
    ++shared;
  }
  return shared;
}

/// The names without the parts, separated by slashes, that they have in common.
std::vector<std::string> without_common_parts(const std::vector<std::string>& names) {
  if (std::set<std::string>(names.begin(), names.end()).size() < 2) return names;
  std::vector<Parts> all;
  std::set<std::size_t> sizes;
  for (const std::string& name : names) sizes.insert(all.emplace_back(parts_of(name)).size());
  const std::size_t first = shared_parts(all, false);
  for (Parts& parts : all) parts.erase(parts.begin(), parts.begin() + static_cast<long>(first));
  const std::size_t last = shared_parts(all, true);
  for (Parts& parts : all) parts.resize(parts.size() - last);
  std::vector<std::string> labels;
  for (const Parts& parts : all) {
    std::string& label = labels.emplace_back();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      // Parts correspond to each other only if all names have the same number of them.
      const bool is_shared = sizes.size() == 1 &&
                             std::all_of(all.begin(), all.end(),
                                         [&](const Parts& other) { return other[i] == parts[i]; });
      if (!is_shared) label += (label.empty() ? "" : "/") + parts[i];
    }
  }
  return labels;
}

/// `label` shortened to `columns`. Keys are cut first, because in a grid names differ by values,
/// `key=value/key=value`.
std::string shortened(const std::string& label, std::size_t columns) {
  if (text_columns(label) <= columns) return label;
  for (std::size_t key_columns = columns; key_columns > 2; --key_columns) {
    std::string text;
    for (const std::string& part : parts_of(label)) {
      const std::size_t equals = part.find('=');
      text += (text.empty() ? "" : "/") +
              (equals == std::string::npos
                   ? part
                   : cut_in_the_middle(part.substr(0, equals), key_columns) + part.substr(equals));
    }
    if (text_columns(text) <= columns) return text;
  }
  return cut_in_the_middle(label, columns);
}

/// The style with the colour of the series `index` and the dashes `dash`; both repeat.
std::string dashed_style(std::size_t index, std::size_t dash) {
  dash %= kSeriesDashes;
  return "c" + std::to_string(index % kSeriesColours) +
         (dash == 0 ? "" : " d" + std::to_string(dash));
}

}  // namespace

Axis round_axis(double low, double high, int ticks) {
  // A flat range needs a height too; differences below rounding count as flat.
  const double min_height = std::max(1e-6, 1e-9 * std::max(std::abs(low), std::abs(high)));
  if (high - low < min_height) {
    low -= min_height;
    high += min_height;
  }
  const double rough = (high - low) / ticks;
  const auto exponent = static_cast<int>(std::floor(std::log10(rough)));
  const double power = std::pow(10.0, exponent);
  const double digits = rough / power;
  const double step = power * (digits <= 1.0   ? 1.0
                               : digits <= 2.0 ? 2.0
                               : digits <= 5.0 ? 5.0
                                               : 10.0);
  Axis axis;
  axis.decimals = std::max(0, digits > 5.0 ? -exponent - 1 : -exponent);
  const double first = std::floor(low / step);
  const double last = std::ceil(high / step);
  for (double k = first; k <= last; k += 1.0) axis.ticks.push_back(k * step);
  axis.low = axis.ticks.front();
  axis.high = axis.ticks.back();
  return axis;
}

double Plot::x(double value) const {
  return left + width * (value - x_range.low) / (x_range.high - x_range.low);
}

double Plot::y(double value) const {
  return top + height * (y_range.high - value) / (y_range.high - y_range.low);
}

double Plot::y_inside(double value) const { return std::clamp(y(value), top, top + height); }

void Plot::draw_x_tick(Drawing& drawing, double value, const std::string& text, double gap) const {
  drawing.line(x(value), top, x(value), top + height, "grid");
  drawing.text(x(value), top + height + gap, text, Anchor::middle, "small");
}

void Plot::draw_y_tick(Drawing& drawing, double value, const std::string& text, double gap,
                       const std::string& style) const {
  drawing.line(left, y(value), left + width, y(value), style);
  drawing.text(left - gap, y(value) + 0.36 * drawing.sheet().small(), text, Anchor::end, "small");
}

std::string series_style(std::size_t index) { return dashed_style(index, index); }

std::string box_style(std::size_t index) { return dashed_style(index, index / kSeriesColours); }

void draw_band(Drawing& drawing, const Plot& plot, const std::vector<double>& xs,
               const std::vector<std::optional<Interval>>& ys, std::size_t index) {
  std::vector<Corner> upper, lower;
  const auto finish = [&] {
    if (upper.size() > 1) {
      std::vector<Corner> corners = upper;
      corners.insert(corners.end(), lower.rbegin(), lower.rend());
      drawing.area(corners, "band c" + std::to_string(index % kSeriesColours));
      for (const auto& edge : {upper, lower}) drawing.polyline(edge, "edge " + series_style(index));
    }
    upper.clear();
    lower.clear();
  };
  for (std::size_t i = 0; i < xs.size(); ++i) {
    if (!ys[i]) {
      finish();
      continue;
    }
    upper.push_back({plot.x(xs[i]), plot.y(ys[i]->high)});
    lower.push_back({plot.x(xs[i]), plot.y(ys[i]->low)});
  }
  finish();
}

void draw_marker(Drawing& drawing, double x, double y, double radius, std::size_t index) {
  const std::string style = "marker c" + std::to_string(index % kSeriesColours);
  const double r = radius;
  switch (index % kSeriesMarkers) {
    case 0:
      return drawing.dot(x, y, r, style);
    case 1:
      return drawing.rectangle(x - 0.9 * r, y - 0.9 * r, 1.8 * r, 1.8 * r, style);
    case 2:
      return draw_arrowhead(drawing, x, y, 1.2 * r, true, style);
    case 3:
      return drawing.area({{x, y - 1.4 * r}, {x + 1.4 * r, y}, {x, y + 1.4 * r}, {x - 1.4 * r, y}},
                          style);
    case 4:
      return draw_arrowhead(drawing, x, y, 1.2 * r, false, style);
    case 5:
      drawing.rectangle(x - 1.3 * r, y - 0.4 * r, 2.6 * r, 0.8 * r, style);
      return drawing.rectangle(x - 0.4 * r, y - 1.3 * r, 0.8 * r, 2.6 * r, style);
    default:  // An hourglass.
      return drawing.area({{x - r, y - r}, {x + r, y - r}, {x - r, y + r}, {x + r, y + r}}, style);
  }
}

void draw_bar(Drawing& drawing, double x, double y, double width, double height,
              std::size_t index) {
  drawing.rectangle(x, y, width, height, "box " + dashed_style(index, index / kSeriesMarkers));
}

void draw_arrowhead(Drawing& drawing, double x, double y, double radius, bool is_up,
                    const std::string& style) {
  const double tip = is_up ? -radius : radius;
  drawing.area({{x, y + tip}, {x + radius, y - 0.8 * tip}, {x - radius, y - 0.8 * tip}}, style);
}

double legend_line(const Sheet& sheet) { return 2.6 * sheet.small(); }

void draw_legend_entry(Drawing& drawing, double left, double y, std::size_t index,
                       const std::string& name, SeriesMark mark) {
  const double length = legend_line(drawing.sheet());
  const double text = drawing.sheet().small();
  if (mark == SeriesMark::line) {
    drawing.line(left, y, left + length, y, "curve " + series_style(index));
  } else {
    draw_bar(drawing, left, y - 0.4 * text, length, 0.8 * text, index);
  }
  draw_marker(drawing, left + length / 2.0, y, 0.25 * text, index);
  drawing.text(left + length + 0.5 * text, y + 0.36 * text, name, Anchor::start, "small");
}

std::vector<std::string> distinct_labels(const std::vector<std::string>& names,
                                         std::size_t columns) {
  std::vector<std::string> labels = without_common_parts(names);
  for (std::string& label : labels) label = shortened(label, columns);
  std::map<std::string, int> uses;
  for (const std::string& label : labels) ++uses[label];
  const std::vector<std::string> whole = without_common_parts(names);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (uses[labels[i]] == 1) continue;
    const std::string number = std::to_string(i + 1) + ": ";
    const std::size_t left = columns > number.size() ? columns - number.size() : 0;
    labels[i] = number + shortened(whole[i], left);
  }
  return labels;
}

}  // namespace croon
