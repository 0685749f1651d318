// Pictures put together of smaller ones and of words, in smooth strokes.
#pragma once

#include <array>
#include <string>

#include "common/image/picture.h"

namespace tacipc {

using Color = std::array<double, 3>;  // RGB

struct Text {
  std::string words;
  int height;  // of a capital letter, pixels
  Color color;
  bool bold = false;

  int stroke() const;
  int width() const;  // pixels
};

/// The stroke font knows ASCII only: one '?' for each other character.
std::string ascii(const std::string& text);

/// In ASCII, shortened by dots to at most `width` pixels.
Text fitted(Text text, int width);

/// Left end of the text at x, its letters standing on row `baseline`. \pre RGB
void draw_text(ByteImage& sheet, const Text& text, int x, int baseline);

/// A box of one colour. \pre RGB
void fill_box(ByteImage& sheet, int x, int y, int width, int height, const Color& color);

/// The largest copy that fits into the box and keeps its proportions, averaged where it gets smaller.
/// \pre RGB, width and height ≥ 1
ByteImage fitted_picture(const ByteImage& image, int width, int height);

}  // namespace tacipc
