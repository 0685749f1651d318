#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>

#include "common/image/image.h"
#include "common/rival/light_network.h"
#include "common/rival/metallic_lamps.h"
#include "common/rival/slope_table.h"
#include "common/sensor/light_field.h"
#include "common/sensor/sensor.h"
#include "tests/config_text.h"
#include "tests/program_test.h"

namespace tacipc {
namespace calibrate_program_test {

class CalibrateProgram : public ProgramTest {
 protected:
  void SetUp() override {
    std::string sensor = read_file(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/gelsight_lab.yaml");
    for (const auto& [from, to] : {std::pair{"width_px: 320", "width_px: 60"}, {"height_px: 320", "height_px: 60"}})
      sensor.replace(sensor.find(from), std::string(from).size(), to);
    scratch_.file("sensor.yaml", sensor);
    write_png(scratch_ / "background.png", ByteImage(60, 60, 3, 120));
    std::filesystem::create_directories(scratch_ / "photos");
    std::string labels;
    for (int i = 0; i < 4; ++i) {
      // A bump whose slope along x brightens red and along y darkens blue.
      ByteImage photo(60, 60, 3, 121);
      FloatImage map(60, 60, 1);
      const int cx = 24 + 4 * i, cy = 34 - 3 * i;
      for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x) {
          const double u = 0.25 * (x - cx), v = 0.25 * (y - cy), z = 0.5e-3 * std::exp(-0.5 * (u * u + v * v));
          map.at(x, y, 0) = static_cast<float>(z);
          photo.at(x, y, 0) = static_cast<std::uint8_t>(std::lround(121 + 1e5 * z * -u * 0.8));
          photo.at(x, y, 2) = static_cast<std::uint8_t>(std::lround(121 + 1e5 * z * v * 0.6));
        }
      write_png(scratch_ / fmt::format("photos/b{}.png", i), photo);
      write_exr(scratch_ / fmt::format("s{}.exr", i), map, {"Y"});
      labels += fmt::format("b{}.png ({}, {}) 8\n", i, cx, cy);
    }
    scratch_.file("labels.txt", labels);
    scratch_.file("c.yaml",
                  "ball_radius_mm: 3\ncontact_gap_mm: 0.02\nlabel_sigma_px: 0\nfit_radius_px: 18\nfit_stride_px: 1\n"
                  "drift_radius_px: 20\nlamps: []\nenvironment_degree: 3\nshadow_softness: 0.2\nblur_px: 0\nridge: "
                  "1.0e-6\nfolds: 2\n");
    scratch_.file("i.yaml", "intensities: {curve: linear, shot_gain: 0, read_noise: 0.01, block_px: 2}\n");
  }
  int run(const std::string& more) {
    return run_command(
        fmt::format("cd '{}' && {}/calibrate --sensor sensor.yaml --background background.png --log-level error {}",
                    (scratch_ / "").string(), TACIPC_BIN_DIR, more));
  }
  const std::string balls_ = "--config c.yaml --photographs photos --labels labels.txt ";
  const std::string shapes_ = "--shapes s0.exr s1.exr s2.exr s3.exr ";
};

TEST_F(CalibrateProgram, AnEnvironmentFromShapesExplainsItsPhotographsWithAnyThreads) {
  ASSERT_EQ(run(balls_ + shapes_ + "--out a --threads 1"), 0) << said_;
  ASSERT_EQ(run(balls_ + shapes_ + "--out b --threads 3"), 0) << said_;
  EXPECT_EQ(content_hash(scratch_ / "a"), content_hash(scratch_ / "b"));
  const LightField light = config_from_text<LightField>(read_file(scratch_ / "a/light.yaml"), "light.yaml");
  EXPECT_TRUE(light.geometry.lamps_m.empty());
  EXPECT_EQ(light.geometry.environment_degree, 3);
  const ByteImage residual = read_png(scratch_ / "a/residuals/b2.png", 3);
  int worst = 0;
  for (const std::uint8_t code : residual.pixels) worst = std::max(worst, std::abs(int{code} - 128));
  EXPECT_LE(worst, 16);  // 8 codes of a change of up to 24
  EXPECT_THAT(read_file(scratch_ / "a/calibrate.yaml"), testing::HasSubstr("model: environment\n"));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "a/ball_poses.npy"));
  // The same light in a sensor file that every stage takes, with the photograph it changes.
  const Sensor sensor = read_config<Sensor>(scratch_ / "a/sensor.yaml");
  EXPECT_TRUE(sensor.leds.empty());
  EXPECT_EQ(sensor.light_field.value().weights, light.weights);
  EXPECT_EQ(read_png(sensor.reference_image.value(), 3).pixels, read_png(scratch_ / "background.png", 3).pixels);
}

TEST_F(CalibrateProgram, LedColoursComeFromTheirBasisImages) {
  FloatImage ramp(60, 60, 3), other(60, 60, 3);
  ByteImage photo(60, 60, 3);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) {
      for (int c = 0; c < 3; ++c) {
        ramp.at(x, y, c) = static_cast<float>(x) / 60.0f;
        other.at(x, y, c) = static_cast<float>(y) / 60.0f;
        photo.at(x, y, c) =
            static_cast<std::uint8_t>(std::lround(255 * (0.1 + 0.2 * c * x / 60.0 + (0.4 - 0.2 * c) * y / 60.0)));
      }
    }
  write_exr(scratch_ / "l0.exr", ramp, {"R", "G", "B"});
  write_exr(scratch_ / "l1.exr", other, {"R", "G", "B"});
  write_png(scratch_ / "background.png", photo);
  ASSERT_EQ(run("--config i.yaml --basis l0.exr l1.exr --out a"), 0) << said_;
  ConfigReader in = ConfigReader::from_text(read_file(scratch_ / "a/leds.yaml"), "leds.yaml");
  auto leds = in.sections("leds");
  ASSERT_EQ(leds.size(), 2u);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(leds[0].numbers("rgb_linear", 3)[c], 0.2 * static_cast<double>(c), 0.004);
    EXPECT_NEAR(leds[1].numbers("rgb_linear", 3)[c], 0.4 - 0.2 * static_cast<double>(c), 0.004);
    EXPECT_NEAR(in.section("ambient").numbers("rgb", 3)[c], 0.1, 0.004);
  }
}

TEST_F(CalibrateProgram, LightsOfOtherSimulatorsComeFromTheSameBalls) {
  scratch_.file("table.yaml",
                "{model: table, bins: 21, samples: all, smoothing_bins: 1, ridge: 0.01, flat_is_dark: true}\n");
  scratch_.file("network.yaml", "{model: network, epochs: 2, batch: 100, rate: 0.001, dropout: 0.05, seed: 1}\n");
  scratch_.file(
      "lamps.yaml",
      "model: metallic_roughness\nmetallic_lamps: {change_factor: 0.5, lamps: [{position_mm: [28, 0, -11], rgb: "
      "[1, 0, 0]}, {position_mm: [0, 28, -11], rgb: [0, 0, 1]}]}\n");
  for (const std::string model : {"table", "network", "lamps"}) {
    ASSERT_EQ(run(fmt::format("{}--rival {}.yaml --out {} --threads 1", balls_, model, model)), 0) << said_;
    ASSERT_EQ(run(fmt::format("{}--rival {}.yaml --out again_{} --threads 3", balls_, model, model)), 0) << said_;
    EXPECT_EQ(content_hash(scratch_ / model), content_hash(scratch_ / ("again_" + model)));
  }
  EXPECT_EQ(SlopeTable::read(scratch_ / "table/light.npy").bins, 21);
  LightNetwork::read(scratch_ / "network/light.npy");
  EXPECT_EQ(read_config<MetallicLamps>(scratch_ / "lamps/light.yaml").lamps.size(), 2U);
  for (const std::string model : {"table", "lamps"}) {
    ConfigReader record = ConfigReader::from_file(scratch_ / (model + "/calibrate.yaml"));
    ConfigReader summary = record.section("summary");
    EXPECT_GT(summary.number("held_out_rmse_codes"), summary.number("rmse_codes"));
  }
  // Contacts of our fit in place of the labels' circles: another centre is another table.
  scratch_.file("balls.csv",
                "image,x_mm,y_mm,contact_mm\nb0.png,-1.7,1.4,2.0\nb1.png,-0.5,0.5,2.0\nb2.png,0.7,-0.5,2.0\n"
                "b3.png,2,-1.4,2.0\n");
  ASSERT_EQ(run(balls_ + "--rival table.yaml --balls balls.csv --out moved"), 0) << said_;
  EXPECT_NE(read_file(scratch_ / "moved/light.npy"), read_file(scratch_ / "table/light.npy"));
  scratch_.file("balls.csv", "image,x_mm,y_mm,contact_mm\nb1.png,-1.7,1.4,2.0\n");
  EXPECT_EQ(run(balls_ + "--rival table.yaml --balls balls.csv --out a"), 1);
  EXPECT_EQ(said_, "calibrate: error: balls.csv:2: b1.png is not the ball of the labels there\n");
  EXPECT_EQ(run(balls_ + "--balls balls.csv --out a"), 2);
  EXPECT_EQ(said_, "calibrate: error: --balls: is for --rival alone\n");
  EXPECT_EQ(run(balls_ + shapes_ + "--rival table.yaml --out a"), 2);
  EXPECT_EQ(said_, "calibrate: error: --rival: --shapes has one map for each known object: 4 maps, 0 objects\n");
  EXPECT_EQ(run(balls_ + "--press photos --gel c.yaml --rival table.yaml --out a"), 2);
  EXPECT_EQ(said_,
            "calibrate: error: --rival: has membranes of its own; leave out --press, --gel and --object-press\n");
}

// Steep walls that no ball shows: every light learns from them.
TEST_F(CalibrateProgram, LightsOfOtherSimulatorsComeFromKnownObjectsToo) {
  scratch_.file("table.yaml",
                "{model: table, bins: 21, samples: all, smoothing_bins: 0, ridge: 0.01, flat_is_dark: true}\n");
  scratch_.file("network.yaml", "{model: network, epochs: 2, batch: 100, rate: 0.001, dropout: 0.05, seed: 1}\n");
  scratch_.file("lamps.yaml",
                "model: metallic_roughness\nmetallic_lamps: {change_factor: 0.5, lamps: [{position_mm: [28, 0, -11], "
                "rgb: [1, 0, 0]}, {position_mm: [0, 28, -11], rgb: [0, 0, 1]}]}\n");
  scratch_.file(
      "objects.yaml",
      "objects: [{name: ridge, photograph: ridge.png, frame: 1, center_px: [30, 30], box_px: [15, 15, 30, 30], "
      "yaw: false}]\n");
  // A ridge along y whose walls rise by 2: the right one dark, the left one bright.
  constexpr double kPixelM = 18.963e-3 / 60;
  ByteImage photo(60, 60, 3, 121);
  FloatImage map(60, 60, 1);
  for (int y = 20; y < 40; ++y)
    for (int x = 21; x < 40; ++x) {
      map.at(x, y, 0) = static_cast<float>(2.0 * kPixelM * (10 - std::abs(x - 30)));
      photo.at(x, y, 0) = x < 30 ? 200 : x > 30 ? 40 : 121;
    }
  write_png(scratch_ / "photos/ridge.png", photo);
  write_exr(scratch_ / "ridge.exr", map, {"Y"});
  const std::string known = balls_ + "--objects objects.yaml --shapes ridge.exr ";
  for (const std::string model : {"table", "network", "lamps"}) {
    ASSERT_EQ(run(fmt::format("{}--rival {}.yaml --out balls_{}", balls_, model, model)), 0) << said_;
    ASSERT_EQ(run(fmt::format("{}--rival {}.yaml --out {}", known, model, model)), 0) << said_;
    const std::string file = fmt::format("{}/light.{}", model, model == "lamps" ? "yaml" : "npy");
    EXPECT_NE(read_file(scratch_ / file), read_file(scratch_ / ("balls_" + file))) << model;
    EXPECT_THAT(read_file(scratch_ / (model + "/calibrate.yaml")), testing::HasSubstr("objects: 1\n"));
  }
  // A margin is a wider box for what is fitted about the contact, too; without it this box cuts the ridge.
  std::string narrow = read_file(scratch_ / "objects.yaml");
  narrow.replace(narrow.find("[15, 15, 30, 30]"), 16, "[23, 23, 14, 14]");
  scratch_.file("narrow.yaml", narrow);
  scratch_.file("margin.yaml", read_file(scratch_ / "c.yaml") + "object_margin_px: 8\n");
  scratch_.file("everything.yaml", read_file(scratch_ / "c.yaml") + "object_margin_px: 40\n");
  const auto with = [](const std::string& config, const std::string& objects, const std::string& fit) {
    return fmt::format("--photographs photos --labels labels.txt --config {} --objects {} {} ", config, objects, fit);
  };
  const auto light_of = [&](const std::string& flags) {
    std::filesystem::remove_all(scratch_ / "margin");
    EXPECT_EQ(run(flags + "--out margin"), 0) << said_;
    const bool yaml = std::filesystem::exists(scratch_ / "margin/light.yaml");
    return read_file(scratch_ / (yaml ? "margin/light.yaml" : "margin/light.npy"));
  };
  for (const std::string fit :
       {"--rival lamps.yaml --shapes ridge.exr", "--shapes s0.exr s1.exr s2.exr s3.exr ridge.exr"}) {
    const std::string wide = light_of(with("margin.yaml", "narrow.yaml", fit));
    EXPECT_EQ(wide, light_of(with("c.yaml", "objects.yaml", fit))) << fit;
    EXPECT_NE(wide, light_of(with("c.yaml", "narrow.yaml", fit))) << fit;
    EXPECT_EQ(run(with("everything.yaml", "narrow.yaml", fit) + "--out a"), 1);
    EXPECT_EQ(said_, "calibrate: error: ridge.png: no pixel lies far enough from the contact to tell the drift\n");
  }
  for (const std::string fit : {"--rival table.yaml --shapes ridge.exr", "--rival network.yaml --shapes ridge.exr"}) {
    EXPECT_EQ(light_of(with("margin.yaml", "narrow.yaml", fit)), light_of(with("c.yaml", "narrow.yaml", fit))) << fit;
  }
  // x and y from −1 to 1 over the image: this pixel's terms, and the red of the wall beside it.
  const SlopeTable table = SlopeTable::read(scratch_ / "table/light.npy");
  const auto terms = SlopeTable::terms(25, 30, 60, 60);
  EXPECT_NEAR(table.change(2.0, 0.0, terms)[0], 200 - 121, 4.0);
  EXPECT_NEAR(table.change(-2.0, 0.0, terms)[0], 40 - 121, 4.0);
  EXPECT_LT(std::abs(SlopeTable::read(scratch_ / "balls_table/light.npy").change(2.0, 0.0, terms)[0]), 40.0);
  EXPECT_EQ(run(balls_ + "--objects objects.yaml --rival table.yaml --out a"), 2);
  EXPECT_EQ(said_, "calibrate: error: --rival: --shapes has one map for each known object: 0 maps, 1 objects\n");
  write_exr(scratch_ / "ridge.exr", FloatImage(60, 60, 1), {"Y"});
  EXPECT_EQ(run(known + "--rival table.yaml --out a"), 1);
  EXPECT_EQ(said_, "calibrate: error: ridge.exr: ridge is not in the gel\n");
}

TEST_F(CalibrateProgram, WrongFlagsAndFilesAreSaidOnce) {
  EXPECT_EQ(run("--config c.yaml --out a"), 2);
  EXPECT_EQ(
      said_,
      "calibrate: error: give --photographs and --labels of balls, or --basis, or a configuration with sensor_fit\n");
  EXPECT_EQ(run(balls_ + "--out a"), 2);
  EXPECT_EQ(said_, "calibrate: error: give either --press or --shapes\n");
  EXPECT_EQ(run(balls_ + "--shapes s0.exr --out a"), 2);
  EXPECT_EQ(said_, "calibrate: error: 1 --shapes for 4 labels\n");
  EXPECT_EQ(run("--config i.yaml --basis s0.exr --labels labels.txt --out a"), 2);
  EXPECT_EQ(said_, "calibrate: error: --labels cannot be combined with --basis\n");
  write_png(scratch_ / "photos/b1.png", ByteImage(60, 61, 3, 121));
  EXPECT_EQ(run(balls_ + shapes_ + "--out a"), 1);
  EXPECT_EQ(said_, "calibrate: error: photos/b1.png: is 60 x 61 pixels, the sensor's camera has 60 x 60\n");
}

}  // namespace calibrate_program_test
}  // namespace tacipc
