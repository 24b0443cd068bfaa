#pragma once

#include <string>
#include <vector>

#include "framework/picture/drawing.hpp"
#include "framework/picture/image.hpp"

namespace croon {

// The formats of a drawing. The same drawing yields the same bytes; PDF files also depend on the
// version of cairo and on the machine's sans-serif font, which is embedded.

/// For browsers; readable on light and dark pages, without a font or script.
std::string svg_bytes(const Drawing& drawing);

/// The same for a part of an HTML page, whose style sheet has to contain `inline_style_sheet`. The
/// names of its classes begin with "chart-".
std::string inline_svg(const Drawing& drawing);
std::string inline_style_sheet();

/// One page of the drawing's size.
std::string pdf_bytes(const Drawing& drawing);

/// A format of figures.
struct DrawingFormat {
  const char* name;
  std::string (*bytes)(const Drawing& drawing);
};

/// All formats by name, which is also the suffix of their files.
const std::vector<DrawingFormat>& drawing_formats();

/// Draws over `image`, from its top left corner; one unit of the drawing is `scale` pixels.
void draw_on(Image& image, const Drawing& drawing, double scale);

}  // namespace croon
