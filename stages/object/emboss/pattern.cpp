#include "stages/object/emboss/pattern.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "common/base/units.h"
#include "stages/object/emboss/stroke_font.h"

namespace tacipc {
namespace {

/// Reads a length that must stay below another one.
double length_below(ConfigReader& in, const std::string& key, double limit_m, const std::string& limit_name) {
  const double value = length(in, key);
  if (value < limit_m) return value;
  if (in.has(key)) in.fault(key, fmt::format("must be below {}, {:.6g} mm", limit_name, limit_m / kMillimetre));
  return 0.5 * limit_m;
}

void check_reach(ConfigReader& in, const std::string& key, double reach_m, double free_radius_m) {
  if (reach_m <= free_radius_m) return;
  in.fault(key, fmt::format("the pattern reaches {:.2f} mm from the middle, the face has room for {:.2f} mm",
                            reach_m / kMillimetre, free_radius_m / kMillimetre));
}

std::uint64_t read_seed(ConfigReader& in) { return static_cast<std::uint64_t>(in.integer("seed", 0)); }

/// Turns the pattern by `angle_deg` from x towards y.
Outline turned(ConfigReader& in, Distance distance) {
  const double angle = kDegree * in.number_or("angle_deg", 0.0, Range::between(-360.0, 360.0));
  if (angle == 0.0) return {std::move(distance)};
  const double c = std::cos(angle), s = std::sin(angle);
  return {[=](const Vector2& p) { return distance(Vector2(c * p.x() + s * p.y(), c * p.y() - s * p.x())); }};
}

Pattern read_text(ConfigReader& in, double free_radius_m) {
  std::string text = in.text("text");
  const double height = length(in, "height_mm");
  const double pen = length_below(in, "stroke_mm", height, "height_mm");
  const double gap = pen + kMillimetre * in.number_or("gap_mm", 0.5, Range::non_negative());
  if (const std::string missing = missing_characters(text); !missing.empty()) {
    in.fault("text", fmt::format("no shape for '{}' (there are A-Z, 0-9 and + - . ! ?)", missing));
    text.clear();
  } else if (in.has("text") && text.find_first_not_of(' ') == std::string::npos) {
    in.fault("text", "is empty");
  }
  const Strokes strokes = text_strokes(text, height - pen, gap);
  check_reach(in, "height_mm", strokes_reach(strokes, pen), free_radius_m);
  return Outline{[=](const Vector2& p) { return strokes_distance(strokes, pen, p); }};
}

Pattern whole_polygon(const Points2& corners) {
  return Outline{[corners](const Vector2& p) { return polygon_distance(corners, p); }};
}

Pattern read_polygon(ConfigReader& in, double free_radius_m) {
  const int sides = in.integer("sides", 3, 100);
  const double radius = length(in, "radius_mm");
  const double turn = kDegree * in.number_or("turn_deg", 0.0, Range::between(-360.0, 360.0));
  check_reach(in, "radius_mm", radius, free_radius_m);
  const Points2 corners = regular_polygon(sides, radius, turn);
  if (!in.has("frame_mm")) return whole_polygon(corners);
  const double inner = radius * std::cos(std::numbers::pi / sides);
  const double width = length_below(in, "frame_mm", inner, "the radius of the inscribed circle");
  return Outline{[=](const Vector2& p) {
    const double d = polygon_distance(corners, p);
    return std::min(d, width - d);
  }};
}

Pattern read_star(ConfigReader& in, double free_radius_m) {
  const int points = in.integer("points", 3, 60);
  const double outer = length(in, "outer_mm");
  const double inner = length_below(in, "inner_mm", outer, "outer_mm");
  check_reach(in, "outer_mm", outer, free_radius_m);
  return whole_polygon(star_polygon(points, outer, inner));
}

Pattern read_gear(ConfigReader& in, double free_radius_m) {
  const int teeth = in.integer("teeth", 3, 60);
  const double tip = length(in, "tip_mm");
  const double root = length_below(in, "root_mm", tip, "tip_mm");
  const double bore = length_below(in, "bore_mm", root, "root_mm");
  const double share = in.number("tip_share", {.low = 0.05, .high = 0.5});
  check_reach(in, "tip_mm", tip, free_radius_m);
  const Points2 corners = gear_polygon(teeth, root, tip, share);
  return Outline{[=](const Vector2& p) { return std::min(polygon_distance(corners, p), p.norm() - bore); }};
}

Pattern read_lines(ConfigReader& in, double /*free_radius_m*/) {
  const double pitch = length(in, "pitch_mm"), width = length_below(in, "width_mm", pitch, "pitch_mm");
  return turned(in, [=](const Vector2& p) { return bars_distance(p.x(), pitch, width); });
}

Pattern read_rings(ConfigReader& in, double /*free_radius_m*/) {
  const double pitch = length(in, "pitch_mm"), width = length_below(in, "width_mm", pitch, "pitch_mm");
  return Outline{[=](const Vector2& p) { return bars_distance(p.norm(), pitch, width); }};
}

Pattern read_dots(ConfigReader& in, double free_radius_m) {
  const double pitch = length(in, "pitch_mm"), radius = length_below(in, "radius_mm", pitch / 2, "half the pitch");
  if (radius > free_radius_m) check_reach(in, "radius_mm", radius, free_radius_m);
  return Outline{[=](const Vector2& p) {
    const Vector2 centre = nearest_hexagonal(p, pitch);
    // Only whole dots are drawn; around a missing one the face stays plain.
    return centre.norm() + radius <= free_radius_m ? radius - (p - centre).norm() : radius - pitch / 2;
  }};
}

Pattern read_checker(ConfigReader& in, double /*free_radius_m*/) {
  const double square = length(in, "square_mm");
  return turned(in, [=](const Vector2& p) { return checker_distance(p, square); });
}

Pattern read_bricks(ConfigReader& in, double /*free_radius_m*/) {
  const double tall = length(in, "height_mm"), wide = length(in, "length_mm");
  const double gap = length_below(in, "gap_mm", std::min(tall, wide), "a brick's sides");
  return turned(in, [=](const Vector2& p) { return bricks_distance(p, wide, tall, gap); });
}

Pattern read_honeycomb(ConfigReader& in, double /*free_radius_m*/) {
  const double pitch = length(in, "pitch_mm"), width = length_below(in, "width_mm", pitch, "pitch_mm");
  return turned(in, [=](const Vector2& p) { return width / 2 - hexagon_border_distance(p, pitch); });
}

Pattern read_cobbles(ConfigReader& in, double /*free_radius_m*/) {
  const double pitch = length(in, "pitch_mm"), gap = length_below(in, "gap_mm", pitch, "pitch_mm");
  const std::uint64_t seed = read_seed(in);
  return Outline{[=](const Vector2& p) { return cell_border_distance(p, pitch, seed) - gap / 2; }};
}

Pattern read_weave(ConfigReader& in, double /*free_radius_m*/) {
  const double pitch = length(in, "pitch_mm"), fill = in.number("fill", {.low = 0.1, .high = 1.0});
  return Texture{[=](const Vector2& p) { return weave_height(p, pitch, fill); }};
}

Pattern read_noise(ConfigReader& in, double /*free_radius_m*/) {
  const double size = length(in, "size_mm"), contrast = in.number("contrast", Range::positive());
  const int octaves = in.integer("octaves", 1, 8);
  const std::uint64_t seed = read_seed(in);
  return Texture{[=](const Vector2& p) { return stone_height(p, size, octaves, contrast, seed); }};
}

Pattern read_ridges(ConfigReader& in, double /*free_radius_m*/) {
  const double pitch = length(in, "pitch_mm"), bend = length(in, "bend_mm", Range::non_negative());
  const double size = length(in, "bend_size_mm");
  const std::uint64_t seed = read_seed(in);
  return Texture{[=](const Vector2& p) { return ridges_height(p, pitch, bend, size, seed); }};
}

Pattern read_picture(ConfigReader& in, double /*free_radius_m*/) {
  return PictureSource{.path = std::filesystem::path(in.source()).parent_path() / in.text("file"),
                       .width_m = length(in, "width_mm"),
                       .dark_is_high = in.flag_or("dark_is_high", false)};
}

struct Kind {
  const char* name;
  Pattern (*read)(ConfigReader&, double free_radius_m);
};

constexpr std::array kKinds = {
    Kind{"text", read_text},   Kind{"polygon", read_polygon},     Kind{"star", read_star},
    Kind{"gear", read_gear},   Kind{"lines", read_lines},         Kind{"rings", read_rings},
    Kind{"dots", read_dots},   Kind{"checker", read_checker},     Kind{"bricks", read_bricks},
    Kind{"weave", read_weave}, Kind{"honeycomb", read_honeycomb}, Kind{"cobbles", read_cobbles},
    Kind{"noise", read_noise}, Kind{"ridges", read_ridges},       Kind{"image", read_picture},
};

}  // namespace

double length(ConfigReader& in, const std::string& key, const Range& range) {
  return kMillimetre * in.number(key, range);
}

Pattern read_pattern(ConfigReader& in, double free_radius_m) {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  const std::string name = in.choice("kind", names);
  const auto* kind = std::ranges::find_if(kKinds, [&](const Kind& k) { return k.name == name; });
  return kind->read(in, free_radius_m);
}

}  // namespace tacipc
