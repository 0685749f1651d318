#include "stages/object/emboss/pattern.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace pattern_test {

Pattern pattern_of(const std::string& text, double free_radius_m = 5e-3) {
  ConfigReader in = ConfigReader::from_text(text, "p.yaml");
  Pattern pattern = read_pattern(in, free_radius_m);
  in.finish();
  return pattern;
}

double outline_at(const std::string& text, double x_mm, double y_mm) {
  return 1e3 * std::get<Outline>(pattern_of(text)).distance(1e-3 * Vector2(x_mm, y_mm));
}

std::string refusal(const std::string& text) {
  return message_of<ConfigError>([&] { pattern_of(text); });
}

TEST(Pattern, KeysAreMillimetresAndDegrees) {
  EXPECT_NEAR(outline_at("{kind: polygon, sides: 4, radius_mm: 2.8284271247461903, turn_deg: 45}", 0.5, 0), 1.5, 1e-12);
  EXPECT_NEAR(outline_at("{kind: polygon, sides: 4, radius_mm: 2.8284271247461903, turn_deg: 45, frame_mm: 0.5}", 0, 0),
              -1.5, 1e-12);
  EXPECT_NEAR(outline_at("{kind: lines, pitch_mm: 1, width_mm: 0.4, angle_deg: 90}", 0.7, 0.0), 0.2, 1e-12);
  EXPECT_NEAR(outline_at("{kind: lines, pitch_mm: 1, width_mm: 0.4}", 0.5, 0.0), -0.3, 1e-12);
  EXPECT_NEAR(outline_at("{kind: rings, pitch_mm: 1, width_mm: 0.4}", 0.0, -2.0), 0.2, 1e-12);
  EXPECT_NEAR(outline_at("{kind: honeycomb, pitch_mm: 2, width_mm: 0.4}", 0.0, 0.0), -0.8, 1e-12);
  EXPECT_NEAR(outline_at("{kind: gear, teeth: 8, tip_mm: 4, root_mm: 3, bore_mm: 1, tip_share: 0.3}", 0, 1.2), 0.2,
              1e-12);
  // The letter is as high as asked for, pen included.
  EXPECT_NEAR(outline_at("{kind: text, text: I, height_mm: 6, stroke_mm: 1}", 0, 3), 0.0, 1e-12);
}

TEST(Pattern, TurningGoesFromXTowardsY) {
  // Bars stand along y; turned by 30 degrees their tops lean to the left.
  const std::string lines = "{kind: lines, pitch_mm: 4, width_mm: 0.4, angle_deg: 30}";
  EXPECT_NEAR(outline_at(lines, -0.5, 0.5 * std::sqrt(3.0)), 0.2, 1e-12);
  EXPECT_LT(outline_at(lines, 0.5, 0.5 * std::sqrt(3.0)), 0.0);
}

TEST(Pattern, OnlyWholeDotsAreKept) {
  const std::string dots = "{kind: dots, pitch_mm: 2, radius_mm: 0.5}";
  EXPECT_NEAR(outline_at(dots, 4.0, 0.0), 0.5, 1e-12);    // reaches 4.5 of 5 mm
  EXPECT_LT(outline_at(dots, 5.0, std::sqrt(3.0)), 0.0);  // would reach 5.8 mm
}

TEST(Pattern, FaultsNameTheKey) {
  EXPECT_EQ(
      refusal("{kind: txt}"),
      "p.yaml:1:1: text: missing\np.yaml:1:1: height_mm: missing\np.yaml:1:1: stroke_mm: missing\n"
      "p.yaml:1:8: kind: 'txt' is not one of text, polygon, star, gear, lines, rings, dots, checker, bricks, weave, "
      "honeycomb, cobbles, noise, ridges, image (did you mean text?)");
  EXPECT_EQ(refusal("{kind: text, text: Tac, height_mm: 3, stroke_mm: 0.5}"),
            "p.yaml:1:20: text: no shape for 'ac' (there are A-Z, 0-9 and + - . ! ?)");
  EXPECT_EQ(refusal("{kind: text, text: ' ', height_mm: 3, stroke_mm: 0.5}"), "p.yaml:1:20: text: is empty");
  EXPECT_EQ(refusal("{kind: star, points: 5, outer_mm: 6, inner_mm: 2}"),
            "p.yaml:1:35: outer_mm: the pattern reaches 6.00 mm from the middle, the face has room for 5.00 mm");
  EXPECT_EQ(refusal("{kind: lines, pitch_mm: 1, width_mm: 1}"), "p.yaml:1:38: width_mm: must be below pitch_mm, 1 mm");
  EXPECT_EQ(refusal("{kind: rings, pitch_mm: 1, width_mm: 0.5, angle_deg: 3}"), "p.yaml:1:43: angle_deg: unknown key");
}

TEST(Pattern, APicturesPathCountsFromTheConfiguration) {
  ConfigReader in = ConfigReader::from_text("{kind: image, file: a/b.png, width_mm: 7}", "some/folder/p.yaml");
  const auto source = std::get<PictureSource>(read_pattern(in, 5e-3));
  in.finish();
  EXPECT_EQ(source.path, "some/folder/a/b.png");
  EXPECT_DOUBLE_EQ(source.width_m, 7e-3);
  EXPECT_FALSE(source.dark_is_high);
}

}  // namespace pattern_test
}  // namespace tacipc
