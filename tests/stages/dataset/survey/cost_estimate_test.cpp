#include "stages/dataset/survey/cost_estimate.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/stages/dataset/survey/planned_dataset.h"

namespace tacipc {
namespace cost_estimate_test {

const CostModel kModel{.press_frame_s = 0.02,
                       .motion_frame_s = 0.04,
                       .vertices_exponent = 1.0,
                       .contacts_exponent = 0.5,
                       .averaged_volume_factor = 1.5};
const GelSize kGel{.vertices = 2000, .front_vertices = 1800, .pixels = 1e5, .poissons_ratio = 0.3};

void write_gel(const PlannedDataset& data, const char* nu) {
  write_file(
      data / "gels/toy-coarse/tetmesh.yaml",
      fmt::format(
          "stage: tetmesh\nconfig:\n  sensor:\n    material:\n      poissons_ratio: {}\n    camera:\n"
          "      width_px: 400\n      height_px: 250\nsummary:\n  vertices: 2000\n  front:\n    vertices: 1800\n",
          nu));
}

TEST(CostEstimate, ModelAsWritten) {
  // Two thousand vertices, three hundred of the front touching: 2 · √4 a frame.
  EXPECT_NEAR(modelled_seconds(kModel, kGel, {.press_frames = 5, .other_frames = 0}, RenderedFrames::last),
              4 * 5 * 0.02 + 0.1 + 1.0, 1e-12);
  EXPECT_NEAR(modelled_seconds(kModel, kGel, {.press_frames = 5, .other_frames = 10}, RenderedFrames::all),
              4 * (5 * 0.02 + 10 * 0.04) + 0.1 + 16 * 0.5, 1e-12);
  GelSize stiff = kGel;
  stiff.poissons_ratio = 0.4;
  EXPECT_NEAR(modelled_seconds(kModel, stiff, {.press_frames = 5, .other_frames = 0}, RenderedFrames::last),
              6 * 5 * 0.02 + 0.1 + 1.0, 1e-12);
  EXPECT_EQ(modelled_bytes(kGel, {.press_frames = 5, .other_frames = 0}, RenderedFrames::last),
            6 * (24 * 2000 + 49 * 1800 + 63000) + 8 * 1e5 * 2);
}

TEST(CostEstimate, RenderedFramesAreThoseThatItsConfigurationAsksFor) {
  const MotionLength motion{.press_frames = 5, .other_frames = 10, .kinds = {"press", "shear", "shear", "twist"}};
  const auto pixels = [&](RenderedFrames frames) {
    return (modelled_bytes(kGel, motion, frames) -
            modelled_bytes({.vertices = 2000, .front_vertices = 1800}, motion, frames)) /
           (8 * kGel.pixels);
  };
  EXPECT_EQ(pixels(RenderedFrames::last), 2);
  EXPECT_EQ(pixels(RenderedFrames::phases), 4);
  EXPECT_EQ(pixels(RenderedFrames::all), 16);
}

TEST(CostEstimate, AnUnknownWordForTheFramesIsRefused) {
  const PlannedDataset data(1);
  write_gel(data, "0.3");
  data.render_frames("every");
  EXPECT_NE(message_of<ConfigError>([&] { estimate_cost(data.path(), kModel); }).find("frames: 'every' is not one of"),
            std::string::npos);
}

TEST(CostEstimate, WithoutMadeSamplesItIsTheModel) {
  const PlannedDataset data(3);
  write_gel(data, "0.3");
  const CostEstimate cost = estimate_cost(data.path(), kModel);
  const double down = modelled_seconds(kModel, kGel, {.press_frames = 5, .other_frames = 0}, RenderedFrames::last);
  const double along = modelled_seconds(kModel, kGel, {.press_frames = 4, .other_frames = 6}, RenderedFrames::last);
  EXPECT_EQ(cost.samples, 3u);
  EXPECT_EQ(cost.made, 0u);
  EXPECT_NEAR(cost.seconds, 2 * down + along, 1e-9);
  EXPECT_EQ(cost.bytes, cost.bytes_left);
  EXPECT_EQ(to_text(cost, data.path()),
            fmt::format("set: 3 samples: {:.3g} core-hours ({:.3g} s a sample), {:.3g} GB on disk\n"
                        "  by the cost model alone, within a factor of three or so; PILOT=20 makes twenty samples "
                        "first and measures\n",
                        (2 * down + along) / 3600, (2 * down + along) / 3, cost.bytes / 1e9));
  data.render_frames("all");
  EXPECT_GT(estimate_cost(data.path(), kModel).seconds, cost.seconds + 1.0);
}

TEST(CostEstimate, MadeSamplesScaleTheModelOfTheOthers) {
  const PlannedDataset data(6);
  write_gel(data, "0.3");
  data.make(0, 9.0);   // ten seconds with render …
  data.make(1, 11.0);  // … and twelve
  const CostEstimate cost = estimate_cost(data.path(), kModel);
  const double down = modelled_seconds(kModel, kGel, {.press_frames = 5, .other_frames = 0}, RenderedFrames::last);
  const double along = modelled_seconds(kModel, kGel, {.press_frames = 4, .other_frames = 6}, RenderedFrames::last);
  EXPECT_EQ(cost.made, 2u);
  EXPECT_EQ(cost.unmeasured, 2u);
  EXPECT_NEAR(cost.seconds_spent, 22.0, 1e-12);
  EXPECT_NEAR(cost.seconds, 4 * 11.0 + 2 * along * 11.0 / down, 1e-9);
  EXPECT_GT(cost.bytes_left, 0.0);
  EXPECT_LT(cost.bytes_left, cost.bytes);
  EXPECT_NE(to_text(cost, data.path())
                .find("\n  measured on 2 made samples, 0.00611 core-hours so far; 2 samples of other motions or gels "
                      "by the cost model\n"),
            std::string::npos)
      << to_text(cost, data.path());
}

TEST(CostEstimate, AGelThatIsNotThereIsAFault) {
  const PlannedDataset data(1);
  EXPECT_EQ(message_of<DataError>([&] { estimate_cost(data.path(), kModel); }),
            (data / "gels/toy-coarse/tetmesh.yaml").string() + ": cannot be read: No such file or directory");
}

TEST(CostEstimate, APilotIsSpreadOverThePlan) {
  const PlannedDataset data(10);
  // 0.5, 0.118 …, 0.736 … of ten samples.
  EXPECT_EQ(pilot_samples(data.path(), 3),
            (std::vector<std::string>{"000/" + data.id(1), "000/" + data.id(5), "000/" + data.id(7)}));
  EXPECT_EQ(pilot_samples(data.path(), 1000).size(), 10u);
}

}  // namespace cost_estimate_test
}  // namespace tacipc
