// The stress campaign: what it draws is what its ranges say, and a few of its cases.
#include <gtest/gtest.h>

#include <map>

#include "common/base/files.h"
#include "stages/gel/press/contact/intersection_check.h"
#include "tests/closed_surface.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"
#include "verification/stress_summary.h"

namespace tacipc::verify {
namespace stress_test {

const char* const kRanges = TACIPC_SOURCE_DIR "/configs/studies/stress/stress.yaml";

const StressConfig& ranges() {
  static const StressConfig config = read_config<StressConfig>(kRanges);
  return config;
}

void expect_closed_and_outward(const TriangleMesh& mesh) {
  expect_closed(mesh.triangles);
  EXPECT_GT(signed_volume(mesh), 0.0);
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    const Vector3 a = mesh.positions.row(mesh.triangles(f, 0)), b = mesh.positions.row(mesh.triangles(f, 1)),
                  c = mesh.positions.row(mesh.triangles(f, 2));
    EXPECT_GT((b - a).cross(c - a).norm(), 0.0);
  }
}

TEST(Stress, ObjectsAreClosedAndAsLargeAsDrawn) {
  std::map<std::string, int> kinds;
  for (std::uint64_t index = 0; index < 100; ++index) {
    Draws draws(5, index);
    const StressObject object = draw_object(ranges().object, 0.8e-3, draws);
    SCOPED_TRACE(object.kind + " " + std::to_string(index));
    ++kinds[object.kind];
    expect_closed_and_outward(object.mesh);
    EXPECT_EQ(object.mesh.positions.col(2).minCoeff(), 0.0);
    EXPECT_GE(object.size_m, 1e-3);
    EXPECT_LE(object.size_m, 6e-3);
    const Vector3 extent = object.mesh.positions.colwise().maxCoeff() - object.mesh.positions.colwise().minCoeff();
    EXPECT_LE(extent.maxCoeff(), std::sqrt(3.0) * 1.0001 * object.size_m);
    EXPECT_GE(extent.norm(), 0.5 * object.size_m);
    EXPECT_LE(object.mesh.num_vertices(), 1.5 * ranges().object.max_vertices);
  }
  EXPECT_EQ(kinds.size(), stress_kinds().size());
}

TEST(Stress, GelsAreSoundAndAsLargeAsDrawn) {
  for (std::uint64_t index = 0; index < 12; ++index) {
    Draws draws(6, index);
    const StressGel gel = draw_gel(ranges().gel, ranges().object.exact_share, draws);
    SCOPED_TRACE(index);
    EXPECT_EQ(count_inverted_tets(gel.mesh.positions, gel.mesh.tets), 0);
    EXPECT_GE(gel.shape.thickness_m, 2e-3);
    EXPECT_LE(gel.shape.thickness_m, 4e-3);
    EXPECT_GE(std::min(gel.shape.width_m, gel.shape.height_m), 4.999 * gel.shape.thickness_m);
    EXPECT_GE(gel.mesh.num_vertices(), 300);
    EXPECT_LE(gel.mesh.num_vertices(), 2500);
    for (const int v : gel.mesh.vertices(BoundaryTag::front)) EXPECT_NEAR(gel.mesh.positions(v, 2), 0.0, 1e-12);
  }
}

TEST(Stress, SplittingKeepsSurfaceAndVolume) {
  Draws draws(1, 0);
  const TriangleMesh sphere = octahedral_sphere(2);
  const TriangleMesh fine = split_triangles(sphere, 0.4, 100000);
  expect_closed_and_outward(fine);
  EXPECT_EQ(sphere.num_vertices(), 18);
  EXPECT_EQ(fine.num_triangles(), 16 * sphere.num_triangles());
  EXPECT_EQ(split_triangles(sphere, 0.4, 71).num_triangles(), sphere.num_triangles());
  expect_closed_and_outward(torus(0.3, 8, 5));
}

TEST(Stress, ContactRadiusIsCutExactly) {
  Draws draws(1, 0);
  StressConfig::Object cones = ranges().object;
  cones.kinds = {"cone"};
  cones.exact_share = 1.0;  // upright
  const StressObject cone = draw_object(cones, 1e-3, draws);
  const double depth = 0.1 * cone.size_m;
  EXPECT_NEAR(contact_radius_m(cone.mesh, depth), depth * std::tan(cone.half_angle_rad), 0.08 * depth);
}

TEST(Stress, SameSeedAndIndexGiveTheSameCase) {
  const StressCase a = draw_case(ranges(), 3, 17), b = draw_case(ranges(), 3, 17), c = draw_case(ranges(), 3, 18);
  EXPECT_EQ(to_yaml(a.description()), to_yaml(b.description()));
  EXPECT_EQ(a.gel.mesh.positions, b.gel.mesh.positions);
  EXPECT_EQ(a.object.mesh.positions, b.object.mesh.positions);
  EXPECT_NE(to_yaml(a.description()), to_yaml(c.description()));
}

TEST(Stress, DepthKeepsToWhatTheContactRadiusAllows) {
  for (std::uint64_t index = 0; index < 15; ++index) {
    const StressCase stress = draw_case(ranges(), 2, index);
    SCOPED_TRACE(to_yaml(stress.description()));
    const double thickness_m = stress.gel.shape.thickness_m;
    EXPECT_LE(stress.depth_m, (stress.contact_radius_m < thickness_m ? 0.75 : 0.4) * thickness_m + 1e-12);
    ASSERT_GE(stress.sample.motion.size(), 1u);
    EXPECT_LE(stress.sample.motion.size(), 3u);
    EXPECT_EQ(stress.sample.motion[0].kind, PhaseKind::press);
  }
}

TEST(Stress, RangesAreCheckedAtTheirPlace) {
  std::string text = read_file(kRanges);
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("size_mm: [1, 6]", "size_mm: [6, 1]");
  replace("  newton: {}", "  newton: {}\n  friction: {coefficient: 1}");
  replace("  place: 0.5 ", "  place: 0.5\n  knife: true ");
  const auto faults = faults_in<StressConfig>(text, "stress.yaml");
  ASSERT_EQ(faults.size(), 3u);
  EXPECT_EQ(faults[0], "stress.yaml:15:12: object.size_mm: the first number must not exceed the second");
  EXPECT_NE(faults[1].find("object.knife: unknown key"), std::string::npos);
  EXPECT_NE(faults[2].find("press.friction: is drawn for each case, from the section friction"), std::string::npos);
}

/// Cases of every motion; converging is part of the claim.
TEST(Stress, AFewCasesConverge) {
  for (const std::uint64_t index : {0, 5, 7, 9}) {
    const StressCase stress = draw_case(ranges(), 1, index);
    SCOPED_TRACE(to_yaml(stress.description()));
    const StressResult result = run_stress_case(stress, [](int, int, int, double) {});
    EXPECT_EQ(result.outcome, StressOutcome::converged) << result.reason;
    EXPECT_EQ(result.frames, result.frames_asked);
    ASSERT_TRUE(result.totals);
    EXPECT_GT(result.totals->min_distance_m, 0.0);
    EXPECT_GT(result.totals->min_volume_ratio, 0.0);
    EXPECT_EQ(result.totals->planned_steps, result.frames);
  }
}

TEST(Stress, WhatTheSolverGivesUpIsAResult) {
  StressCase stress = draw_case(ranges(), 1, 7);
  stress.press.newton.max_iterations = 1;
  stress.press.max_halvings = 0;
  const StressResult result = run_stress_case(stress, [](int, int, int, double) {});
  EXPECT_EQ(result.outcome, StressOutcome::not_converged);
  EXPECT_NE(result.reason.find("Newton did not converge within 1 iterations"), std::string::npos) << result.reason;
  EXPECT_LT(result.frames, result.frames_asked);
}

TEST(StressSummary, CountsAndJudges) {
  std::vector<StressLine> lines(200);
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i].name = "case_" + std::to_string(i);
  EXPECT_TRUE(summarize(lines).holds());
  EXPECT_NE(to_markdown(lines, "9").find("SEED=9 N=200"), std::string::npos);
  lines[3].result.outcome = StressOutcome::not_converged;
  lines[3].result.reason = "the line search stopped";
  EXPECT_TRUE(summarize(lines).holds());
  EXPECT_NE(to_markdown(lines, "9").find("| case_3 |  |  | 0 of 0 | not_converged | the line search stopped |"),
            std::string::npos);
  lines[4].result.outcome = StressOutcome::not_converged;
  EXPECT_FALSE(summarize(lines).holds()) << "1 % is not less than 1 %";
  lines[3].result.outcome = lines[4].result.outcome = StressOutcome::converged;
  for (const StressOutcome never : {StressOutcome::intersected, StressOutcome::inverted}) {
    lines[5].result.outcome = never;
    EXPECT_FALSE(summarize(lines).holds());
  }
  lines[5].result.outcome = StressOutcome::converged;
  lines[6].crashed = true;
  EXPECT_FALSE(summarize(lines).holds());
  EXPECT_FALSE(summarize({}).holds());
  EXPECT_EQ(found(summarize(lines), "9"),
            "199 of 200 cases of seed 9 converged, 0 did not, 0 intersected, 0 inverted, 1 crashed");
}

TEST(StressSummary, CasesWithoutFramesAddNoNumbers) {
  std::vector<StressLine> lines(3);
  lines[0].result.frames = 4;
  lines[0].result.totals = StressTotals{.time_steps = 11, .planned_steps = 8, .min_distance_m = 3e-6};
  lines[1].result.frames = 9;
  lines[1].result.outcome = StressOutcome::not_converged;
  lines[2].crashed = true;
  const std::string page = to_markdown(lines, "1", "grasp");
  EXPECT_NE(
      page.find("| total of 1 cases | |\n|---|---|\n| frames | 4 |\n| time steps | 11 |\n| of these by halving | 3 |"),
      std::string::npos)
      << page;
  EXPECT_NE(page.find("| smallest distance | 3 µm |"), std::string::npos) << page;
  EXPECT_NE(page.find("Not in these totals: 1 crashed, 1 ended early"), std::string::npos) << page;
}

TEST(StressSummary, ReadsRecordsAndMissesThem) {
  const ScratchFolder scratch;
  const StressCase stress = draw_case(ranges(), 1, 7);
  StressResult result;
  result.outcome = StressOutcome::inverted;
  result.reason = "frame 2: 1 tetrahedra are inverted";
  result.frames = 1;
  result.frames_asked = 9;
  result.totals = StressTotals{.time_steps = 3, .planned_steps = 2, .min_distance_m = 2e-6};
  write_file(
      scratch / "case_0007/stress_case.yaml",
      to_yaml(Value::Map{{"stage", "stress_case"}, {"case", stress.description()}, {"summary", result.lines()}}));
  const StressLine line = read_stress_line(scratch / "case_0007");
  EXPECT_FALSE(line.crashed);
  EXPECT_EQ(line.object, stress.object.kind);
  EXPECT_EQ(line.result.outcome, StressOutcome::inverted);
  EXPECT_EQ(line.result.reason, "frame 2: 1 tetrahedra are inverted");
  ASSERT_TRUE(line.result.totals);
  EXPECT_EQ(line.result.totals->time_steps, 3);
  EXPECT_EQ(line.result.totals->planned_steps, 2);
  EXPECT_EQ(line.result.totals->min_distance_m, 2e-6);
  write_file(scratch / "case_0008/stress_case.failed.yaml", "message: out of memory\n");
  EXPECT_TRUE(read_stress_line(scratch / "case_0008").crashed);
  EXPECT_EQ(read_stress_line(scratch / "case_0008").result.reason, "out of memory");
  EXPECT_EQ(read_stress_line(scratch / "case_0009").result.reason, "left no record");
}

}  // namespace stress_test
}  // namespace tacipc::verify
