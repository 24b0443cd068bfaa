// The writers that draw with cairo: PDF and images.
#include <cairo-pdf.h>
#include <cairo.h>

#include <cstring>
#include <memory>
#include <stdexcept>

#include "framework/base/angles.hpp"
#include "framework/picture/writers.hpp"

namespace croon {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// Throws std::runtime_error if cairo failed, for lack of memory or a font.
void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(std::string("cairo: ") + cairo_status_to_string(status));
}

/// Draws each primitive.
class CairoWriter {
 public:
  CairoWriter(cairo_t* context, const Sheet& sheet) : context_(context), sheet_(sheet) {}

  void operator()(const Drawing::Line& line) const {
    cairo_move_to(context_, line.x1, line.y1);
    cairo_line_to(context_, line.x2, line.y2);
    paint(line.style);
  }

  void operator()(const Drawing::Rectangle& box) const {
    cairo_rectangle(context_, box.x, box.y, box.width, box.height);
    paint(box.style);
  }

  void operator()(const Drawing::Area& area) const {
    follow(area.corners);
    cairo_close_path(context_);
    paint(area.style);
  }

  void operator()(const Drawing::Polyline& line) const {
    follow(line.corners);
    paint(line.style);
  }

  void operator()(const Drawing::Dot& dot) const {
    constexpr double kWholeTurn = 2.0 * kPi;
    cairo_new_sub_path(context_);
    cairo_arc(context_, dot.x, dot.y, dot.radius, 0.0, kWholeTurn);
    paint(dot.style);
  }

  void operator()(const Drawing::Text& text) const {
    const Look look = look_of(text.style, sheet_);
    cairo_save(context_);
    cairo_select_font_face(context_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           look.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_, look.text_size);
    set_colour(look.fill, 1.0);
    cairo_text_extents_t extents;
    cairo_text_extents(context_, text.text.c_str(), &extents);
    const double share = text.anchor == Anchor::start ? 0.0
                         : text.anchor == Anchor::end ? 1.0
                                                      : 0.5;
    cairo_translate(context_, text.x, text.y);
    cairo_rotate(context_, rad_from_deg(text.turn_deg));
    cairo_move_to(context_, -share * extents.x_advance, 0.0);
    cairo_show_text(context_, text.text.c_str());
    cairo_restore(context_);
  }

 private:
  void follow(const std::vector<Corner>& corners) const {
    cairo_new_path(context_);
    for (const auto& [x, y] : corners) cairo_line_to(context_, x, y);
  }

  void set_colour(const Colour& colour, double opacity) const {
    cairo_set_source_rgba(context_, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0,
                          opacity);
  }

  /// Fills and strokes the path.
  void paint(const std::string& style) const {
    const Look look = look_of(style, sheet_);
    if (look.has_fill) {
      set_colour(look.fill, look.fill_opacity);
      cairo_fill_preserve(context_);
    }
    if (look.has_stroke) {
      set_colour(look.stroke, 1.0);
      cairo_set_line_width(context_, look.width);
      cairo_set_dash(context_, look.dashes.data(), static_cast<int>(look.dashes.size()), 0.0);
      cairo_stroke_preserve(context_);
    }
    cairo_new_path(context_);
  }

  cairo_t* context_;
  Sheet sheet_;
};

void draw(const Drawing& drawing, const Context& context) {
  const CairoWriter writer(context.get(), drawing.sheet());
  for (const Drawing::Element& element : drawing.elements()) std::visit(writer, element);
  check(cairo_status(context.get()));
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string pdf_bytes(const Drawing& drawing) {
  const double unit = drawing.sheet().unit_pt();
  std::string bytes;
  const Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, unit * drawing.width(),
                                                            unit * drawing.height()),
                        cairo_surface_destroy);
  check(cairo_surface_status(surface.get()));
  // The creation date would make the bytes differ.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_SUBJECT,
                                 drawing.description().c_str());
  {
    const Context context(cairo_create(surface.get()), cairo_destroy);
    cairo_scale(context.get(), unit, unit);
    draw(drawing, context);
  }
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  return bytes;
}

void draw_on(Image& image, const Drawing& drawing, double scale) {
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width(), image.height()),
      cairo_surface_destroy);
  check(cairo_surface_status(surface.get()));
  unsigned char* const pixels = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  // A cairo pixel is 0x00RRGGBB in native byte order.
  const auto for_each_pixel = [&](const auto& visit) {
    for (int row = 0; row < image.height(); ++row) {
      for (int column = 0; column < image.width(); ++column) {
        visit(image.at(column, row),
              pixels + static_cast<std::ptrdiff_t>(row) * stride + 4 * column);
      }
    }
  };
  for_each_pixel([](const Colour& colour, unsigned char* pixel) {
    const std::uint32_t value = (static_cast<std::uint32_t>(colour.red) << 16U) |
                                (static_cast<std::uint32_t>(colour.green) << 8U) | colour.blue;
    std::memcpy(pixel, &value, sizeof value);
  });
  cairo_surface_mark_dirty(surface.get());
  {
    const Context context(cairo_create(surface.get()), cairo_destroy);
    cairo_scale(context.get(), scale, scale);
    draw(drawing, context);
  }
  cairo_surface_flush(surface.get());
  for_each_pixel([](Colour& colour, const unsigned char* pixel) {
    std::uint32_t value = 0;
    std::memcpy(&value, pixel, sizeof value);
    colour = {static_cast<std::uint8_t>(value >> 16U), static_cast<std::uint8_t>(value >> 8U),
              static_cast<std::uint8_t>(value)};
  });
}

}  // namespace croon
