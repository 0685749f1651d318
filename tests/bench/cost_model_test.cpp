// What the cost model finds in runs whose cost is known.
#include "bench/cost_model.h"

#include <gmock/gmock.h>

#include <cmath>

namespace tacipc::bench {
namespace cost_model_test {

/// Presses and drags of three sizes with both elements that cost what `model` says.
std::vector<Run> runs_of(const CostModel& model) {
  std::vector<Run> runs;
  for (const int vertices : {3000, 12000, 50000}) {
    for (const int contacts : {100, 700}) {
      for (const char* route : {"fast", "averaged"}) {
        for (const bool drag : {false, true}) {
          Run& run = runs.emplace_back();
          run.name.route = route;
          run.gel_vertices = vertices;
          run.frames = {{.press = true, .contacts = contacts / 2}, {.press = true, .contacts = contacts}};
          if (drag) run.frames.push_back({.press = false, .contacts = contacts});
          run.processor_s = model.predict(run);
        }
      }
    }
  }
  return runs;
}

TEST(CostModel, FindsTheModelThatRunsFollow) {
  const CostModel truth{
      .press_s = 0.02, .motion_s = 0.05, .averaged_factor = 1.7, .vertices_exponent = 0.8, .contacts_exponent = 0.3};
  const CostModel found = fit_cost_model(runs_of(truth));
  EXPECT_NEAR(found.press_s, truth.press_s, 1e-6);
  EXPECT_NEAR(found.motion_s, truth.motion_s, 1e-6);
  EXPECT_NEAR(found.averaged_factor, truth.averaged_factor, 1e-6);
  EXPECT_NEAR(found.vertices_exponent, truth.vertices_exponent, 1e-6);
  EXPECT_NEAR(found.contacts_exponent, truth.contacts_exponent, 1e-6);
  EXPECT_NEAR(found.largest_ratio, 1.0, 1e-6);
  EXPECT_THAT(to_yaml_text(found), ::testing::HasSubstr("averaged_volume_factor: 1.700"));
}

TEST(CostModel, PredictsByFramesVerticesAndContacts) {
  const CostModel model{
      .press_s = 1.0, .motion_s = 2.0, .averaged_factor = 3.0, .vertices_exponent = 1.0, .contacts_exponent = 2.0};
  bench::Run run;
  run.gel_vertices = 5000;
  run.frames = {{.press = true, .contacts = 100}, {.press = false, .contacts = 0}};
  EXPECT_NEAR(model.predict(run), 1.0 * 5 * 4 + 2.0 * 5, 1e-9);
  run.name.route = "averaged";
  EXPECT_NEAR(model.predict(run), 3.0 * 30, 1e-9);
}

TEST(CostModel, SaysHowFarOffItIs) {
  std::vector<bench::Run> runs =
      runs_of({.press_s = 0.02, .motion_s = 0.05, .vertices_exponent = 0.8, .contacts_exponent = 0.3});
  runs.front().processor_s *= 3.0;
  const double off = fit_cost_model(runs).largest_ratio;
  EXPECT_GT(off, 1.5);
  EXPECT_LT(off, 3.0);
}

}  // namespace cost_model_test
}  // namespace tacipc::bench
