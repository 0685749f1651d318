// Composes pictures from smaller pictures and text in smooth strokes.
#pragma once

#include <array>
#include <string>

#include "common/image/picture.h"

namespace tacipc {

using Color = std::array<double, 3>;  // RGB

/// A line of text in a picture.
struct Text {
  std::string words;
  int height;  // height of a capital letter, px
  Color color;
  bool bold = false;

  int stroke() const;
  int width() const;  // width, px
};

/// Text with '?' for each character that the stroke font, which has only ASCII, lacks.
std::string ascii(const std::string& text);

/// Text in ASCII, shortened by dots to at most `width` pixels.
Text fitted(Text text, int width);

/// Draws the text with its left end at x and its letters on row `baseline`.
/// \pre RGB
void draw_text(ByteImage& sheet, const Text& text, int x, int baseline);

/// Fills a box with one colour.
/// \pre RGB
void fill_box(ByteImage& sheet, int x, int y, int width, int height, const Color& color);

/// Largest copy that fits into the box and keeps its proportions; averaged if it is smaller than the image.
/// \pre RGB, width and height ≥ 1
ByteImage fitted_picture(const ByteImage& image, int width, int height);

}  // namespace tacipc
