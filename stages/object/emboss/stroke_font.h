// Capital letters, digits and some signs as strokes of a round pen.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "stages/object/emboss/outline.h"

namespace tacipc {

/// A pen stroke as a chain of points; a single point is a dot.
using Strokes = std::vector<Points2>;

/// The characters of `text` that the font lacks, in order.
std::string missing_characters(std::string_view text);

/// Centre lines of a line of text, centred on the origin: capitals are `height_m` high, `gap_m` lies between the centre
/// lines of neighbouring letters.
/// \pre the font has every character
Strokes text_strokes(std::string_view text, double height_m, double gap_m);

/// Signed distance to the strokes drawn with a round pen: pen/2 − distance to the nearest stroke.
double strokes_distance(const Strokes& strokes, double pen_m, const Vector2& p);

/// Largest distance from the origin that the pen reaches.
double strokes_reach(const Strokes& strokes, double pen_m);

}  // namespace tacipc
