#include "stages/object/emboss/stroke_font.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace tacipc {
namespace {

/// M x y starts a stroke, L x y draws a line; O and A draw an arc (centre x y, radii x y, from and to in degrees,
/// counter-clockwise if growing): O starts a stroke with it, A continues it. Capitals are 1 high, y up, from x = 0.
struct Glyph {
  char character;
  const char* path;
};

constexpr Glyph kGlyphs[] = {
    {'A', "M 0 0 L .4 1 L .8 0 M .13 .32 L .67 .32"},
    {'B', "M 0 0 L 0 1 L .36 1 A .36 .76 .25 .24 90 -90 L 0 .52 M .36 .52 A .38 .26 .28 .26 90 -90 L 0 0"},
    {'C', "O .44 .5 .44 .5 48 312"},
    {'D', "M 0 0 L 0 1 L .28 1 A .28 .5 .46 .5 90 -90 L 0 0"},
    {'E', "M .6 1 L 0 1 L 0 0 L .6 0 M 0 .52 L .5 .52"},
    {'F', "M .6 1 L 0 1 L 0 0 M 0 .52 L .5 .52"},
    {'G', "O .44 .5 .44 .5 48 360 L .5 .5"},
    {'H', "M 0 0 L 0 1 M .7 0 L .7 1 M 0 .52 L .7 .52"},
    {'I', "M 0 0 L 0 1"},
    {'J', "M .5 1 L .5 .27 A .25 .27 .25 .27 0 -170"},
    {'K', "M 0 0 L 0 1 M .62 1 L 0 .4 M .21 .6 L .66 0"},
    {'L', "M 0 1 L 0 0 L .58 0"},
    {'M', "M 0 0 L 0 1 L .42 .35 L .84 1 L .84 0"},
    {'N', "M 0 0 L 0 1 L .7 0 L .7 1"},
    {'O', "O .44 .5 .44 .5 0 360"},
    {'P', "M 0 0 L 0 1 L .36 1 A .36 .74 .28 .26 90 -90 L 0 .48"},
    {'Q', "O .44 .5 .44 .5 0 360 M .54 .3 L .84 0"},
    {'R', "M 0 0 L 0 1 L .36 1 A .36 .74 .28 .26 90 -90 L 0 .48 M .32 .48 L .66 0"},
    {'S', "O .31 .76 .28 .24 35 270 A .31 .26 .31 .26 90 -145"},
    {'T', "M 0 1 L .72 1 M .36 1 L .36 0"},
    {'U', "M 0 1 L 0 .34 A .34 .34 .34 .34 180 360 L .68 1"},
    {'V', "M 0 1 L .38 0 L .76 1"},
    {'W', "M 0 1 L .26 0 L .52 .7 L .78 0 L 1.04 1"},
    {'X', "M 0 0 L .7 1 M 0 1 L .7 0"},
    {'Y', "M 0 1 L .36 .48 L .72 1 M .36 .48 L .36 0"},
    {'Z', "M 0 1 L .66 1 L 0 0 L .66 0"},
    {'0', "O .34 .5 .34 .5 0 360"},
    {'1', "M 0 .76 L .26 1 L .26 0"},
    {'2', "O .3 .7 .3 .3 160 -40 L 0 0 L .62 0"},
    {'3', "O .29 .76 .26 .24 145 -90 A .29 .26 .3 .26 90 -145"},
    {'4', "M .48 0 L .48 1 L 0 .3 L .66 .3"},
    {'5', "M .56 1 L .08 1 L .05 .54 A .28 .31 .3 .31 130 -145"},
    {'6', "O .31 .31 .3 .31 0 360 M .46 1 L .06 .48"},
    {'7', "M 0 1 L .62 1 L .2 0"},
    {'8', "O .3 .76 .25 .24 0 360 O .3 .26 .3 .26 0 360"},
    {'9', "O .3 .69 .3 .31 0 360 M .15 0 L .55 .52"},
    {'-', "M 0 .5 L .4 .5"},
    {'+', "M 0 .5 L .56 .5 M .28 .22 L .28 .78"},
    {'.', "M 0 0"},
    {'!', "M 0 1 L 0 .34 M 0 0"},
    {'?', "O .27 .74 .27 .26 160 -60 L .27 .34 M .27 0"},
    {' ', ""},
};
constexpr double kSpaceWidth = 0.3;
constexpr int kChordsPerTurn = 96;  // sagitta below 0.06 % of the radius

const Glyph* find_glyph(char character) {
  const auto* found = std::find_if(std::begin(kGlyphs), std::end(kGlyphs),
                                   [&](const Glyph& glyph) { return glyph.character == character; });
  return found == std::end(kGlyphs) ? nullptr : found;
}

Strokes glyph_strokes(const Glyph& glyph) {
  Strokes strokes;
  std::istringstream path(glyph.path);
  for (char command = 0; path >> command;) {
    if (command == 'M' || command == 'O') strokes.emplace_back();
    Vector2 at;
    path >> at.x() >> at.y();
    if (command == 'M' || command == 'L') {
      strokes.back().push_back(at);
      continue;
    }
    double rx = 0, ry = 0, from = 0, to = 0;
    path >> rx >> ry >> from >> to;
    assert(path);
    const int chords = std::max(1, static_cast<int>(std::lround(kChordsPerTurn * std::abs(to - from) / 360.0)));
    for (int i = 0; i <= chords; ++i) {
      const double angle = (from + (to - from) * i / chords) * std::numbers::pi / 180.0;
      strokes.back().push_back(at + Vector2(rx * std::cos(angle), ry * std::sin(angle)));
    }
  }
  return strokes;
}

double glyph_width(const Glyph& glyph, const Strokes& strokes) {
  double width = glyph.character == ' ' ? kSpaceWidth : 0.0;
  for (const Points2& stroke : strokes)
    for (const Vector2& point : stroke) width = std::max(width, point.x());
  return width;
}

}  // namespace

std::string missing_characters(std::string_view text) {
  std::string missing;
  for (const char character : text)
    if (!find_glyph(character)) missing += character;
  return missing;
}

Strokes text_strokes(std::string_view text, double height_m, double gap_m) {
  Strokes all;
  double x = 0.0;
  for (const char character : text) {
    const Glyph* glyph = find_glyph(character);
    assert(glyph);
    Strokes strokes = glyph_strokes(*glyph);
    const double width = glyph_width(*glyph, strokes);
    for (Points2& stroke : strokes) {
      for (Vector2& point : stroke) point = Vector2(x, 0.0) + height_m * point;
      all.push_back(std::move(stroke));
    }
    x += height_m * width + gap_m;
  }
  const Vector2 middle((x - gap_m) / 2, height_m / 2);
  for (Points2& stroke : all)
    for (Vector2& point : stroke) point -= middle;
  return all;
}

double strokes_distance(const Strokes& strokes, double pen_m, const Vector2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Points2& stroke : strokes) {
    nearest = std::min(nearest, (p - stroke.front()).norm());
    for (std::size_t i = 1; i < stroke.size(); ++i)
      nearest = std::min(nearest, segment_distance(p, stroke[i - 1], stroke[i]));
  }
  return pen_m / 2 - nearest;
}

double strokes_reach(const Strokes& strokes, double pen_m) {
  double reach = 0.0;
  for (const Points2& stroke : strokes)
    for (const Vector2& point : stroke) reach = std::max(reach, point.norm());
  return reach + pen_m / 2;
}

}  // namespace tacipc
