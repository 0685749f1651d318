// The whole stage, as a user calls it.
#include "stages/image/render/render.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/stages/image/render/render_stage.h"

namespace tacipc {
namespace render_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST_F(RenderStage, WritesTheReferenceAndTheLastFrame) {
  ASSERT_EQ(run(), 0) << said_;
  EXPECT_EQ(said_, "");
  for (const char* name :
       {"linear.exr", "depth.exr", "normal.exr", "indentation.exr", "tactile.png", "normal.png", "indentation.png"}) {
    EXPECT_TRUE(fs::exists(scratch_ / "out/frame_0000" / name)) << name;
    EXPECT_TRUE(fs::exists(scratch_ / "out/frame_0002" / name)) << name;
  }
  EXPECT_FALSE(fs::exists(scratch_ / "out/frame_0001"));
  const std::string record = read_file(scratch_ / "out/render.yaml");
  EXPECT_THAT(record, HasSubstr("reference: synthetic"));
  EXPECT_THAT(record, HasSubstr("nudged_rays: "));
  EXPECT_THAT(record, HasSubstr("outside_rays: 0"));
  EXPECT_THAT(record, HasSubstr("indirect_share: 0"));
  EXPECT_THAT(record, HasSubstr("unstated: "));
  // The deepest vertex lies on the axis, between rays: 0.4 mm less what the nearest rays and the facets miss.
  const FloatImage indentation = read_exr(scratch_ / "out/frame_0002/indentation.exr", {"Y"});
  EXPECT_NEAR(*std::max_element(indentation.pixels.begin(), indentation.pixels.end()), 0.4e-3, 0.02e-3);
  const FloatImage rest_normal = read_exr(scratch_ / "out/frame_0000/normal.exr", {"R", "G", "B"});
  EXPECT_FLOAT_EQ(rest_normal.at(5, 5, 2), 1.0f);
  EXPECT_FLOAT_EQ(read_exr(scratch_ / "out/frame_0000/depth.exr", {"Y"}).at(3, 3, 0), 5e-3f);
  // The mean of the reference is the level asked for, up to rounding and the noise of 2304 values.
  const ByteImage reference = read_png(scratch_ / "out/frame_0000/tactile.png", 3);
  double sum = 0.0;
  for (const std::uint8_t code : reference.pixels) sum += code;
  EXPECT_NEAR(sum / static_cast<double>(reference.pixels.size()), 127.5, 0.5);
}

TEST_F(RenderStage, WritesTheLastFrameOfEachPhase) {
  press(slab(4, 3), 6, [](double, double) { return 0.05e-3; });
  write_file(scratch_ / "config.yaml", "frames: phases\nnoise: {seed: 1}\n");
  EXPECT_EQ(run("refused"), 1);
  EXPECT_THAT(said_, HasSubstr("what is rendered has no phases"));
  // Two of a kind in a row are one: frames 1 and 2; 3; 4 and 5.
  write_npy(scratch_ / "press/phase.npy", {6}, std::vector<std::uint8_t>{0, 2, 2, 6, 2, 2}.data());
  ASSERT_EQ(run(), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/render.yaml"), HasSubstr("frames: [0, 2, 3, 5]"));
  for (int frame = 0; frame < 6; ++frame)
    EXPECT_EQ(fs::exists(scratch_ / fmt::format("out/frame_{:04}", frame)), frame != 1 && frame != 4) << frame;
}

TEST_F(RenderStage, WritesTheMapsThatADatasetWantsInItsPrecision) {
  ASSERT_EQ(run("all"), 0) << said_;
  const std::string flag = " --threads 1 --maps " + (scratch_ / "maps.yaml").string();
  write_file(scratch_ / "maps.yaml", "maps: [tactile, indentation, normal]\n");
  ASSERT_EQ(run("out", flag), 0) << said_;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(scratch_ / "out/frame_0002"))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("tactile.png", "indentation.exr", "normal.exr"));
  EXPECT_EQ(read_file(scratch_ / "out/frame_0002/tactile.png"), read_file(scratch_ / "all/frame_0002/tactile.png"));
  const auto largest_change = [&](const std::string& name, const std::vector<std::string>& channels) {
    const FloatImage here = read_exr(scratch_ / "out/frame_0002" / name, channels),
                     exact = read_exr(scratch_ / "all/frame_0002" / name, channels);
    double most = 0.0;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i)
      most = std::max(most, std::abs(double{here.pixels[i]} - exact.pixels[i]));
    return most;
  };
  const double length = largest_change("indentation.exr", {"Y"}), part = largest_change("normal.exr", {"R", "G", "B"});
  EXPECT_LE(length, std::ldexp(0.5, -25));
  EXPECT_GT(length, std::ldexp(0.2, -25));
  EXPECT_LE(part, std::ldexp(1.0, -11));  // a half just below 1
  EXPECT_GT(part, std::ldexp(0.2, -12));
  write_file(scratch_ / "maps.yaml", "maps: [tactile, norml]\n");
  EXPECT_EQ(run("refused", flag), 2);
  EXPECT_THAT(said_, HasSubstr("maps.yaml:1:17: maps[1]: 'norml' is not one of "));
}

TEST_F(RenderStage, BytesDoNotDependOnThreads) {
  ASSERT_EQ(run("one"), 0) << said_;
  ASSERT_EQ(run("two", "--threads 2"), 0) << said_;
  EXPECT_EQ(content_hash(scratch_ / "one"), content_hash(scratch_ / "two"));
}

TEST_F(RenderStage, AllFramesWhenAsked) {
  write_file(scratch_ / "config.yaml", "frames: all\nsubpixels: 1\nnoise: {seed: 1}\n");
  ASSERT_EQ(run(), 0) << said_;
  EXPECT_TRUE(fs::exists(scratch_ / "out/frame_0001/tactile.png"));
}

TEST_F(RenderStage, TheRealReferenceComesBackWhereNothingTouches) {
  ByteImage photograph(32, 24, 3);
  for (std::size_t i = 0; i < photograph.pixels.size(); ++i) {
    photograph.pixels[i] = static_cast<std::uint8_t>(60 + (i * i) % 120);
  }
  write_png(scratch_ / "photograph.png", photograph);
  write_file(scratch_ / "sensor.yaml", std::string(kSensor) + "reference_image: photograph.png\n");
  ASSERT_EQ(run(), 0) << said_;
  EXPECT_EQ(read_png(scratch_ / "out/frame_0000/tactile.png", 3).pixels, photograph.pixels);
  EXPECT_NE(read_png(scratch_ / "out/frame_0002/tactile.png", 3).pixels, photograph.pixels);
  EXPECT_THAT(read_file(scratch_ / "out/render.yaml"),
              HasSubstr("reference: " + content_hash(scratch_ / "photograph.png")));
}

TEST_F(RenderStage, RefusesAReferenceOfAnotherSize) {
  write_png(scratch_ / "photograph.png", ByteImage(64, 48, 3));
  write_file(scratch_ / "sensor.yaml", std::string(kSensor) + "reference_image: photograph.png\n");
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_,
            "render: error: photograph.png: the reference image has 64 x 48 pixels, the sensor's camera 32 x 24\n");
  EXPECT_FALSE(fs::exists(scratch_ / "out/render.yaml"));
}

TEST_F(RenderStage, RefusesAnUnfinishedPress) {
  fs::remove(scratch_ / "press/press.yaml");
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: press: has no press.yaml, so the press did not finish\n");
}

TEST_F(RenderStage, RefusesPositionsThatDoNotFitTheGel) {
  const NpyArray good = positions_;
  positions_.shape = {3, good.shape[1] * 3};
  write_positions();
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: press/positions.npy: has the shape (3, 1326), expected (frames, 442, 3)\n");

  positions_.shape = {1, good.shape[1] * 3, 3};
  write_positions();
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: press/positions.npy: has the shape (1, 1326, 3), expected (frames, 442, 3)\n");

  positions_ = good;
  positions_.data[(442 + 17) * 3 + 1] = std::numeric_limits<double>::quiet_NaN();
  write_positions();
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: press/positions.npy: frame 1: the value at [17, 1] is not finite\n");

  positions_ = good;
  positions_.data[3 * 5 + 2] += 0.02 * kMm;
  write_positions();
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_,
            "render: error: press/positions.npy: frame 0 is not the gel at rest: vertex 5 is 0.02 mm away from its "
            "place in the gel\n");
}

TEST_F(RenderStage, RefusesWrongConfigurations) {
  write_file(scratch_ / "config.yaml", "frames: first\nsubpixel: 2\nnoise: {evry_frame: true}\n");
  EXPECT_EQ(run(), 2);
  EXPECT_EQ(said_,
            "config.yaml:1:9: frames: 'first' is not one of last, phases, all\n"
            "config.yaml:2:1: subpixel: unknown key (did you mean subpixels?)\n"
            "config.yaml:3:8: noise.seed: missing\n"
            "config.yaml:3:9: noise.evry_frame: unknown key (did you mean every_frame?)\n");
}

TEST_F(RenderStage, RefusesLightsThatDoNotReachTheGel) {
  // Lights on the object's side of the gel, facing away from it.
  std::string sensor = kSensor;
  const std::size_t leds = sensor.find("leds:"), camera = sensor.find("camera:");
  sensor.replace(leds, camera - leds,
                 "leds: {list: [{position_mm: [0, 0, 5], rgb_linear: [1, 1, 1], intensity: 1},\n"
                 "              {position_mm: [1, 0, 3], rgb_linear: [1, 1, 1], intensity: 1}]}\n");
  write_file(scratch_ / "sensor.yaml", sensor);
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_,
            "render: warning: LED 0 lights nothing the camera sees\n"
            "render: warning: LED 1 lights nothing the camera sees\n"
            "render: error: no light reaches the front face: check the positions of the LEDs\n");
}

/// Contact and marker files that fit the slab: a square of contact that slips on its right half.
class RenderOutputs : public RenderStage {
 protected:
  void SetUp() override {
    RenderStage::SetUp();
    const std::vector<int> front = gel_.vertices(BoundaryTag::front);
    const std::size_t count = front.size();
    std::vector<std::int32_t> rows(front.begin(), front.end());
    std::vector<double> force(3 * count * 6, 0.0), markers;
    std::vector<std::uint8_t> state(3 * count, 0);
    for (std::size_t v = 0; v < count; ++v) {
      const double x = gel_.positions(front[v], 0), y = gel_.positions(front[v], 1);
      if (std::abs(x) > 0.55e-3 || std::abs(y) > 0.55e-3) continue;
      state[2 * count + v] = x > 0.0 ? 2 : 1;
      force[(2 * count + v) * 6 + 2] = -1e-3;  // normal, N
      force[(2 * count + v) * 6 + 3] = 2e-4;   // friction
    }
    for (int frame = 0; frame < 3; ++frame) {
      for (const double x : {-1.0, 0.0, 5.0}) markers.insert(markers.end(), {x * kMm, 0.5 * kMm, 0.0});
    }
    write_npy(scratch_ / "press/front_vertices.npy", {count}, rows.data());
    write_npy(scratch_ / "press/contact_force.npy", {3, count, 2, 3}, force.data());
    write_npy(scratch_ / "press/contact_state.npy", {3, count}, state.data());
    write_npy(scratch_ / "press/markers.npy", {3, 3, 3}, markers.data());
  }
};

TEST_F(RenderOutputs, ContactTractionAndMarkersHaveTheirImages) {
  write_file(
      scratch_ / "sensor.yaml",
      std::string(kSensor) + "markers: {rows: 3, columns: 3, pitch_mm: 0.8, radius_mm: 0.1, albedo: [0, 0, 0]}\n");
  ASSERT_EQ(run(), 0) << said_;
  const fs::path frame = scratch_ / "out/frame_0002";
  const ByteImage contact = read_png(frame / "contact.png", 1), slip = read_png(frame / "stick_slip.png", 1);
  const ByteImage segment = read_png(frame / "segment.png", 1);
  EXPECT_EQ(contact.at(16, 12, 0), 255);
  EXPECT_EQ(contact.at(2, 2, 0), 0);
  EXPECT_EQ(slip.at(13, 12, 0), 127);
  EXPECT_EQ(slip.at(19, 12, 0), 254);
  EXPECT_EQ(segment.at(2, 2, 0), 60);
  EXPECT_EQ(segment.at(16, 12, 0), 240);  // a marker in contact
  EXPECT_EQ(segment.at(13, 9, 0), 120);
  const FloatImage traction = read_exr(frame / "traction.exr", {"R", "G", "B"});
  // −1 mN on each vertex of 0.25 × 0.25 mm: 16 kPa where the gel is level enough.
  EXPECT_NEAR(traction.at(16, 12, 2), -16e3, 1.5e3);
  EXPECT_NEAR(traction.at(16, 12, 0) / traction.at(16, 12, 2), -0.2, 1e-5);
  const NpyArray px = read_npy(frame / "marker_px.npy");
  ASSERT_EQ(px.shape, (std::vector<std::size_t>{3, 2}));
  EXPECT_NEAR(px.data[0], 32 * (0.5 - 1.0 / 3.2), 1e-9);
  EXPECT_NEAR(px.data[1], 24 * (0.5 + 0.5 / 2.4), 1e-9);
  EXPECT_TRUE(std::isnan(px.data[4]));  // beside the picture
  const ByteImage with = read_png(frame / "marker.png", 3), without = read_png(frame / "tactile.png", 3);
  EXPECT_LT(with.at(16, 12, 1), without.at(16, 12, 1));
  EXPECT_EQ(with.at(2, 2, 1), without.at(2, 2, 1));
}

/// Where the press has stress: pressure and shear make up the traction again, pixel by pixel.
TEST_F(RenderOutputs, SplitTheTractionWhereThePressHasStress) {
  ASSERT_EQ(run(), 0) << said_;
  EXPECT_FALSE(fs::exists(scratch_ / "out/frame_0002/pressure.exr"));
  const std::vector<double> none(3 * 221 * 2, 0.0);
  write_npy(scratch_ / "press/front_pressure.npy", {3, 221, 2}, none.data());
  ASSERT_EQ(run(), 0) << said_;
  const fs::path frame = scratch_ / "out/frame_0002";
  const std::vector<std::string> rgb{"R", "G", "B"};
  const FloatImage traction = read_exr(frame / "traction.exr", rgb), normal = read_exr(frame / "normal.exr", rgb),
                   pressure = read_exr(frame / "pressure.exr", {"Y"}), shear = read_exr(frame / "shear.exr", rgb);
  EXPECT_NEAR(pressure.at(16, 12, 0), 16e3, 1.5e3);
  int seen = 0;
  for (int y = 0; y < traction.height; ++y) {
    for (int x = 0; x < traction.width; ++x) {
      double along = 0.0;
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(shear.at(x, y, c) - pressure.at(x, y, 0) * normal.at(x, y, c), traction.at(x, y, c), 0.01);
        along += double{shear.at(x, y, c)} * normal.at(x, y, c);
      }
      EXPECT_NEAR(along, 0.0, 0.02);
      seen += pressure.at(x, y, 0) > 1e3 ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 10);
  // A dataset says itself what it wants.
  write_file(scratch_ / "maps.yaml", "maps: [tactile, shear]\n");
  ASSERT_EQ(run("out", "--threads 1 --maps " + (scratch_ / "maps.yaml").string()), 0) << said_;
  EXPECT_TRUE(fs::exists(frame / "shear.exr"));
  EXPECT_FALSE(fs::exists(frame / "pressure.exr"));
}

TEST_F(RenderOutputs, RefusesFilesThatDoNotBelongTogether) {
  fs::remove(scratch_ / "press/contact_state.npy");
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: press: has one of contact_force.npy and contact_state.npy without the other\n");
  const std::uint8_t one = 1;
  write_npy(scratch_ / "press/contact_state.npy", {1, 1}, &one);
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: press/contact_state.npy: has the shape (1, 1), expected (3, 221)\n");
}

TEST_F(RenderStage, VariantsShareRaysOrTraceTheirOwn) {
  write_file(scratch_ / "other.yaml",
             std::string(kSensor).replace(std::string(kSensor).find("size_mm: 1.0"), 12, "size_mm: 0.2"));
  write_png(scratch_ / "photograph.png", ByteImage(32, 24, 3, 90));
  std::string sensor = kSensor;
  for (std::size_t at = sensor.find("{index"); at != std::string::npos; at = sensor.find("{index", at + 8))
    sensor.insert(at + 1, fmt::format("group: g{}, ", sensor[at + 8]));
  write_file(scratch_ / "sensor.yaml", sensor);
  write_file(scratch_ / "config.yaml", std::string(kConfig) + R"(variants:
  - {name: white, lights: [{group: g0, cct_k: 6500}, {group: g1, cct_k: 6500}, {group: g2, cct_k: 6500}]}
  - {name: dark_paint, coating_albedo: [0.2, 0.2, 0.2]}
  - {name: photograph, reference_image: photograph.png}
  - {name: small_leds, sensor: other.yaml}
  - {name: unit_7, unit: {seed: 7, led_position_mm: 0.3, led_intensity: 0.1, camera_position_mm: 0.2, camera_rotation_deg: 1}}
  - {name: unit_8, unit: {seed: 8, led_position_mm: 0.3, led_intensity: 0.1, camera_position_mm: 0.2, camera_rotation_deg: 1}}
)");
  ASSERT_EQ(run(), 0) << said_;
  const auto image = [&](const std::string& name, const std::string& file = "tactile.png") {
    return read_png(scratch_ / "out/frame_0002" / name / file, 3);
  };
  const auto linear = [&](const std::string& name) {
    return read_exr(scratch_ / "out/frame_0002" / name / "linear.exr", {"R", "G", "B"});
  };
  // Other paint: two fifths of the light at every point, and so the same codes after exposure.
  const FloatImage plain = linear(""), painted = linear("dark_paint");
  for (std::size_t i = 0; i < plain.pixels.size(); ++i)
    EXPECT_NEAR(painted.pixels[i], 0.4f * plain.pixels[i], 1e-6f * plain.pixels[i]);
  // One colour for all lights: the channels are that colour's multiples of each other.
  const FloatImage white = linear("white");
  const double ratio = white.at(5, 5, 1) / white.at(5, 5, 0);
  for (int x = 0; x < 32; ++x) EXPECT_NEAR(white.at(x, 9, 1) / white.at(x, 9, 0), ratio, 1e-5);
  EXPECT_EQ(read_png(scratch_ / "out/frame_0000/photograph/tactile.png", 3).pixels, ByteImage(32, 24, 3, 90).pixels);
  EXPECT_NE(image("small_leds").pixels, image("").pixels);
  EXPECT_NE(image("unit_7").pixels, image("").pixels);
  EXPECT_NE(image("unit_7").pixels, image("unit_8").pixels);
  EXPECT_TRUE(fs::exists(scratch_ / "out/frame_0002/unit_7/depth.exr"));
  EXPECT_FALSE(fs::exists(scratch_ / "out/frame_0002/white/depth.exr"));
  const std::string record = read_file(scratch_ / "out/render.yaml");
  EXPECT_THAT(record, HasSubstr("name: photograph"));
  EXPECT_THAT(record, HasSubstr("reference: photograph"));
  EXPECT_THAT(record, HasSubstr("photograph_reference:"));
  EXPECT_THAT(record, HasSubstr("small_leds_sensor:"));
}

TEST_F(RenderStage, RefusesVariantsThatMeanNothing) {
  write_file(scratch_ / "config.yaml",
             std::string(kConfig) +
                 "variants:\n  - {name: a}\n  - {name: \"../b\", coating_albedo: [1, 1, 1]}\n"
                 "  - {name: c, coating_albedo: [0, 0, 0]}\n  - {name: c, coating_albedo: [1, 1, 1]}\n");
  EXPECT_EQ(run(), 2);
  EXPECT_EQ(said_,
            "config.yaml:4:12: variants[0].name: the variant changes nothing: give sensor, lights, coating_albedo, "
            "reference_image or unit\n"
            "config.yaml:5:12: variants[1].name: must be letters, digits, _ and -\n"
            "config.yaml:7:12: variants[3].name: given twice\n");
  write_file(scratch_ / "config.yaml",
             std::string(kConfig) + "variants: [{name: a, lights: [{group: lamp, cct_k: 5000}]}]\n");
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: variant a: the sensor has no light group lamp\n");
}

TEST_F(RenderStage, EveryFrameMayHaveNoiseOfItsOwn) {
  write_file(scratch_ / "config.yaml", "transfer: none\nframes: all\nnoise: {seed: 1, every_frame: true}\n");
  ASSERT_EQ(run("noisy"), 0) << said_;
  ASSERT_EQ(run("again", "--threads 2"), 0) << said_;
  EXPECT_EQ(content_hash(scratch_ / "noisy"), content_hash(scratch_ / "again"));
  write_file(scratch_ / "config.yaml", "transfer: none\nframes: all\nnoise: {seed: 1}\n");
  ASSERT_EQ(run("clean"), 0) << said_;
  double squares = 0.0;
  const ByteImage noisy = read_png(scratch_ / "noisy/frame_0001/tactile.png", 3);
  const ByteImage clean = read_png(scratch_ / "clean/frame_0001/tactile.png", 3);
  for (std::size_t i = 0; i < noisy.pixels.size(); ++i) squares += std::pow(noisy.pixels[i] - clean.pixels[i], 2.0);
  const double rms = std::sqrt(squares / static_cast<double>(noisy.pixels.size()));
  // Mid grey: some 1000 of 5000 electrons ± 32, a code is about 11 of them there.
  EXPECT_GT(rms, 1.5);
  EXPECT_LT(rms, 5.0);
}

TEST_F(RenderStage, SamplesOfADatasetHaveNoiseOfTheirOwn) {
  ASSERT_EQ(run("alone"), 0) << said_;
  EXPECT_EQ(read_file(scratch_ / "alone/render.yaml").find("\nseed:"), std::string::npos);
  for (const auto& [out, more] : {std::pair{"a", "--seed 4503599627370497"},
                                  {"again", "--seed 4503599627370497 --threads 2"},
                                  {"b", "--seed 4503599627370498"}})
    ASSERT_EQ(run(out, more), 0) << said_;
  EXPECT_EQ(content_hash(scratch_ / "a"), content_hash(scratch_ / "again"));
  EXPECT_NE(read_file(scratch_ / "a/render.yaml").find("\nseed: 4503599627370497\n"), std::string::npos);
  const auto image = [&](const std::string& out, const char* frame) {
    return read_png(scratch_ / (out + "/" + frame + "/tactile.png"), 3);
  };
  // Independent noise of two images: the difference has √2 times the deviation of one, some 2 codes (above).
  for (const std::string other : {"alone", "b"}) {
    for (const char* frame : {"frame_0000", "frame_0002"}) {
      const ByteImage a = image("a", frame), b = image(other, frame);
      double squares = 0.0;
      for (std::size_t i = 0; i < a.pixels.size(); ++i) squares += std::pow(a.pixels[i] - b.pixels[i], 2.0);
      const double rms = std::sqrt(squares / static_cast<double>(a.pixels.size()));
      EXPECT_GT(rms, 2.1) << other << " " << frame;
      EXPECT_LT(rms, 7.1) << other << " " << frame;
    }
  }
  // What the press did is the same whatever the noise.
  for (const char* file : {"depth.exr", "linear.exr", "normal.png"})
    EXPECT_EQ(content_hash(scratch_ / "a/frame_0002" / file), content_hash(scratch_ / "b/frame_0002" / file)) << file;
  // A number of the configuration's gives other noise to the same sample.
  write_file(scratch_ / "config.yaml", "frames: last\nnoise: {seed: 2}\n");
  ASSERT_EQ(run("c", "--seed 4503599627370497"), 0) << said_;
  EXPECT_NE(image("a", "frame_0000").pixels, image("c", "frame_0000").pixels);
  for (const char* wrong : {"--seed -1", "--seed 1.5", "--seed x", "--seed 18446744073709551616"}) {
    EXPECT_EQ(run("wrong", wrong), 2) << wrong;
    EXPECT_NE(said_.find("is not a count"), std::string::npos) << said_;
  }
}

TEST_F(RenderStage, RefusesASensorThatSaysNothingOfItsReference) {
  std::string sensor = kSensor;
  sensor.erase(sensor.find("noise:"));
  write_file(scratch_ / "sensor.yaml", sensor);
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_,
            "render: error: slab: the sensor has neither a reference_image nor a section noise to make one with\n");
}

}  // namespace render_test
}  // namespace tacipc
