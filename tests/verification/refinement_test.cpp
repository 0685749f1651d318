// Refinement: what is refined, and the orders seen of sequences whose order is known.
#include "verification/refinement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc::verify {
namespace refinement_test {

const std::string kScene = R"(title: a sphere dragged
gel:
  box: {size_mm: [6, 6, 2], near_mm: 0.8, near_half_mm: 1.6, growth: 1.21, far_mm: 1.6, layer_mm: 0.5, layer_growth: 1.44}
material: {law: neo_hookean, density_kg_m3: 1010, youngs_modulus_pa: 1.0e+5, poissons_ratio: 0.3}
shape:
  sphere: {radius_mm: 4, edge_mm: 0.4, fine_radius_mm: 1.5}
press:
  time_step_s: 0.02
  barrier: {relative_d_hat: 2.0e-3, relative_stiffness: 0.1}
  friction: {coefficient: 0.5, relative_speed_threshold: 4.0e-3, lag: iterated, relative_lag_tolerance: 1.0e-4}
  newton: {relative_velocity_tolerance: 1.0e-4, relative_force_tolerance: 1.0e-5, force_tolerance_n: 1.0e-8}
motion:
  - {kind: press, depth_mm: 0.2, steps: 2}
  - {kind: shear, direction_deg: 0, distance_mm: 0.1, steps: 2}
front: {half_mm: 1.0, pitch_mm: 0.25}
refine:
  - {parameter: time_step, coarsest: 2, factor: 2, levels: 3}
  - {parameter: d_hat, coarsest: 1, factor: 2, levels: 3}
)";

RefinementSpec read(const std::string& text) { return config_from_text<RefinementSpec>(text, "scene.yaml"); }

TEST(Refinement, ChangesOneNumberOnly) {
  const CaseSpec scene = read(kScene).scene;
  const CaseSpec mesh = refined(scene, "mesh", 0.5);
  const auto& box = std::get<BoxGel>(mesh.gel.shape);
  EXPECT_NEAR(box.near_m, 0.4e-3, 1e-18);
  EXPECT_NEAR(box.layer_m, 0.25e-3, 1e-18);
  EXPECT_NEAR(box.growth, 1.1, 1e-12);
  EXPECT_NEAR(box.layer_growth, 1.2, 1e-12);
  EXPECT_EQ(box.near_half_m, 1.6e-3);
  const CaseSpec step = refined(scene, "time_step", 0.5);
  EXPECT_EQ(step.press.time_step_s, 0.01);
  EXPECT_EQ(step.sample.motion[1].steps, 4);
  EXPECT_EQ(step.sample.motion[1].shift_m, scene.sample.motion[1].shift_m);
  EXPECT_EQ(refined(scene, "d_hat", 0.5).press.relative_d_hat, 1e-3);
  EXPECT_EQ(refined(scene, "speed_threshold", 0.5).press.friction->relative_speed_threshold, 2e-3);
}

TEST(Refinement, RefusesWhatCannotBeRefined) {
  RefinementSpec spec = read(kScene);
  EXPECT_EQ(message_of<UsageError>([&] { refined(spec.scene, "time_step", 0.75); }),
            "refine: 2 steps divided by 0.75 is not a whole number");
  EXPECT_EQ(message_of<UsageError>([&] { spec.study("mesh"); }),
            "--study: 'mesh' is not refined (there are: time_step, d_hat)");
  spec.scene.press.friction.reset();
  EXPECT_EQ(message_of<UsageError>([&] { refined(spec.scene, "speed_threshold", 0.5); }),
            "refine: a scene without friction has no speed_threshold");
  std::string twice = kScene + "  - {parameter: d_hat, coarsest: 1, factor: 2, levels: 3}\n";
  EXPECT_EQ(faults_of([&] { read(twice); }),
            std::vector<std::string>{"scene.yaml:19:17: refine[2].parameter: is refined twice"});
}

RefinementLevel level(double error) {
  RefinementLevel out;
  out.gel_vertices = 10;
  out.press_force_n = 2.0 + error;
  out.tangential_force_n = 1.0 - error * error;
  out.markers_m = Positions::Constant(4, 3, 1e-3 * (1.0 + error));
  out.front_m = Positions::Constant(5, 3, 1e-3 * (1.0 + error * error));
  return out;
}

TEST(Refinement, FindsTheOrderOfASequence) {
  const std::vector<RefinementCurve> curves = compare_levels({level(0.4), level(0.2), level(0.1), level(0.05)}, 2.0);
  ASSERT_EQ(curves.size(), 5u);
  EXPECT_EQ(curves[0].quantity, "press force");
  EXPECT_NEAR(curves[0].against_finest[0], 0.35, 1e-12);
  EXPECT_NEAR(curves[0].against_next[0], 0.2, 1e-12);
  ASSERT_EQ(curves[0].orders.size(), 2u);
  for (const std::size_t first_order : {0u, 2u})
    for (const double order : curves[first_order].orders) EXPECT_NEAR(order, 1.0, 1e-9);
  for (const std::size_t second_order : {1u, 3u, 4u})
    for (const double order : curves[second_order].orders) EXPECT_NEAR(order, 2.0, 1e-9);
  // All three coordinates of all points differ by 0.2 mm.
  EXPECT_NEAR(curves[2].against_next[0], std::sqrt(3.0) * 0.2e-3, 1e-15);
}

TEST(Refinement, LevelsSurviveAnInterruption) {
  const RefinementLevel before = level(0.3);
  const auto after = RefinementLevel::unpack(before.pack());
  ASSERT_TRUE(after);
  EXPECT_EQ(after->press_force_n, before.press_force_n);
  EXPECT_EQ(after->markers_m, before.markers_m);
  EXPECT_EQ(after->front_m, before.front_m);
  const std::string bytes = before.pack();
  EXPECT_FALSE(RefinementLevel::unpack(bytes.substr(0, bytes.size() - 8)));
  EXPECT_FALSE(RefinementLevel::unpack(""));
}

TEST(Refinement, ResultsReadBackAndSayWhatDoesNotSettle) {
  const ScratchFolder folder;
  const RefinementSpec spec = read(kScene);
  const RefinementStudy& study = spec.study("d_hat");
  std::vector<CaseSpec> scenes;
  for (int k = 0; k < study.levels; ++k) scenes.push_back(refined(spec.scene, study.parameter, study.scale(k)));
  RefinementResult result = describe(spec, study, scenes);
  EXPECT_NEAR(result.parameter_values[0], 2e-3 * std::sqrt(36.0 + 36.0 + 4.0) * 1e3, 1e-9);
  result.gel_vertices = {10, 10, 10};
  result.curves = compare_levels({level(0.4), level(0.2), level(-0.2)}, 2.0);
  folder.file("r/result.yaml", to_yaml(to_value(result)));
  folder.file("r/refinement.yaml", "stage: refinement\n");
  const RefinementResult again = read_refinement(folder / "r");
  EXPECT_EQ(again.parameter_values, result.parameter_values);
  EXPECT_EQ(again.curves[2].against_next, result.curves[2].against_next);
  EXPECT_EQ(not_converging(again), (std::vector<std::string>{"press force", "markers since the press, rms"}));
  const std::string tables = refinement_tables({again}, "plots");
  EXPECT_NE(tables.find("| 17.44 | 10 | 2.40000 N | 33.3 % | 0.84000 N | 12.5 % |"), std::string::npos) << tables;
  EXPECT_NE(tables.find("![reach of the barrier d̂](plots/refinement_d_hat.svg)"), std::string::npos);
  EXPECT_NE(tables.find("the last level changes more than the second: press force; markers"), std::string::npos);
  EXPECT_FALSE(holds({again}));
  EXPECT_EQ(
      found({again}),
      "the last refinement changes the forces by 22.22 % (reach of the barrier d̂); no convergence in the reach of "
      "the barrier d̂: press force, markers since the press, rms");
  RefinementResult converging = again;
  converging.curves = compare_levels({level(0.4), level(0.2), level(0.1)}, 2.0);
  EXPECT_TRUE(holds({converging}));
}

TEST(Refinement, AStudyThatFailedIsShownAndDoesNotHold) {
  const ScratchFolder folder;
  // Left by an earlier run: without its record it counts for nothing.
  folder.file("mesh/result.yaml", "study: mesh\n");
  folder.file("mesh/refinement.failed.yaml", "stage: refinement\nmessage: out of memory\n");
  const RefinementResult failed = read_refinement(folder / "mesh");
  EXPECT_FALSE(holds({failed}));
  EXPECT_EQ(found({failed}), "mesh failed: out of memory");
  EXPECT_NE(refinement_tables({failed}, ".").find("## mesh\n\n**failed**: out of memory\n"), std::string::npos);
}

TEST(Refinement, ASmallSceneSettlesInTime) {
  RefinementSpec spec = read(kScene);
  std::vector<RefinementLevel> levels;
  const RefinementStudy& study = spec.study("time_step");
  for (int k = 0; k < study.levels; ++k)
    levels.push_back(run_level(spec, refined(spec.scene, "time_step", study.scale(k)), ""));
  const auto curves = compare_levels(levels, study.factor);
  EXPECT_GT(levels.back().tangential_force_n, 1e-3);
  EXPECT_EQ(levels.back().front_m.rows(), 81);
  EXPECT_EQ(levels.back().markers_m.rows(), 49);
  for (const std::size_t c : {1u, 2u})
    EXPECT_LT(curves[c].against_next[1], curves[c].against_next[0]) << curves[c].quantity;
}

}  // namespace refinement_test
}  // namespace tacipc::verify
