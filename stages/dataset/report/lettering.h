// Words in pictures, in smooth strokes.
#pragma once

#include <array>
#include <string>

namespace cv {
class Mat;
}

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

/// Left end of the text at x, its letters standing on row `baseline`. \pre RGB of 8 bit
void draw_text(cv::Mat& sheet, const Text& text, int x, int baseline);

}  // namespace tacipc
