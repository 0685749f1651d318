#include "stages/object/emboss/emboss.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>

#include "common/base/error.h"
#include "tests/config_text.h"
#include "tests/program_test.h"

namespace tacipc {
namespace emboss_test {

namespace fs = std::filesystem;

const fs::path kConfigs = fs::path(TACIPC_SOURCE_DIR) / "configs/objects/patterns";

std::string config_text(const std::string& pattern, int vertices = 4000) {
  return "coin: {radius_mm: 5.6, thickness_mm: 2, fillet_mm: 0.2, margin_mm: 0.2}\n"
         "relief: {height_mm: 0.4, wall_mm: 0.2, rounding_mm: 0.05}\n"
         "vertices: " +
         std::to_string(vertices) + "\npattern: {" + pattern + "}\n";
}

EmbossConfig config_of(const std::string& text) { return config_from_text<EmbossConfig>(text, "c.yaml"); }

/// The nineteen shipped patterns by name.
std::vector<fs::path> shipped() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(kConfigs)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(WallHeight, IsARoundedRamp) {
  EXPECT_EQ(wall_height(-0.1501, 0.2, 0.05), 0.0);
  EXPECT_NEAR(wall_height(0.0, 0.2, 0.05), 0.5, 1e-15);
  EXPECT_NEAR(wall_height(0.03, 0.2, 0.05), 0.65, 1e-15);  // the straight middle keeps its slope 1 / wall
  EXPECT_EQ(wall_height(0.1501, 0.2, 0.05), 1.0);
  EXPECT_EQ(wall_height(9.0, 0.2, 0.05), 1.0);
  // The foot is a parabola: (d + w/2 + r)² / (4 w r).
  EXPECT_NEAR(wall_height(-0.1, 0.2, 0.05), 0.05 * 0.05 / (4 * 0.2 * 0.05), 1e-15);
  for (double d = -0.2; d < 0.2; d += 0.01)
    EXPECT_NEAR(wall_height(d, 0.2, 0.05), 1 - wall_height(-d, 0.2, 0.05), 1e-13);
}

TEST(Emboss, HeightsAtKnownPoints) {
  const EmbossConfig config = config_of(config_text("kind: polygon, sides: 4, radius_mm: 4, turn_deg: 45"));
  const Height relief = face_relief(config);
  const double side = 4e-3 / std::sqrt(2.0);
  EXPECT_EQ(relief({0, 0}), 1.0);
  EXPECT_NEAR(relief({side, 0}), 0.5, 1e-12);
  EXPECT_NEAR(relief({side - 0.05e-3, 1e-3}), 0.75, 1e-12);
  EXPECT_EQ(relief({side + 0.2e-3, 0}), 0.0);
  const EmbossedCoin coin = emboss(config, relief);
  EXPECT_DOUBLE_EQ(coin.mesh.positions(0, 2), 2.4e-3);
  EXPECT_NEAR(coin.relief_height_m, 0.4e-3, 1e-15);
  EXPECT_NEAR(coin.raised_share, 4 * side * side / (M_PI * 5.4e-3 * 5.4e-3), 0.02);
}

TEST(Emboss, EverythingEmbossedEndsBeforeTheFillet) {
  for (const char* pattern : {"kind: lines, pitch_mm: 1, width_mm: 0.5", "kind: weave, pitch_mm: 1, fill: 0.8",
                              "kind: noise, size_mm: 1, octaves: 3, contrast: 2, seed: 1"}) {
    const Height relief = face_relief(config_of(config_text(pattern)));
    double inside = 0.0;
    for (double angle = 0.0; angle < 6.2; angle += 0.01) {
      const Vector2 direction(std::cos(angle), std::sin(angle));
      EXPECT_EQ(relief(5.2001e-3 * direction), 0.0) << pattern;
      inside = std::max(inside, relief(4.8e-3 * direction));
    }
    EXPECT_GT(inside, 0.5) << pattern;
  }
}

TEST(Emboss, PlainFaceIsRefused) {
  const EmbossConfig config = config_of(config_text("kind: weave, pitch_mm: 1, fill: 0.8"));
  EXPECT_EQ(message_of<DataError>([&] { emboss(config, [](const Vector2&) { return 0.0; }); }),
            "the pattern leaves the face plain: its height goes from 0.000 to 0.000 of 0.400 mm");
  // One bar far wider than the face: all of it is raised.
  const EmbossConfig wide = config_of(config_text("kind: lines, pitch_mm: 90, width_mm: 30"));
  EXPECT_EQ(message_of<DataError>([&] { emboss(wide, face_relief(wide)); }),
            "the pattern leaves the face plain: its height goes from 1.000 to 1.000 of 0.400 mm");
}

TEST(Emboss, ConfigFaultsAreReportedTogether) {
  EXPECT_EQ(message_of<ConfigError>([] {
              config_of(
                  "coin: {radius_mm: 0.4, thickness_mm: 2, fillet_mm: 0.2, margin_mm: 0.2}\n"
                  "relief: {height_mm: 0, wall_mm: 0.2, rounding_mm: 0.05}\n"
                  "vertices: 10\n"
                  "pattern: {kind: checker, square_mm: 1}\n");
            }),
            "c.yaml:1:19: coin.radius_mm: fillet, margin and the relief's wall leave no room on the face\n"
            "c.yaml:2:21: relief.height_mm: 0 is outside (0, inf)\n"
            "c.yaml:3:11: vertices: 10 is outside [500, 20000000]");
  EXPECT_EQ(message_of<ConfigError>([] {
              config_of(
                  "coin: {radius_mm: 6, thickness_mm: 1, fillet_mm: 1, margin_mm: 0.2}\n"
                  "relief: {height_mm: 0.3, wall_mm: 0.2, rounding_mm: 0.05}\n"
                  "vertices: 1000\n"
                  "pattern: {kind: checker, square_mm: 1}\n");
            }),
            "c.yaml:1:50: coin.fillet_mm: must be below thickness_mm, 1");
}

TEST(Emboss, PictureOfALetterReadsNormally) {
  const EmbossConfig config = config_of(config_text("kind: text, text: L, height_mm: 7, stroke_mm: 1"));
  const ByteImage picture = relief_picture(config, face_relief(config), 112);  // 10 px a mm
  const auto at = [&](double x_mm, double y_mm) {
    return int{picture.at(static_cast<int>(56 + 10 * x_mm), static_cast<int>(56 - 10 * y_mm), 0)};
  };
  const double half = 0.58 * 6 / 2;
  EXPECT_EQ(at(-half, 2.5), 255);  // stem on the left, up to the top
  EXPECT_EQ(at(half, -3.0), 255);  // foot to the right, at the bottom
  EXPECT_EQ(at(half, 2.5), 0);
  EXPECT_EQ(at(-5.5, 5.5), 0);
}

TEST(Emboss, ReliefPictureAsAPatternGivesTheReliefBack) {
  const ScratchFolder folder;
  const EmbossConfig star = config_of(config_text("kind: star, points: 5, outer_mm: 4.5, inner_mm: 2"));
  const Height original = face_relief(star);
  write_png(folder / "star.png", relief_picture(star, original, 1000));
  folder.file("again.yaml", config_text("kind: image, file: star.png, width_mm: 11.2"));
  const auto again = read_config<EmbossConfig>(folder / "again.yaml");
  const Height copy = face_relief(again);
  for (const Vector2& p :
       {Vector2(0, 0), Vector2(0, 3e-3), Vector2(0, -3e-3), Vector2(2e-3, 3e-3), Vector2(-3.2e-3, 1e-3)})
    EXPECT_NEAR(copy(p), original(p), 0.02) << p.transpose();
  EXPECT_EQ(emboss(again, copy).mesh.num_vertices(), emboss(star, original).mesh.num_vertices());
}

TEST(Emboss, AllNineteenPatternsMakeDistinctReliefs) {
  const auto paths = shipped();
  ASSERT_EQ(paths.size(), 19u);
  std::vector<ByteImage> pictures;
  for (const fs::path& path : paths) {
    SCOPED_TRACE(path.filename());
    auto config = read_config<EmbossConfig>(path);
    EXPECT_GE(config.vertices, 500000);
    // The coin must lie in the window of the MC-Tac camera, 15 × 11.25 mm.
    EXPECT_LE(2 * config.coin.radius_m, 11.25e-3);
    config.vertices = 20000;
    const Height relief = face_relief(config);
    const EmbossedCoin coin = emboss(config, relief);
    EXPECT_NEAR(coin.relief_height_m, config.relief.height_m, 0.05 * config.relief.height_m);
    EXPECT_GT(coin.raised_share, 0.08);
    EXPECT_LT(coin.raised_share, 0.75);
    const ByteImage picture = relief_picture(config, relief, 64);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      double difference = 0.0;
      for (std::size_t k = 0; k < picture.pixels.size(); ++k)
        difference += std::abs(int{picture.pixels[k]} - int{pictures[i].pixels[k]}) / 255.0;
      EXPECT_GT(difference / static_cast<double>(picture.pixels.size()), 0.03) << "like " << paths[i].filename();
    }
    pictures.push_back(picture);
  }
}

TEST(Emboss, FullResolutionHasHalfAMillionVertices) {
  const auto config = read_config<EmbossConfig>(kConfigs / "star.yaml");
  const EmbossedCoin coin = emboss(config, face_relief(config));
  EXPECT_GE(coin.mesh.num_vertices(), 500000);
  EXPECT_EQ(coin.mesh.num_triangles(), 2 * coin.mesh.num_vertices() - 4);  // Euler, closed
  EXPECT_LT(coin.spacing_m, 15e-6);
  double least = 1.0;
  for (Eigen::Index t = 0; t < coin.mesh.num_triangles(); ++t) {
    const auto corner = [&](int c) -> Vector3 { return coin.mesh.positions.row(coin.mesh.triangles(t, c)); };
    least = std::min(least, (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm());
  }
  EXPECT_GT(least, 0.1 * coin.spacing_m * coin.spacing_m);
}

class EmbossProgram : public ProgramTest {
 protected:
  int run(const std::string& out, const std::string& more = "") {
    return run_command(fmt::format("{}/emboss --config '{}' --out '{}' {}", TACIPC_BIN_DIR,
                                   (scratch_ / "c.yaml").string(), (scratch_ / out).string(), more));
  }
};

TEST_F(EmbossProgram, SameBytesWithAnyNumberOfThreads) {
  scratch_.file("c.yaml", config_text("kind: cobbles, pitch_mm: 1.5, gap_mm: 0.3, seed: 4", 30000));
  ASSERT_EQ(run("a", "--threads 1"), 0) << said_;
  ASSERT_EQ(run("b", "--threads 4"), 0) << said_;
  for (const char* name : {"object.ply", "relief.png", "emboss.yaml"})
    EXPECT_EQ(read_file(scratch_ / (std::string("a/") + name)), read_file(scratch_ / (std::string("b/") + name)))
        << name;
  const TriangleMesh mesh = read_triangle_mesh(scratch_ / "a/object.ply", 1.0);
  EXPECT_GE(mesh.num_vertices(), 30000);
  EXPECT_NEAR(mesh.positions.col(2).maxCoeff(), 2.4e-3, 1e-6);
}

TEST_F(EmbossProgram, SaysWhatIsWrongWithAPicture) {
  scratch_.file("c.yaml", config_text("kind: image, file: mine.png, width_mm: 8"));
  EXPECT_EQ(run("out"), 1);
  EXPECT_EQ(said_,
            "emboss: error: " + (scratch_ / "mine.png").string() + ": cannot be read: No such file or directory\n");
  scratch_.file("mine.png", "no picture");
  EXPECT_EQ(run("out"), 1);
  EXPECT_THAT(said_, testing::StartsWith("emboss: error: " + (scratch_ / "mine.png").string() + ": "));
  EXPECT_FALSE(fs::exists(scratch_ / "out/emboss.yaml"));
  write_png(scratch_ / "mine.png", ByteImage(20, 10, 1, 128));
  EXPECT_EQ(run("out"), 1);
  EXPECT_EQ(said_, "emboss: error: " + (scratch_ / "mine.png").string() +
                       ": every pixel has the grey 128, so there is no relief\n");
  ByteImage half(20, 10, 1, 0);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 10; ++x) half.at(x, y, 0) = 255;
  write_png(scratch_ / "mine.png", half);
  EXPECT_EQ(run("out"), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/emboss.yaml"), testing::HasSubstr("\n  image:\n    path: "));
}

TEST_F(EmbossProgram, WarnsOfStrokesTooNarrowForTheirWalls) {
  scratch_.file("c.yaml", config_text("kind: text, text: I, height_mm: 7, stroke_mm: 0.2", 50000));
  EXPECT_EQ(run("out"), 0);
  EXPECT_THAT(said_, testing::HasSubstr("of 0.400 mm: its parts are narrower than their walls"));
}

TEST_F(EmbossProgram, WrongConfigurationEndsWithTwo) {
  scratch_.file("c.yaml", config_text("kind: star, points: 2, outer_mm: 4, inner_mm: 2"));
  EXPECT_EQ(run("out"), 2);
  EXPECT_EQ(said_, (scratch_ / "c.yaml").string() + ":4:31: pattern.points: 2 is outside [3, 60]\n");
}

}  // namespace emboss_test
}  // namespace tacipc
