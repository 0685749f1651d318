// Marker curves of press folders written by hand: what is measured, what counts as settled, what is refused.
#include "verification/marker_curve.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/format/npy.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc::verify {
namespace marker_curve_test {

constexpr int kPressEnd = 2, kMarkers = 3;

/// What a frame of the made-up press shows.
struct Instant {
  double way_m = 0.0;      // of the object along x
  double marker_um = 0.0;  // of the first two markers; the third moves ten times as far
  double load_n = 0.0;     // along x
};

/// Markers (8, 8), (9, 11) and (3, 3); frames 0 to 2 are the press.
std::filesystem::path write_press(const ScratchFolder& folder, const std::vector<Instant>& sliding) {
  const std::size_t frames = kPressEnd + sliding.size();
  std::vector<double> poses, wrench, moved, markers;
  std::string record = fmt::format(
      "name: made up\nsummary:\n  verdict: pass\n  gel_vertices: 7\n  press_end_frame: {}\n  max_balance_relative: "
      "1.0e-6\n  min_distance_m: 1.0e-6\n  min_volume_ratio: 0.9\n  per_frame:\n",
      kPressEnd);
  for (std::size_t f = 0; f < frames; ++f) {
    const Instant at = f < kPressEnd ? Instant{} : sliding[f - kPressEnd];
    for (int i = 0; i < 16; ++i) poses.push_back(i % 5 == 0 ? 1.0 : i == 3 ? at.way_m : 0.0);
    for (const double w : {at.load_n, 0.0, -0.5, 0.0, 0.0, 0.0}) wrench.push_back(w);
    for (int m = 0; m < kMarkers; ++m) {
      const double length = 1e-6 * at.marker_um * (m == 2 ? 10.0 : 1.0);
      for (const double d : {9.0, 9.0, 9.0, 0.6 * length, 0.8 * length, 7.0}) moved.push_back(d);
      for (const double x : {1e-3 * m, 2e-3 * m, 0.0}) markers.push_back(x);
    }
    record += fmt::format("    - {{sticking: {}, slipping: {}}}\n", at.load_n < 0.3 ? 3 : 0, 1);
  }
  const auto press = folder / "press";
  folder.file("press/press.yaml", record);
  folder.file("press/markers.csv", "marker,row,column,vertex0\n0,8,8,1\n1,9,11,1\n2,3,3,1\n");
  write_npy(press / "object_pose.npy", {frames, 4, 4}, poses.data());
  write_npy(press / "wrench.npy", {frames, 6}, wrench.data());
  write_npy(press / "marker_displacement.npy", {frames, kMarkers, 2, 3}, moved.data());
  write_npy(press / "markers.npy", {frames, kMarkers, 3}, markers.data());
  return press;
}

const MarkerCurveConfig kConfig{.chosen = {.first_row = 8, .last_row = 12, .first_column = 8, .last_column = 11},
                                .settled_load = 0.9,
                                .second_difference_limit = 0.05};

/// Sticks for four frames of 5 µm, then slides; from the sixth on the markers gain 1 µm a frame but for a hitch.
std::vector<Instant> slide(double hitch_um) {
  std::vector<Instant> sliding;
  const std::vector<double> um{0.0, 5.0, 10.0, 15.0, 20.0, 23.0, 24.0, 25.0, 26.0 + hitch_um, 27.0, 28.0};
  for (std::size_t f = 0; f < um.size(); ++f)
    sliding.push_back({1e-5 * static_cast<double>(f), um[f], f < 5 ? 0.06 * static_cast<double>(f) : 0.3});
  return sliding;
}

TEST(MarkerCurve, MeansTheChosenMarkersOnly) {
  const ScratchFolder folder;
  const SlidingRun run = read_sliding_run(write_press(folder, slide(0.0)));
  EXPECT_FALSE(run.turns);
  EXPECT_NEAR(run.way.back(), 1e-4, 1e-18);
  EXPECT_NEAR(run.press_force_n.back(), 0.5, 1e-15);
  EXPECT_NEAR(*run.gross_slip_way, 5e-5, 1e-18);
  const MarkerCurve curve = marker_curve(run, kConfig);
  ASSERT_EQ(curve.mean_m.size(), 11u);
  EXPECT_NEAR(curve.mean_m[4], 20e-6, 1e-15);
  EXPECT_NEAR(curve.largest_first_m, 5e-6, 1e-15);
  EXPECT_EQ(curve.settled, 5);
  EXPECT_NEAR(curve.largest_second_m, 0.0, 1e-15);
  EXPECT_NEAR(curve.largest_second_ever_m, 2e-6, 1e-15);
}

TEST(MarkerCurve, ARecordWithoutANumberIsRefused) {
  const ScratchFolder folder;
  const auto press = write_press(folder, slide(0.0));
  std::string record = read_file(press / "press.yaml");
  record.replace(record.find("min_distance_m"), 14, "min_distance_x");
  write_file(press / "press.yaml", record);
  EXPECT_NE(message_of<DataError>([&] { read_sliding_run(press); }).find("summary.min_distance_m: missing"),
            std::string::npos);
}

TEST(MarkerCurve, SeesAHitchOfTheSettledPart) {
  const ScratchFolder folder;
  const MarkerCurve curve = marker_curve(read_sliding_run(write_press(folder, slide(0.2))), kConfig);
  EXPECT_NEAR(curve.largest_second_m, 0.4e-6, 1e-15);
  EXPECT_NEAR(curve.ratio(), 0.08, 1e-9);
}

TEST(MarkerCurve, TurnsAreMeasuredInRadiansAndTorque) {
  const ScratchFolder folder;
  const auto press = write_press(folder, slide(0.0));
  const std::size_t frames = kPressEnd + 11;
  std::vector<double> poses, wrench;
  for (std::size_t f = 0; f < frames; ++f) {
    const double angle = f < kPressEnd ? 0.0 : 0.01 * static_cast<double>(f - kPressEnd);
    const double c = std::cos(angle), s = std::sin(angle);
    // The object stands 2 mm off the axis of S, where the tangential force of 0.1 N along y turns by 0.2 N mm.
    for (const double p : {c, -s, 0.0, 2e-3, s, c, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0})
      poses.push_back(p);
    for (const double w : {0.0, 0.1, -0.5, 0.0, 0.0, 5e-4}) wrench.push_back(w);
  }
  write_npy(press / "object_pose.npy", {frames, 4, 4}, poses.data());
  write_npy(press / "wrench.npy", {frames, 6}, wrench.data());
  const SlidingRun run = read_sliding_run(press);
  EXPECT_TRUE(run.turns);
  EXPECT_NEAR(run.way.back(), 0.1, 1e-12);
  EXPECT_NEAR(run.load.back(), 3e-4, 1e-15);
}

TEST(MarkerCurve, RefusesWhatCannotBeJudged) {
  const ScratchFolder folder;
  std::vector<Instant> rising = slide(0.0);
  for (std::size_t f = 0; f < rising.size(); ++f) rising[f].load_n = 0.1 * static_cast<double>(f);
  const SlidingRun run = read_sliding_run(write_press(folder, rising));
  EXPECT_EQ(message_of<DataError>([&] { marker_curve(run, kConfig); }),
            "made up: sliding becomes steady at frame 9 of 10 after the press: too late to judge");
  MarkerCurveConfig elsewhere = kConfig;
  elsewhere.chosen.first_row = elsewhere.chosen.last_row = 15;
  EXPECT_EQ(message_of<DataError>([&] { marker_curve(run, elsewhere); }),
            "made up: no marker is in rows 15 to 15 and columns 8 to 11");
  std::vector<Instant> still(4);
  EXPECT_EQ(message_of<DataError>([&] { read_sliding_run(write_press(folder, still)); }),
            (folder / "press").string() + ": the object neither slides nor turns after the press");
  const std::vector<double> wrong(6, 0.0);
  write_npy(folder / "press" / "wrench.npy", {1, 6}, wrong.data());
  EXPECT_EQ(message_of<DataError>([&] { read_sliding_run(folder / "press"); }),
            (folder / "press" / "wrench.npy").string() + ": has the shape (1, 6), expected (6, 6)");
  folder.file("board3_shear/press/press.failed.yaml", "stage: press\nmessage: Newton did not converge\n");
  EXPECT_EQ(message_of<DataError>([&] { read_sliding_run(folder / "board3_shear/press"); }),
            "board3_shear: the press failed: Newton did not converge");
}

TEST(MarkerCurve, TheTableSaysWhetherItHolds) {
  const ScratchFolder folder;
  const SlidingRun run = read_sliding_run(write_press(folder, slide(0.2)));
  const MarkerCurve curve = marker_curve(run, kConfig);
  const std::string page = marker_curve_page({run}, {curve}, {}, kConfig);
  EXPECT_NE(page.find("| made up | 7 | 10 | 5.000 µm | 0.05 mm | 0.4000 µm = 8.00 % | 5 % | **missed** | 40.00 % |"),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("| 0.3, 0.3 N | 0.05 mm |"), std::string::npos) << page;
  EXPECT_EQ(
      marker_curve_found({run}, {curve}, kConfig),
      "second differences of the markers' displacement once settled: made up 8.00 % (7 gel vertices); limit 5 % of the "
      "largest first difference");
  EXPECT_NE(marker_quiver_svg(run, kConfig.chosen).find("mean of the green markers 28 um, longest 280 um"),
            std::string::npos);
}

/// The folder of another simulator: the same arrays without press.yaml and wrench.npy, no record of its own.
std::filesystem::path write_other(const ScratchFolder& folder, const std::string& name, double part) {
  std::vector<Instant> motion = slide(0.0);
  for (Instant& at : motion) at.marker_um *= part;
  motion.push_back({1.2e-4, 0.0, 0.0});  // farther than ours goes: does not count
  const auto press = write_press(folder, motion);
  const auto other = folder / name;
  std::filesystem::create_directories(other);
  for (const char* file : {"markers.csv", "markers.npy", "marker_displacement.npy", "object_pose.npy"})
    std::filesystem::copy_file(press / file, other / file);
  std::vector<std::uint8_t> phase{0, 2, 2};
  phase.resize(kPressEnd + motion.size(), 3);
  write_npy(other / "phase.npy", {phase.size()}, phase.data());
  std::filesystem::remove_all(press);
  return other;
}

TEST(MarkerMotion, AnotherSimulatorsFilesStandBesideOurs) {
  const ScratchFolder folder;
  const MarkerMotion other = read_other_motion(write_other(folder, "mpm", 0.5));
  EXPECT_EQ(other.name, "mpm");
  EXPECT_EQ(other.press_end_frame, kPressEnd);
  EXPECT_NEAR(mean_displacements(other, kConfig.chosen)[4], 10e-6, 1e-15);
  const SlidingRun run = read_sliding_run(write_press(folder, slide(0.0)));
  const MotionComparison found = compare(run, other, kConfig.chosen);
  EXPECT_NEAR(found.mean_m, 14e-6, 1e-12);
  EXPECT_NEAR(found.ratio, 0.5, 1e-9);
  EXPECT_NEAR(found.error_m, 14e-6, 1e-12);
  EXPECT_NEAR(found.largest_m, 14e-6, 1e-12);

  const MarkerCurve curve = marker_curve(run, kConfig);
  EXPECT_NE(marker_curve_svg(run, curve, {other}, kConfig).find("the same by mpm"), std::string::npos);
  const std::string page = marker_curve_page({run}, {curve}, {other}, kConfig);
  EXPECT_NE(page.find("| made up | mpm | 14.0 µm | 0.500 | 14.0 µm | 14.0 µm |"), std::string::npos) << page;
  EXPECT_NE(page.find("(made up_mpm_quiver.svg)"), std::string::npos) << page;
  MarkerMotion turned = other;
  turned.turns = true;  // a twist is not a rival of a shear
  EXPECT_EQ(marker_curve_page({run}, {curve}, {turned}, kConfig).find("| mpm |"), std::string::npos);
  EXPECT_EQ(marker_curve_svg(run, curve, {turned}, kConfig), marker_curve_svg(run, curve, {}, kConfig));
}

TEST(MarkerMotion, VectorsOfEveryMarkerAndFrame) {
  const ScratchFolder folder;
  const MarkerMotion other = read_other_motion(write_other(folder, "mpm", 1.0));
  const std::string csv = marker_vectors_csv(other);
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "frame,marker,row,column,x_mm,y_mm,dx_um,dy_um");
  EXPECT_NE(csv.find("\n6,1,9,11,1,2,12.0000,16.0000\n"), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 12 * kMarkers);
}

TEST(MarkerMotion, WhatCannotBeComparedIsSaid) {
  const ScratchFolder folder;
  const auto place = write_other(folder, "mpm", 1.0);
  MarkerMotion other = read_other_motion(place);
  const SlidingRun run = read_sliding_run(write_press(folder, slide(0.0)));
  other.rows[1] = 10;
  EXPECT_EQ(message_of<DataError>([&] { compare(run, other, kConfig.chosen); }),
            "mpm: has no marker in row 9, column 11");
  other.way.resize(8);
  EXPECT_EQ(message_of<DataError>([&] { compare(run, other, kConfig.chosen); }),
            "mpm: goes 7e-05, made up goes 0.0001");
  const std::vector<std::uint8_t> phase(14, 3);
  write_npy(place / "phase.npy", {14}, phase.data());
  EXPECT_EQ(message_of<DataError>([&] { read_other_motion(place); }),
            (place / "phase.npy").string() + ": nothing follows a press");
  folder.file("mpm/mpm.yaml", "stage: rival\n");
  std::vector<std::uint8_t> again(14, 3);
  again[2] = 2;
  write_npy(place / "phase.npy", {14}, again.data());
  EXPECT_EQ(read_other_motion(place).name, "rival");
}

TEST(MarkerCurveConfig, ReadsItsKeys) {
  const ScratchFolder folder;
  const auto file = folder.file("c.yaml",
                                "rows: {first: 8, last: 7}\ncolumns: {first: 8, last: 11}\nsettled_load: 1.5\n"
                                "second_difference_limit: 0.05\n");
  const std::string place = file.string();
  EXPECT_EQ(faults_of([&] { read_config<MarkerCurveConfig>(file); }),
            (std::vector<std::string>{place + ":1:24: rows.last: 7 is below 8",
                                      place + ":3:15: settled_load: 1.5 is outside (0, 1)"}));
}

}  // namespace marker_curve_test
}  // namespace tacipc::verify
