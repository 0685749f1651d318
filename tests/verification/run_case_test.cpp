// Cases as users write them: what is read, and every fault at its place.
#include <gtest/gtest.h>

#include "common/base/files.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"
#include "verification/run_case.h"

namespace tacipc::verify {
namespace run_case_test {

const std::string kCase = R"(title: a pyramid of nothing
source: by hand
gel:
  box: {size_mm: [20, 20, 4], near_mm: 2, near_half_mm: 4, growth: 1.3, far_mm: 4, layer_mm: 1, layer_growth: 1.3}
material: {law: neo_hookean, density_kg_m3: 1010, youngs_modulus_pa: 1.0e+5, poissons_ratio: 0.3}
shape:
  sphere: {radius_mm: 5, edge_mm: 1, fine_radius_mm: 3}
press:
  time_step_s: 1
  barrier: {relative_d_hat: 1.0e-3, stiffness: 1.0e+10}
  newton: {}
motion: {kind: press, depth_mm: 0.5, steps: 1}
expect:
)";

CaseSpec read(const std::string& text) { return config_from_text<CaseSpec>(text, "case.yaml"); }

std::vector<std::string> faults_of_case(const std::string& text) { return faults_in<CaseSpec>(text, "case.yaml"); }

TEST(Case, ReadsAllOfARow) {
  const CaseSpec spec = read(kCase + "  - {quantity: press_force_n, value: 0.2, within_percent: 3, depth_mm: 0.5}\n");
  EXPECT_EQ(spec.title, "a pyramid of nothing");
  ASSERT_EQ(spec.expect.size(), 1u);
  EXPECT_EQ(spec.expect[0].label, "press_force_n");
  EXPECT_EQ(*spec.expect[0].value, 0.2);
  EXPECT_NEAR(*spec.expect[0].frame.depth_m, 0.5e-3, 1e-18);
  EXPECT_NEAR(spec.object.radius_m, 5e-3, 1e-18);
  ASSERT_EQ(spec.sample.motion.size(), 1u);
  EXPECT_NEAR(spec.sample.motion[0].depth_m, 0.5e-3, 1e-18);
}

TEST(Case, EveryFaultIsReportedAtItsPlace) {
  EXPECT_EQ(faults_of_case(kCase + "  - {quantity: pres_force_n, value: 0.2, within_percent: 3}\n").size(), 1u);
  EXPECT_EQ(faults_of_case(kCase + "  - {quantity: press_force_n, value: 0.2}\n"),
            std::vector<std::string>{
                "case.yaml:14:16: expect[0].quantity: give one of within_percent, within, at_most, at_least"});
  EXPECT_EQ(faults_of_case(kCase + "  - {quantity: press_force_n, within: 2}\n"),
            std::vector<std::string>{"case.yaml:14:16: expect[0].quantity: give the value or formula it must be near"});
  EXPECT_EQ(faults_of_case(kCase + "  - {quantity: press_force_n, value: 1, formula: hertz, within: 2}\n"),
            std::vector<std::string>{"case.yaml:14:50: expect[0].formula: give value or formula, not both"});
  EXPECT_EQ(faults_of_case(kCase + "  - {quantity: press_force_n, at_most: 1, frame: 1, depth_mm: 1}\n"),
            std::vector<std::string>{"case.yaml:14:50: expect[0].frame: give at most one of frame, phase, depth_mm"});
  EXPECT_EQ(faults_of_case(kCase.substr(0, kCase.find("expect:"))),
            std::vector<std::string>{"case.yaml:1:1: expect: nothing is expected: give expect or reference"});
  std::string two = kCase + "  - {quantity: press_force_n, at_most: 1}\n";
  two.replace(two.find("  sphere"), 0, "  plate: {half_width_mm: 3}\n");
  EXPECT_EQ(faults_of_case(two),
            std::vector<std::string>{
                "case.yaml:8:11: shape.sphere: give one of sphere, punch, cone, cylinder, plate, block, wedge, file"});
}

TEST(Case, RunsAndJudgesEachRow) {
  const CaseSpec spec = read(kCase + R"(  - {quantity: press_force_n, at_least: 1.0e-3}
  - {quantity: press_force_n, value: 1.0e+3, within_percent: 3}
  - {label: the formula, quantity: press_force_n, formula: bonded_layer, within_percent: 200}
  - {quantity: indentation_m, at_most: 0.8e-3}
)");
  const CaseResult result = run_case(spec, "", [](int, int, int, double) {});
  ASSERT_TRUE(result.simulation);
  ASSERT_EQ(result.judgement.rows.size(), 4u);
  EXPECT_TRUE(result.judgement.rows[0].pass);
  EXPECT_FALSE(result.judgement.rows[1].pass);
  EXPECT_TRUE(result.judgement.rows[2].pass)
      << result.judgement.rows[2].measured << " " << *result.judgement.rows[2].expected;
  EXPECT_TRUE(result.judgement.rows[3].pass) << result.judgement.rows[3].measured;
  EXPECT_FALSE(result.pass());
  EXPECT_NE(to_yaml(to_value(result)).find("state: missed"), std::string::npos);
  EXPECT_NE(to_svg(result).find("a pyramid of nothing"), std::string::npos);
  EXPECT_EQ(to_csv(result).substr(0, 32), "frame,depth_mm,sideways_mm,turne");
}

TEST(Case, FittedModulusScalesForces) {
  const CaseSpec spec = read(kCase + R"(  - {quantity: press_force_n, value: 3, within_percent: 1.0e-6}
fit: {press_force_n: 3}
)");
  const CaseResult result = run_case(spec, "", [](int, int, int, double) {});
  EXPECT_TRUE(result.pass());
  const double measured = -result.simulation->frames.back().force_n.z();
  EXPECT_NEAR(*result.judgement.fitted_modulus_pa, 1e5 * 3.0 / measured, 1.0);
}

TEST(Case, WhatFailsSaysWhy) {
  CaseSpec spec = read(kCase + "  - {quantity: press_force_n, at_least: 0}\n");
  spec.press.newton.max_iterations = 1;
  const CaseResult result = run_case(spec, "", [](int, int, int, double) {});
  ASSERT_TRUE(result.failed);
  EXPECT_FALSE(result.pass());
  EXPECT_NE(to_yaml(to_value(result)).find("state: failed"), std::string::npos);
}

TEST(Case, SharedDataThatAreNotThereSkip) {
  std::string text = kCase + "  - {quantity: press_force_n, at_least: 0}\n";
  const auto from = text.find("  sphere"), to = text.find("press:");
  text.replace(from, to - from, "  file: {path: \"shared:data/nothing.stl\", unit: mm}\n");
  const CaseResult skipped = run_case(read(text), "/nonexistent", [](int, int, int, double) {});
  EXPECT_EQ(*skipped.skipped, "needs data/nothing.stl; there is no folder /nonexistent (set TACIPC_SHARED)");
  const ScratchFolder there;
  const std::filesystem::path root = (there / "x").parent_path();
  try {
    run_case(read(text), root, [](int, int, int, double) {});
    FAIL() << "a missing file passed for a skip";
  } catch (const DataError& error) {
    EXPECT_EQ(error.what(), "data/nothing.stl is missing from the shared data " + root.string());
  }
}

}  // namespace run_case_test
}  // namespace tacipc::verify
