#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/picture/colour.hpp"

namespace croon {

/// A picture of `width` x `height` pixels, row by row from the top left.
class Image {
 public:
  Image(int width, int height, Colour background = {255, 255, 255});

  int width() const { return width_; }
  int height() const { return height_; }
  Colour& at(int x, int y) { return pixels_[index(x, y)]; }
  const Colour& at(int x, int y) const { return pixels_[index(x, y)]; }
  bool contains(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }
  const std::vector<Colour>& pixels() const { return pixels_; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<Colour> pixels_;
};

/// The pictures side by side with `gap` white pixels between them; shorter ones are padded below.
Image side_by_side(const std::vector<Image>& images, int gap);

/// The picture with `above` and `below` additional white rows.
Image padded(const Image& image, int above, int below);

/// The bytes of `image` as a PNG file.
std::string png_bytes(const Image& image);

/// Writes `image` as PNG. Throws InputError if the file cannot be written.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace croon
