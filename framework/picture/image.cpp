#include "framework/picture/image.hpp"

#include <png.h>

#include <algorithm>
#include <stdexcept>

#include "framework/base/whole_file.hpp"

namespace croon {

Image::Image(int width, int height, Colour background)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

Image side_by_side(const std::vector<Image>& images, int gap) {
  int width = -gap;
  int height = 0;
  for (const Image& image : images) {
    width += image.width() + gap;
    height = std::max(height, image.height());
  }
  Image whole(std::max(width, 0), height);
  int left = 0;
  for (const Image& image : images) {
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) whole.at(left + x, y) = image.at(x, y);
    }
    left += image.width() + gap;
  }
  return whole;
}

Image padded(const Image& image, int above, int below) {
  Image whole(image.width(), image.height() + above + below);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) whole.at(x, above + y) = image.at(x, y);
  }
  return whole;
}

std::string png_bytes(const Image& image) {
  static_assert(sizeof(Colour) == 3, "a pixel is three bytes");
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width());
  header.height = static_cast<png_uint_32>(image.height());
  header.format = PNG_FORMAT_RGB;
  // Pictures of points compress almost as well in a third of the time.
  header.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels().data(), 0,
                                nullptr) == 0) {
    throw std::logic_error(std::string("png_bytes: ") + header.message);
  }
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  write_whole_file(path, png_bytes(image));
}

}  // namespace croon
