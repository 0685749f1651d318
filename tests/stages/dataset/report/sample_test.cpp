#include "stages/dataset/report/sample.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/base/error.h"
#include "tests/scratch_folder.h"
#include "tests/stages/dataset/report/sheared_folder.h"

namespace tacipc {
namespace sample_test {

namespace fs = std::filesystem;

class SampleTest : public ::testing::Test {
 protected:
  void press(const std::string& from, const std::string& to) {
    write_file(folder_ / "press/press.yaml", replaced(kPressRecord, from, to));
  }
  std::string failure() const { return read_sample(folder_).failure.value_or("passed"); }

  ScratchFolder scratch_;
  fs::path folder_ = write_sample(scratch_ / "");
};

TEST_F(SampleTest, GathersTheRecordsOfAllStages) {
  const SampleReport sample = read_sample(folder_);
  EXPECT_EQ(sample.failure, std::nullopt);
  EXPECT_EQ(sample.name, "star-007");
  EXPECT_EQ(sample.object, "star");
  EXPECT_EQ(sample.press_force_n, 1.25);
  EXPECT_EQ(sample.newton_iterations, 25);
  EXPECT_EQ(sample.min_distance_m, 3.5e-5);
  EXPECT_EQ(sample.min_volume_ratio, 0.75);
  EXPECT_EQ(sample.gel_vertices, 23512);
  EXPECT_DOUBLE_EQ(sample.depth_m.value(), 0.5e-3);
  EXPECT_DOUBLE_EQ(sample.max_indentation_m.value(), 0.534e-3);
  EXPECT_EQ(sample.synthetic_reference, true);
  EXPECT_THAT(sample.warnings, ::testing::ElementsAre("Synthetic reference image: the sensor file names no photograph "
                                                      "of the real sensor without contact"));
  ASSERT_TRUE(sample.images);
  EXPECT_EQ(sample.images->tactile, folder_ / "render/frame_0002/tactile.png");
  std::vector<std::string> linked;
  for (const auto& [label, path] : sample.records) linked.push_back(label);
  for (const auto& [label, path] : sample.data) linked.push_back(label);
  EXPECT_THAT(linked, ::testing::ElementsAre("press.yaml", "press.log", "render.yaml", "tetmesh.yaml", "decimate.yaml",
                                             "positions.npy", "object_pose.npy", "depth.exr"));
}

TEST_F(SampleTest, DepthsOfTheFramesFollowFromThePoses) {
  const SampleReport sample = read_sample(folder_);
  ASSERT_EQ(sample.frames.size(), 3u);
  EXPECT_NEAR(sample.frames[0].depth_m.value(), 0.0, 1e-15);
  EXPECT_NEAR(sample.frames[1].depth_m.value(), 0.25e-3, 1e-15);
  EXPECT_NEAR(sample.frames[2].depth_m.value(), 0.5e-3, 1e-15);
  EXPECT_EQ(sample.frames[1].press_force_n, 0.5);
  EXPECT_EQ(sample.frames[1].newton_iterations, 11);
  EXPECT_EQ(sample.frames[2].min_gap_m, 3.5e-5);
  EXPECT_EQ(sample.frames[1].min_volume_ratio, 0.875);
}

TEST_F(SampleTest, DepthIsThatOfTheLowestPointHoweverTheObjectTurns) {
  // Half a turn about x: the base of the tetrahedron, 2 mm above its origin, is now lowest.
  std::vector<double> poses;
  for (const double z : {2.5e-3, 2.0e-3, 1.25e-3})
    poses.insert(poses.end(), {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, z, 0, 0, 0, 1});
  write_npy(folder_ / "press/object_pose.npy", {3, 4, 4}, poses.data());
  const SampleReport sample = read_sample(folder_);
  EXPECT_NEAR(sample.frames[0].depth_m.value(), -0.5e-3, 1e-15);
  EXPECT_NEAR(sample.frames[1].depth_m.value(), 0.0, 1e-15);
  EXPECT_NEAR(sample.frames[2].depth_m.value(), 0.75e-3, 1e-15);
  EXPECT_NEAR(sample.depth_m.value(), 0.75e-3, 1e-15);
}

TEST_F(SampleTest, WithoutTheObjectThatWasPressedThereAreNoDepthsPerFrame) {
  const fs::path object = scratch_ / "out/objects/star/object.ply";
  write_file(object, "another one");
  SampleReport sample = read_sample(folder_);
  EXPECT_EQ(sample.failure, std::nullopt);
  EXPECT_EQ(sample.frames[1].depth_m, std::nullopt);
  EXPECT_DOUBLE_EQ(sample.depth_m.value(), 0.5e-3);  // what was asked for
  EXPECT_THAT(sample.warnings,
              ::testing::Contains("press: the object's mesh has changed since the press, so the depths "
                                  "per frame are not known"));
  fs::remove(object);
  sample = read_sample(folder_);
  EXPECT_THAT(sample.warnings,
              ::testing::Contains("press: the object's mesh is not there, so the depths per frame are not known"));
}

TEST_F(SampleTest, AMotionInPhasesHasItsDepthAtTheEndOfThePress) {
  const SampleReport sample = read_sample(write_sheared_sample(scratch_ / ""));
  EXPECT_EQ(sample.failure, std::nullopt);
  EXPECT_EQ(sample.motion, "press 0.5 mm, shear 0.4 mm towards 90°");
  EXPECT_NEAR(sample.depth_m.value(), 0.5e-3, 1e-15);
  EXPECT_NEAR(sample.frames[0].depth_m.value(), -0.1e-3, 1e-15);
  EXPECT_EQ(sample.tangential_force_n, 0.84);
  EXPECT_EQ(sample.friction_coefficient, 0.7);
  EXPECT_EQ(sample.first_slip_time_s, 0.025);
  EXPECT_EQ(sample.gross_slip_time_s, 0.04);
  EXPECT_EQ(sample.element, "averaged_volume");
  EXPECT_EQ(sample.press_end_frame, 2);
  EXPECT_EQ(sample.phases.size(), 4u);
  EXPECT_EQ(sample.marker_pictures.size(), 3u);
  EXPECT_EQ(sample.checks.size(), 7u);
  ASSERT_TRUE(sample.images);
  EXPECT_EQ(sample.images->tactile.parent_path().filename(), "frame_0004");
  ASSERT_EQ(sample.phase_images.size(), 1u);
  EXPECT_EQ(sample.phase_images[0].frame, 2);
  EXPECT_EQ(sample.phase_images[0].phase, "press");
}

TEST_F(SampleTest, SlipThatNeverComesIsNoTime) {
  const fs::path drag = write_sheared_sample(scratch_ / "");
  write_file(drag / "press/press.yaml", replaced(sheared_record(), "  gross_slip_time_s: 0.04\n", ""));
  EXPECT_EQ(read_sample(drag).gross_slip_time_s, std::nullopt);
}

TEST_F(SampleTest, ALimitThatIsMissedFailsTheSample) {
  const fs::path drag = write_sheared_sample(scratch_ / "");
  const auto with = [&](const std::string& from, const std::string& to) {
    write_file(drag / "press/press.yaml", replaced(sheared_record(), from, to));
    return read_sample(drag).failure.value_or("passed");
  };
  EXPECT_EQ(with("balance_relative: 8.0e-06", "balance_relative: 2.0e-03"),
            "press: force imbalance is 0.200 % of the contact force in frame 3, the limit is 0.100 %, or 10.0 µN");
  EXPECT_EQ(with("max_pose_error_m: 0", "max_pose_error_m: 2.0e-06"),
            "press: distance from the asked pose is 2000 nm, the limit is 1.00 nm");
  EXPECT_EQ(with("min_gap_m: 3.6e-05", "min_gap_m: 0"),
            "press: smallest distance is 0 µm in frame 4, the limit is above 0");
  EXPECT_EQ(with("balance_relative: 0.001", "balance_relative: 1.0e-04"),
            "press: force imbalance is 0.0200 % of the contact force in frame 2, the limit is 0.0100 %, or 1.00 µN");
  EXPECT_EQ(with("verdict: pass", "verdict: fail"), "press: its verdict is fail");
  write_npy(drag / "press/wrench.npy", {1, 6}, std::vector<double>(6, 0.0).data());
  EXPECT_EQ(with("verdict: pass", "verdict: pass"), "press/wrench.npy: has the shape (1, 6), expected (5, 6)");
  write_npy(drag / "press/wrench.npy", {5, 6}, std::vector<double>(30, std::nan("")).data());
  EXPECT_EQ(with("verdict: pass", "verdict: pass"), "press/wrench.npy: the value at [0, 0] is not finite");
  EXPECT_EQ(with("press_end_frame: 2", "press_end_frame: 5"),
            "press/press.yaml: summary.press_end_frame: 5 is not one of the 5 frames");
}

TEST_F(SampleTest, TheFileOfAFailureTellsMoreThanTheLog) {
  fs::remove(folder_ / "press/press.yaml");
  write_file(folder_ / "press/press.log", "2024-06-07 12:34:56.789 error: press: error: no convergence\n");
  write_file(
      folder_ / "press/press.failed.yaml",
      "stage: press\nname: knife\nmessage: \"frame 2:\\n no convergence\"\nframe: 2\ncheck: velocity_residual_m_s\n"
      "value: 2.1e-03\nlimit: 1.0e-04\n");
  const SampleReport sample = read_sample(folder_);
  EXPECT_EQ(sample.name, "knife");
  EXPECT_EQ(sample.failure, "press: frame 2:  no convergence");
  ASSERT_EQ(sample.checks.size(), 1u);
  EXPECT_EQ(sample.checks[0].name, "velocity_residual_m_s");
  EXPECT_EQ(sample.records.front().first, "press.failed.yaml");
}

TEST_F(SampleTest, SaysWhoChoseTheSide) {
  const PlacementReport placement = read_sample(folder_).placement.value();
  EXPECT_EQ(placement.face, "+z");
  EXPECT_EQ(placement.chosen, "opposite of the object's up side -z");
  EXPECT_EQ(placement.rotate_deg, 30.0);
  EXPECT_EQ(placement.center_x_mm, 1.5);
  EXPECT_EQ(placement.center_y_mm, -2.0);
  press("{rotate_deg", "{face: +z, rotate_deg");
  EXPECT_EQ(read_sample(folder_).placement->chosen, "named by the sample");
  press("  object-config: {unit: m, up: -z}\n", "");
  EXPECT_EQ(read_sample(folder_).placement->chosen, "default");
}

TEST_F(SampleTest, TellsWhatBecameOfTheScan) {
  const DecimateReport mesh = read_sample(folder_).decimate.value();
  EXPECT_EQ(mesh.vertices_in, 123456);
  EXPECT_EQ(mesh.vertices_out, 8000);
  EXPECT_EQ(mesh.hausdorff_mm, 0.0123);
  EXPECT_FALSE(mesh.passed_through);
  EXPECT_THAT(mesh.findings, ::testing::ElementsAre(std::pair{"vertices merged", 17}, std::pair{"holes filled", 2},
                                                    std::pair{"crossing faces in the scan", 3}));
}

TEST_F(SampleTest, WarnsOfAnObjectThatIsTheHeightFieldOfOneSide) {
  const auto warning = ::testing::StartsWith(
      "The object's surface cannot be closed (open mesh). Pressed is what its side -z shows: 0.5 µm beside it in the "
      "mean, 6 µm");
  press("../../../objects/star/object.ply", "../object/object.ply");
  write_file(folder_ / "object/decimate.yaml", kDecimateRecord);
  EXPECT_THAT(read_sample(folder_).warnings, ::testing::Not(::testing::Contains(warning)));
  write_file(folder_ / "object/decimate.yaml",
             replaced(kDecimateRecord, "filled_holes: 2}",
                      "filled_holes: 2, height_field: {side: -z, reason: open mesh, mean_error_mm: 0.0005, "
                      "max_error_mm: 0.006, spacing_mm: 0.05}}"));
  EXPECT_THAT(read_sample(folder_).warnings, ::testing::Contains(warning));
}

TEST_F(SampleTest, WarnsOfAWrappedMeshAndCallsItAfterItsScan) {
  press("../../../objects/star/object.ply", "../object/object.ply");
  write_file(folder_ / "object/decimate.yaml",
             replaced(kDecimateRecord, "../../emboss/star/object.ply", "../wrap/object.ply"));
  write_file(folder_ / "wrap/wrap.yaml",
             "inputs:\n  mesh: {path: ../../cup.stl}\nsummary: {scale: 2, alpha_mm: 0.1, seen_mesh_to_wrap_mm: {mean: "
             "0.0071, max: 0.12}}\n");
  const SampleReport sample = read_sample(folder_);
  EXPECT_EQ(sample.object, "cup");
  EXPECT_THAT(sample.warnings, ::testing::Contains("The object is scaled by 2."));
  EXPECT_THAT(sample.warnings,
              ::testing::Contains("The object's mesh was replaced by a closed surface wrapped around it, which fills "
                                  "gaps and grooves that a ball of 0.1 mm does not get into. What is seen of the mesh "
                                  "lies 7.1 µm below that surface in the mean, 120 µm at most."));
  EXPECT_THAT(sample.records, ::testing::Contains(::testing::Pair("wrap.yaml", folder_ / "wrap/wrap.yaml")));
  // Scaled to the window afterwards, and its errors with it.
  write_file(folder_ / "object/decimate.yaml",
             replaced(replaced(kDecimateRecord, "../../emboss/star/object.ply", "../wrap/object.ply"), "summary:\n",
                      "summary:\n  scale: 10\n"));
  EXPECT_THAT(read_sample(folder_).warnings, ::testing::Contains(::testing::HasSubstr(
                                                 "a ball of 1 mm does not get into. What is seen of the mesh lies "
                                                 "71 µm below that surface in the mean, 1200 µm at most.")));
}

TEST_F(SampleTest, AnObjectIsCalledAfterItsScan) {
  press("../../../objects/star/object.ply", "../object/object.ply");
  write_file(folder_ / "object/decimate.yaml",
             replaced(kDecimateRecord, "../../emboss/star/object.ply", "../../dragon.stl"));
  EXPECT_EQ(read_sample(folder_).object, "dragon");
  press("../../../objects/star/object.ply", "../../sphere8k.obj");
  EXPECT_EQ(read_sample(folder_).object, "sphere8k");
  EXPECT_EQ(read_sample(folder_).decimate.has_value(), false);
}

TEST_F(SampleTest, WarningsOfTheLogsAreKept) {
  write_file(folder_ / "render/render.log", "2024-06-07 12:34:56.789 warning: LED 3 lights nothing\n");
  write_file(folder_ / "render/render.yaml", replaced(kRenderRecord, "synthetic", "6bb3992b2fafb7d580f024996ad25abe"));
  const SampleReport sample = read_sample(folder_);
  EXPECT_EQ(sample.synthetic_reference, false);
  EXPECT_THAT(sample.warnings, ::testing::ElementsAre("render: LED 3 lights nothing"));
}

TEST_F(SampleTest, APressWithoutRecordFailedForTheReasonInItsLog) {
  fs::remove(folder_ / "press/press.yaml");
  write_file(folder_ / "press/press.log", "2024-06-07 12:34:56.789 error: press: error: frame 2: no convergence\n");
  write_file(folder_ / "sample.yaml", "motion: {kind: press, depth_mm: 0.7, steps: 5}\n");
  const SampleReport sample = read_sample(folder_);
  EXPECT_EQ(sample.failure, "press: frame 2: no convergence");
  EXPECT_EQ(sample.name, "star");  // of the folder
  EXPECT_DOUBLE_EQ(sample.depth_m.value(), 0.7e-3);
  EXPECT_FALSE(sample.images);  // those there are belong to an older press
}

TEST_F(SampleTest, ARenderWithoutRecordFailsTheSampleButKeepsThePress) {
  fs::remove(folder_ / "render/render.yaml");
  EXPECT_EQ(failure(), "render did not run");
  EXPECT_EQ(read_sample(folder_).press_force_n, 1.25);
}

TEST_F(SampleTest, ImagesOfAnOlderPressDoNotPass) {
  const auto render_of = [&](const std::string& hash) {
    write_file(folder_ / "render/render.yaml",
               std::string(kRenderRecord) + "inputs: {press: {path: ../press, hash: " + hash + "}}\n");
  };
  render_of(content_hash(folder_ / "press"));
  EXPECT_EQ(failure(), "passed");
  write_file(folder_ / "press/positions.npy", "moved");
  EXPECT_EQ(failure(), "render: the images are of an older press; render again");
  EXPECT_FALSE(read_sample(folder_).images);
}

TEST_F(SampleTest, TheVerdictsOfThePressCount) {
  press("converged: true", "converged: false");
  EXPECT_EQ(failure(), "press: Newton did not converge");
  press("intersections: 0", "intersections: 4");
  EXPECT_EQ(failure(), "press: 4 triangle pairs intersect");
  press("inverted_tets: 0", "inverted_tets: 2");
  EXPECT_EQ(failure(), "press: 2 tetrahedra are inverted");
}

TEST_F(SampleTest, APressThatTouchedNothingSaysSo) {
  const std::string untouched = replaced(kPressRecord, "  min_distance_m: 3.5e-05\n", "  contact_frames: 0\n");
  write_file(folder_ / "press/press.yaml", replaced(untouched, " min_gap_m: 3.5e-05,", ""));
  const SampleReport sample = read_sample(folder_);
  EXPECT_EQ(sample.failure, std::nullopt);
  EXPECT_EQ(sample.min_distance_m, std::nullopt);
  EXPECT_EQ(sample.frames[2].min_gap_m, std::nullopt);
  EXPECT_THAT(sample.warnings, ::testing::Contains("Nothing touched the gel in any frame."));
}

TEST_F(SampleTest, BrokenFilesFailTheSampleAndSayWhich) {
  press("  converged: true\n", "");
  EXPECT_EQ(failure(), "press/press.yaml: summary.converged: missing");
  press("press_force_n: 1.25\n  min_d", "press_force_n: much\n  min_d");
  EXPECT_EQ(failure(), "press/press.yaml: summary.press_force_n: expected a number, found 'much'");
  write_file(folder_ / "press/press.yaml", "[1, 2");
  EXPECT_THAT(failure(), ::testing::StartsWith("press/press.yaml:"));
  press("    - {press_force_n: -0, newton_iterations: 0, min_gap_m: 5.0e-05, min_volume_ratio: 1}\n", "");
  EXPECT_EQ(failure(), "press/object_pose.npy: has the shape (3, 4, 4), expected (2, 4, 4)");
  write_file(folder_ / "press/press.yaml", kPressRecord);
  fs::remove(folder_ / "render/frame_0002/normal.png");
  EXPECT_EQ(failure(), "render/frame_0002/normal.png: is missing");
}

TEST_F(SampleTest, AFolderThatIsNoSamplesIsRefused) {
  fs::create_directories(scratch_ / "empty");
  EXPECT_EQ(
      message_of<DataError>([&] { read_sample(scratch_ / "empty"); }),
      (scratch_ / "empty").string() + ": has neither a press folder nor a sample.yaml, so it is not a sample's folder");
}

}  // namespace sample_test
}  // namespace tacipc
