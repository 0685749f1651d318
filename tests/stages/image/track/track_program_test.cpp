#include <fmt/core.h>
#include <gmock/gmock.h>

#include <sstream>

#include "common/config/config.h"
#include "common/format/npy.h"
#include "common/image/image.h"
#include "tests/program_test.h"
#include "tests/shared_data.h"
#include "tests/stages/image/track/drawn_dots.h"

namespace tacipc {
namespace track_program_test {

const std::string kSource = TACIPC_SOURCE_DIR;

class TrackProgram : public ProgramTest {
 protected:
  /// A stage in the scratch folder; everything it says is in said_.
  int stage(const std::string& arguments) {
    return run_command(
        fmt::format("cd '{}' && {}/{} --log-level error", (scratch_ / "").string(), TACIPC_BIN_DIR, arguments));
  }

  /// A text with `old` replaced by `fresh`, which must occur.
  static std::string with(std::string text, const std::string& old, const std::string& fresh) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return at == std::string::npos ? text : text.replace(at, old.size(), fresh);
  }

  double summary(const std::string& record, const std::string& key) {
    ConfigReader in = ConfigReader::from_file(scratch_ / record);
    ConfigReader lines = in.section("summary");
    return lines.number(key);
  }
};

// A ball pressed 0.4 mm into a coarse gel and dragged 0.7 mm: every marker that the pictures show is found where it is
// projected to, within 0.1 px. Its dots are small, for the mean over a larger one is not where its centre goes.
TEST_F(TrackProgram, AgreesWithProjectedMarkersThroughPressAndShear) {
  std::string sensor = read_file(kSource + "/configs/sensors/mctac.yaml");
  sensor = with(with(sensor, "width_px: 640", "width_px: 320"), "height_px: 480", "height_px: 240");
  scratch_.file("sensor.yaml", with(sensor, "pitch_mm: 1.0\n  radius_mm: 0.2\n", "pitch_mm: 1.0\n  radius_mm: 0.1\n"));
  std::string mesh = read_file(kSource + "/configs/gels/tiny.yaml");
  mesh = with(with(mesh, "centre_mm: 1.2", "centre_mm: 0.5"), "centre_radius_mm: 2", "centre_radius_mm: 2.4");
  mesh = with(with(mesh, "inner_mm: 2", "inner_mm: 0.8"), "back_mm: 2.2", "back_mm: 1.6");
  scratch_.file("mesh.yaml", mesh);
  scratch_.file("ball.yaml", "ball: {radius_mm: 4, edge_mm: 0.2}\n");
  scratch_.file("motion.yaml",
                "motion:\n  - {kind: press, depth_mm: 0.4, steps: 2}\n"
                "  - {kind: shear, direction_deg: 30, distance_mm: 0.7, steps: 3}\n");
  scratch_.file("render.yaml", "frames: all\nsubpixels: 4\nled_samples: 1\nnoise: {seed: 1}\n");
  scratch_.file("track.yaml", "dots: {least_diameter_px: 3, most_diameter_px: 10}\n");
  ASSERT_EQ(stage("tetmesh --sensor sensor.yaml --config mesh.yaml --out gel"), 0) << said_;
  ASSERT_EQ(stage("indenter --config ball.yaml --out ball"), 0) << said_;
  ASSERT_EQ(stage(fmt::format("press --name t --sensor sensor.yaml --config {0}/configs/press/default.yaml --sample "
                              "motion.yaml --gel gel/gel.msh --object ball/object.ply --object-config "
                              "{0}/configs/objects/embossed.yaml --out press",
                              kSource)),
            0)
      << said_;
  ASSERT_EQ(stage("render --config render.yaml --sensor sensor.yaml --gel gel/gel.msh --press press --out render"), 0)
      << said_;
  ASSERT_EQ(stage("track --config track.yaml --render render --out track"), 0) << said_;

  const NpyArray track = read_npy(scratch_ / "track/marker_track.npy");
  EXPECT_EQ(track.shape, (std::vector<std::size_t>{6, 165, 2}));
  EXPECT_EQ(read_npy(scratch_ / "track/marker_quality.npy").shape, (std::vector<std::size_t>{6, 165}));
  EXPECT_GT(summary("track/track.yaml", "longest_displacement_px"), 10.0);
  EXPECT_EQ(summary("track/track.yaml", "known_markers"), 165);
  EXPECT_EQ(summary("track/track.yaml", "known_places_lost"), 0);
  EXPECT_LT(summary("track/track.yaml", "mean_error_px"), 0.05);
  EXPECT_LT(summary("track/track.yaml", "max_error_px"), 0.1);

  // Told where the press's markers begin, it answers in their order.
  ASSERT_EQ(stage("track --config track.yaml --render render --start render/frame_0000/marker_px.npy --out named"), 0)
      << said_;
  const NpyArray named = read_npy(scratch_ / "named/marker_track.npy");
  const NpyArray last = read_npy(scratch_ / "render/frame_0005/marker_px.npy");
  ASSERT_EQ(named.shape, (std::vector<std::size_t>{6, 361, 2}));
  double largest = 0.0;
  int found = 0;
  for (std::size_t i = 0; i < 361; ++i) {
    const double* at = named.data.data() + (5 * 361 + i) * 2;
    if (std::isnan(at[0])) continue;
    ++found;
    largest = std::max(largest, std::hypot(at[0] - last.data[2 * i], at[1] - last.data[2 * i + 1]));
  }
  EXPECT_EQ(found, 165);
  EXPECT_LT(largest, 0.1);
}

// Photographs of a real sensor before and after a shear, against the whole pixels that others measured in them.
TEST_F(TrackProgram, AgreesWithWholePixelsOfPublishedPhotographs) {
  TACIPC_SHARED_DATA(folder, "data/fots_markers");
  const auto rows = [&](const std::string& name) {
    std::istringstream text(read_file(folder / name));
    std::string line;
    std::getline(text, line);
    std::vector<std::array<double, 4>> out;
    while (std::getline(text, line)) {
      std::array<double, 4> v{};
      EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &v[0], &v[1], &v[2], &v[3]), 4) << line;
      out.push_back(v);
    }
    return out;
  };
  const auto press = rows("0.csv"), shear = rows("1.csv");
  ASSERT_EQ(press.size(), 99u);
  ASSERT_EQ(shear.size(), 99u);
  std::vector<double> start;
  for (const auto& row : press) start.insert(start.end(), {row[0] + row[2] + 0.5, row[1] + row[3] + 0.5});
  write_npy(scratch_ / "start.npy", {99, 2}, start.data());
  scratch_.file("track.yaml", "dots: {least_diameter_px: 6, most_diameter_px: 20}\n");
  ASSERT_EQ(stage(fmt::format("track --config track.yaml --image '{0}/0.png' --image '{0}/1.png' --start start.npy "
                              "--out track",
                              folder.string())),
            0)
      << said_;
  const NpyArray track = read_npy(scratch_ / "track/marker_track.npy");
  const NpyArray quality = read_npy(scratch_ / "track/marker_quality.npy");
  double sum = 0.0;
  int count = 0;
  for (std::size_t m = 0; m < 99; ++m) {
    if (quality.data[m] != 2 || quality.data[99 + m] != 2) continue;
    const double dx = track.data[(99 + m) * 2] - track.data[2 * m],
                 dy = track.data[(99 + m) * 2 + 1] - track.data[2 * m + 1];
    sum += std::hypot(dx - (shear[m][2] - press[m][2]), dy - (shear[m][3] - press[m][3]));
    ++count;
  }
  EXPECT_GE(count, 70);         // the others are cut by the edge, or scratched in the contact
  EXPECT_LT(sum / count, 0.8);  // two roundings to whole pixels alone make 0.5
}

TEST_F(TrackProgram, WhatIsWrongIsSaid) {
  scratch_.file("track.yaml", "dots: {least_diameter_px: 4, most_diameter_px: 10}\n");
  EXPECT_EQ(stage("track --config track.yaml --out a"), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr("give either --render or --image"));
  std::filesystem::create_directories(scratch_ / "render/frame_0000");
  EXPECT_EQ(stage("track --config track.yaml --render render --out a"), 1);
  EXPECT_THAT(said_, ::testing::HasSubstr("render: has no render.yaml"));
  scratch_.file("render/render.yaml", "stage: render\n");
  EXPECT_EQ(stage("track --config track.yaml --render render --out a"), 1);
  EXPECT_THAT(said_, ::testing::HasSubstr("render/frame_0000/marker.png: is not there; the sensor prints no markers"));
  write_png(scratch_ / "a.png", drawn_dots(40, 30, {{20, 15}}, 3.0, 0.1, even_light));
  const std::vector<double> flat(3, 1.0);
  write_npy(scratch_ / "start.npy", {3}, flat.data());
  EXPECT_EQ(stage("track --config track.yaml --image a.png --start start.npy --out a"), 1);
  EXPECT_THAT(said_, ::testing::HasSubstr("start.npy: has the shape (3,), expected (#M, 2)"));
  EXPECT_EQ(stage("track --config track.yaml --image a.png --out a"), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "a/tracks.csv"),
              ::testing::StartsWith("marker,frame,x_px,y_px,dx_px,dy_px,quality\n0,0,20"));
}

}  // namespace track_program_test
}  // namespace tacipc
