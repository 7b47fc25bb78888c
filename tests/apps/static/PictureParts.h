// What a picture of taken-apart patches consists of: connected parts of the colours of its pieces, and
// background that shows through.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <QColor>
#include <QImage>

namespace teren::test {

enum class Colour : std::uint8_t { background, ground, seam, corner, black };

/// By hue: the sky is bright, seams are orange, corner pieces blue, ground green in any light.
inline Colour colourAt(const QImage& picture, int x, int y) {
  const QColor colour(picture.pixel(x, y));
  if (colour.lightness() > 190 && colour.blue() >= colour.red()) return Colour::background;
  if (colour.lightness() < 6) return Colour::black;
  if (colour.blue() > colour.red() + 10 && colour.blue() > colour.green() + 10) return Colour::corner;
  if (colour.red() > colour.green() + 8) return Colour::seam;
  return Colour::ground;
}

/// The sizes [pixels] of the connected parts whose pixels are `wanted`.
inline std::vector<int> partsOf(const QImage& picture, const std::function<bool(int x, int y)>& wanted) {
  const int width = picture.width(), height = picture.height();
  std::vector<bool> seen(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<int> sizes, open;
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    const int pixel = y * width + x;
    if (seen[static_cast<std::size_t>(pixel)] || !wanted(x, y)) return;
    seen[static_cast<std::size_t>(pixel)] = true;
    open.push_back(pixel);
  };
  for (int start = 0; start < width * height; ++start) {
    visit(start % width, start / width);
    int size = 0;
    for (; !open.empty(); ++size) {
      const int x = open.back() % width, y = open.back() / width;
      open.pop_back();
      visit(x - 1, y), visit(x + 1, y), visit(x, y - 1), visit(x, y + 1);
    }
    if (size > 0) sizes.push_back(size);
  }
  return sizes;
}

/// How many parts of a colour have at least so many pixels.
inline int countParts(const QImage& picture, Colour colour, int least) {
  int count = 0;
  for (const int size : partsOf(picture, [&](int x, int y) { return colourAt(picture, x, y) == colour; })) {
    count += size >= least ? 1 : 0;
  }
  return count;
}

inline int countPixels(const QImage& picture, Colour colour) {
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) count += colourAt(picture, x, y) == colour ? 1 : 0;
  }
  return count;
}

}  // namespace teren::test
