// The whole stage, as a user calls it.
#include "stages/render/render.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "common/error.h"
#include "common/files.h"
#include "common/light_field.h"
#include "common/optics/seen_membrane.h"
#include "tests/common/optics/test_surfaces.h"
#include "tests/program_test.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const char* const kSensor = R"(name: slab
gel: {outline: rectangle, size_mm: [4.0, 3.0], thickness_mm: 1.0}
material: {law: neo_hookean, density_kg_m3: 1010, youngs_modulus_pa: 1.23e5, poissons_ratio: 0.43}
coating: {albedo: [0.5, 0.5, 0.5]}
leds:
  size_mm: 1.0
  ring:
    {radius_mm: 4.0, z_mm: -5.0, count: 3, lit: [{index: 0, rgb_linear: [1, 0.1, 0.1], intensity: 1},
     {index: 1, rgb_linear: [0.1, 1, 0.1], intensity: 1}, {index: 2, cct_k: 9000, intensity: 1}]}
camera: {position_mm: [0, 0, -5], width_px: 32, height_px: 24, window_mm: [3.2, 2.4]}
response: {mean_level: 0.5, curve: srgb}
noise: {full_well_e: 5000, read_e: 4}
)";
const char* const kConfig = "frames: last\nnoise: {seed: 1}\n";

/// A slab of 4 × 3 × 1 mm, one cell thick, each cell cut into six tets about its diagonal.
TetMesh slab(int nx, int ny) {
  TetMesh gel;
  gel.positions.resize(2 * (nx + 1) * (ny + 1), 3);
  const auto index = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        gel.positions.row(index(i, j, k)) << kMm * (4.0 * i / nx - 2.0), kMm * (3.0 * j / ny - 1.5), kMm * (k - 1.0);
      }
    }
  }
  gel.tets.resize(6 * nx * ny, 4);
  // Paths from corner 000 to 111 along the axes in all six orders; odd orders swap two vertices to stay positive.
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  int tet = 0;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      for (int o = 0; o < 6; ++o) {
        int at[3] = {i, j, 0}, path[4] = {index(i, j, 0), 0, 0, 0};
        for (int step = 0; step < 3; ++step) {
          ++at[orders[o][step]];
          path[step + 1] = index(at[0], at[1], at[2]);
        }
        if (o >= 3) std::swap(path[1], path[2]);
        gel.tets.row(tet++) << path[0], path[1], path[2], path[3];
      }
    }
  }
  gel.boundary = boundary_triangles(gel.tets, gel.num_vertices());
  for (Eigen::Index f = 0; f < gel.boundary.rows(); ++f) {
    const double z[3] = {gel.positions(gel.boundary(f, 0), 2), gel.positions(gel.boundary(f, 1), 2),
                         gel.positions(gel.boundary(f, 2), 2)};
    const bool level = z[0] == z[1] && z[1] == z[2];
    gel.tags.push_back(!level ? BoundaryTag::side : z[0] == 0.0 ? BoundaryTag::front : BoundaryTag::glued);
  }
  return gel;
}

class RenderStage : public ProgramTest {
 protected:
  void SetUp() override {
    gel_ = slab(16, 12);
    positions_.shape = {3, static_cast<std::size_t>(gel_.num_vertices()), 3};
    for (int frame = 0; frame < 3; ++frame) {
      for (Eigen::Index v = 0; v < gel_.num_vertices(); ++v) {
        const double x = gel_.positions(v, 0), y = gel_.positions(v, 1), z = gel_.positions(v, 2);
        const double depth = 0.2e-3 * frame * std::exp(-(x * x + y * y) / (2.0 * 0.6e-3 * 0.6e-3));
        positions_.data.insert(positions_.data.end(), {x, y, z - depth * (1.0 + z / kMm)});
      }
    }
    write_file(scratch_ / "sensor.yaml", kSensor);
    write_file(scratch_ / "config.yaml", kConfig);
    write_file(scratch_ / "press/press.yaml", "stage: press\n");
    write_tet_mesh(scratch_ / "gel.msh", gel_);
    write_positions();
  }
  void write_positions() { write_npy(scratch_ / "press/positions.npy", positions_.shape, positions_.data.data()); }

  /// Runs the program; what it says is in said_, with the scratch folder's name left out.
  int run(const std::string& out = "out", const std::string& more = "--threads 1") {
    const int code = run_command(
        fmt::format("{}/render --log-level warning --config {} --sensor {} --gel {} --press {} --out {} {}",
                    TACIPC_BIN_DIR, (scratch_ / "config.yaml").string(), (scratch_ / "sensor.yaml").string(),
                    (scratch_ / "gel.msh").string(), (scratch_ / "press").string(), (scratch_ / out).string(), more));
    const std::string root = (scratch_ / "").string();
    for (std::size_t at = said_.find(root); at != std::string::npos; at = said_.find(root))
      said_.erase(at, root.size());
    return code;
  }

  TetMesh gel_;
  NpyArray positions_;
};

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
  const FloatImage rest_normal = read_exr(scratch_ / "out/frame_0000/normal.exr", {"X", "Y", "Z"});
  EXPECT_FLOAT_EQ(rest_normal.at(5, 5, 2), 1.0f);
  EXPECT_FLOAT_EQ(read_exr(scratch_ / "out/frame_0000/depth.exr", {"Z"}).at(3, 3, 0), 5e-3f);
  // The mean of the reference is the level asked for, up to rounding and the noise of 2304 values.
  const ByteImage reference = read_png(scratch_ / "out/frame_0000/tactile.png", 3);
  double sum = 0.0;
  for (const std::uint8_t code : reference.pixels) sum += code;
  EXPECT_NEAR(sum / static_cast<double>(reference.pixels.size()), 127.5, 0.5);
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
  EXPECT_EQ(said_, "render: error: press/positions.npy: has shape (3, 1326) where (frames, vertices, 3) is needed\n");

  positions_.shape = {1, good.shape[1] * 3, 3};
  write_positions();
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: press/positions.npy: has 1326 vertices, the gel 442\n");

  positions_ = good;
  positions_.data[(442 + 17) * 3 + 1] = std::numeric_limits<double>::quiet_NaN();
  write_positions();
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: press/positions.npy: frame 1, vertex 17 is not finite\n");

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
            "config.yaml:1:9: frames: 'first' is not one of last, all\n"
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
  const FloatImage traction = read_exr(frame / "traction.exr", {"X", "Y", "Z"});
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

TEST_F(RenderOutputs, RefusesFilesThatDoNotBelongTogether) {
  fs::remove(scratch_ / "press/contact_state.npy");
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: press: has one of contact_force.npy and contact_state.npy without the other\n");
  const std::uint8_t one = 1;
  write_npy(scratch_ / "press/contact_state.npy", {1, 1}, &one);
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "render: error: press/contact_state.npy: has shape (1, 1) where (3, 221) is needed\n");
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

TEST_F(RenderStage, RefusesASensorThatSaysNothingOfItsReference) {
  std::string sensor = kSensor;
  sensor.erase(sensor.find("noise:"));
  write_file(scratch_ / "sensor.yaml", sensor);
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_,
            "render: error: slab: the sensor has neither a reference_image nor a section noise to make one with\n");
}

/// kSensor with light calibrated on photographs in place of its LEDs.
std::string calibrated_sensor(const LightField& light) {
  std::string text = kSensor;
  for (const char* key : {"coating:", "leds:", "response:"}) {
    const std::size_t first = text.find(key), after = text.find_first_of("\n", first);
    std::size_t last = after + 1;
    while (last < text.size() && text[last] == ' ') last = text.find('\n', last) + 1;
    text.erase(first, last - first);
  }
  return text + "reference_image: photograph.png\n" + to_yaml(light.to_value());
}

LightField two_lamps() {
  LightField light{.geometry = {.lamps_m = {{6e-3, 1e-3, -3e-3}, {-3e-3, 6e-3, -3e-3}},
                                .shadow_softness = 0.2,
                                .environment_degree = 1,
                                .field_half_width_m = 2e-3},
                   .weights = {},
                   .blur_px = 0.7};
  light.weights.resize(light.geometry.num_features(), 3);
  for (Eigen::Index i = 0; i < light.weights.size(); ++i)
    light.weights.data()[i] = 30.0 * std::sin(1.0 + 3.0 * double(i));
  return light;
}

TEST_F(RenderStage, ALightFieldChangesThePhotographAsItIsCalibratedTo) {
  const ByteImage photograph(32, 24, 3, 130);
  write_png(scratch_ / "photograph.png", photograph);
  write_file(scratch_ / "sensor.yaml", calibrated_sensor(two_lamps()));
  write_file(
      scratch_ / "config.yaml",
      "subpixels: 1\nindirect_rays: 16\nnoise: {seed: 1}\nvariants: [{name: other, reference_image: other.png}]\n");
  write_png(scratch_ / "other.png", ByteImage(32, 24, 3, 100));
  ASSERT_EQ(run(), 0) << said_;
  ASSERT_EQ(run("again", "--threads 3"), 0) << said_;
  EXPECT_EQ(content_hash(scratch_ / "out"), content_hash(scratch_ / "again"));
  EXPECT_EQ(read_png(scratch_ / "out/frame_0000/tactile.png", 3).pixels, photograph.pixels);
  EXPECT_FALSE(fs::exists(scratch_ / "out/frame_0002/linear.exr"));
  // What calibrate and shade see: the same front, moved, one ray a pixel.
  const Sensor sensor = read_config<Sensor>(scratch_ / "sensor.yaml");
  const Membrane front = make_membrane(gel_, frame_positions(positions_, 2));
  const FloatImage change = code_change(two_lamps(), view_membrane(front.positions, front.triangles, sensor));
  const ByteImage expected = add_change(photograph, change),
                  seen = read_png(scratch_ / "out/frame_0002/tactile.png", 3);
  const ByteImage other = read_png(scratch_ / "out/frame_0002/other/tactile.png", 3);
  int changed = 0;
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    EXPECT_NEAR(seen.pixels[i], expected.pixels[i], 1) << i;
    EXPECT_NEAR(seen.pixels[i], other.pixels[i] + 30, 1) << i;
    changed += std::abs(seen.pixels[i] - 130) > 5;
  }
  EXPECT_GT(changed, 100);
}

TEST_F(RenderStage, WhatALightFieldCannotDoIsSaid) {
  write_png(scratch_ / "photograph.png", ByteImage(32, 24, 3, 130));
  write_file(scratch_ / "sensor.yaml", calibrated_sensor(two_lamps()));
  write_file(scratch_ / "config.yaml", "transfer: none\nnoise: {seed: 1}\n");
  EXPECT_EQ(run(), 1);
  EXPECT_THAT(said_, HasSubstr("slab: a light_field changes a photograph's codes: transfer must be encoded, "
                               "noise.every_frame false\n"));
  write_file(scratch_ / "config.yaml", "noise: {seed: 1}\nvariants: [{name: v, coating_albedo: [1, 1, 1]}]\n");
  EXPECT_EQ(run(), 1);
  EXPECT_THAT(said_, HasSubstr("variant v: a light_field has neither light groups nor a coating to change\n"));
  write_file(scratch_ / "sensor.yaml", std::string(kSensor) + to_yaml(two_lamps().to_value()));
  EXPECT_EQ(run(), 2);
  for (const char* fault :
       {"leds: does not go with a light_field, which says by itself how codes change", "coating: does not go with",
        "response: does not go with", "reference_image: missing: a light_field changes its codes"})
    EXPECT_THAT(said_, HasSubstr(fault));
  EXPECT_THAT(said_, testing::Not(HasSubstr("unknown")));
}

}  // namespace
}  // namespace tacipc
