#include "stages/study/marker_fit/fit_field.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "common/base/error.h"
#include "common/format/npy.h"
#include "stages/study/marker_fit/fit_report.h"
#include "tests/config_text.h"
#include "tests/program_test.h"

namespace tacipc {
namespace fit_field_test {

constexpr double kRadius = 2e-3, kPxPerM = 20e3;
const Eigen::Vector2d kPlace(0.5e-3, -0.25e-3), kContactPx(60, 55);

/// Displacement at a point given from the ball's axis, m: outwards by the press, along y by the shear.
Eigen::Vector2d made_up(const Eigen::Vector2d& from_axis, double depth_m, double way_m) {
  const double near = std::exp(-from_axis.squaredNorm() / 4e-6);
  return 100.0 * depth_m * near * from_axis + Eigen::Vector2d(0.0, way_m * near);
}

/// A run that presses in steps of 0.1 mm from 0.1 mm above and drags in steps of 0.1 mm, its markers 0.25 mm apart.
/// Markers go `part` of what they should along x.
void write_run(const std::filesystem::path& folder, int tenths_deep, int tenths_far, double part = 1.0) {
  std::vector<double> pose, markers, moved;
  std::vector<std::uint8_t> phase;
  const auto frames = static_cast<std::size_t>(tenths_deep + 2 + tenths_far);
  for (int f = 0; f < static_cast<int>(frames); ++f) {
    const double depth = 1e-4 * std::min(f - 1, tenths_deep), way = 1e-4 * std::max(0, f - 1 - tenths_deep);
    phase.push_back(static_cast<std::uint8_t>(f == 0 ? 0 : f == 1 ? 1 : way > 0.0 ? 3 : 2));
    for (const double p : {1.0, 0.0, 0.0, kPlace.x(), 0.0, 1.0, 0.0, kPlace.y() + way, 0.0, 0.0, 1.0, kRadius - depth,
                           0.0, 0.0, 0.0, 1.0})
      pose.push_back(p);
    for (int r = 0; r < 25; ++r)
      for (int c = 0; c < 29; ++c) {
        const Eigen::Vector2d rest(-3.5e-3 + 0.25e-3 * c, -3e-3 + 0.25e-3 * r);
        Eigen::Vector2d u = made_up(rest - kPlace, std::max(0.0, depth), way);
        u.x() *= part;
        markers.insert(markers.end(), {rest.x() + u.x(), rest.y() + u.y(), 0.0});
        moved.insert(moved.end(), {u.x(), u.y(), 0.0, 0.0, 0.0, 0.0});
      }
  }
  std::filesystem::create_directories(folder);
  write_npy(folder / "object_pose.npy", {frames, 4, 4}, pose.data());
  write_npy(folder / "phase.npy", {frames}, phase.data());
  write_npy(folder / "markers.npy", {frames, 725, 3}, markers.data());
  write_npy(folder / "marker_displacement.npy", {frames, 725, 2, 3}, moved.data());
}

const std::string kBenchmark = R"(title: made_up
data: shots
fields:
  press: 0.csv
  shear: 1.csv
  remove_press_median: true
  remove_shear_median: false
  image_px: [120, 100]
  px_per_mm: 20
  contact_px: [60, 55]
  shear_marker_px: [60.5, 65]
  least_length_px: 1.0
ball: {radius_mm: 2.0, edge_mm: 0.5}
friction: 0.5
sensor: s.yaml
mesh: m.yaml
press: p.yaml
runs: {shallowest_mm: 0.4, deepest_mm: 1.0, depths: 2, press_step_mm: 0.1, shear_mm: 0.6, shear_steps: 6, direction_deg: 90}
variants:
  - {name: slippery, friction: 0.1}
  - {name: wider, px_per_mm: 22}
)";

MarkerBenchmark benchmark() { return config_from_text<MarkerBenchmark>(kBenchmark, "b.yaml"); }

/// What a camera would measure of it, off by `offset` px.
MarkerField measured(double depth_m, double way_m, const Eigen::Vector2d& offset) {
  MarkerField field{.rest_px = Eigen::Matrix2Xd(2, 42), .moved_px = Eigen::Matrix2Xd(2, 42)};
  for (int i = 0; i < 42; ++i) {
    field.rest_px.col(i) << 15 + 15 * (i % 7), 15 + 10 * (i / 7);
    const Eigen::Vector2d from_axis = (field.rest_px.col(i) - kContactPx) / kPxPerM;
    field.moved_px.col(i) = kPxPerM * made_up(from_axis, depth_m, way_m) + offset;
  }
  return field;
}

class FitField : public ProgramTest {
 protected:
  FitField() {
    write_run(scratch_ / "base/shallow", 4, 6);
    write_run(scratch_ / "base/deep/press", 10, 7);
  }

  /// The benchmark and what a camera measured, in whole pixels.
  void write_measured() {
    scratch_.file("b.yaml", kBenchmark);
    for (const auto& [name, field] :
         {std::pair{"0.csv", measured(0.7e-3, 0.0, {1, -1})}, {"1.csv", measured(0.7e-3, 0.4e-3, {0, 0})}}) {
      std::string csv = "Mx,My,dx,dy\n";
      for (int i = 0; i < 42; ++i)
        csv += fmt::format("{:g},{:g},{:.0f},{:.0f}\n", field.rest_px(0, i), field.rest_px(1, i), field.moved_px(0, i),
                           field.moved_px(1, i));
      scratch_.file(name, csv);
    }
  }
};

TEST_F(FitField, FindsDepthAndWayBetweenFrames) {
  const PressedRuns runs({scratch_ / "base"}, kRadius);
  EXPECT_NEAR(runs.shallowest_m(), 0.4e-3, 1e-12);
  EXPECT_NEAR(runs.deepest_m(), 1.0e-3, 1e-12);
  EXPECT_NEAR(runs.longest_way_m(), 0.6e-3, 1e-12);
  const MeasuredPressAndShear fields(measured(0.73e-3, 0.0, {1.0, -2.0}), measured(0.73e-3, 0.37e-3, {0, 0}),
                                     benchmark());
  const FieldFit fit = fit_field(runs, fields, benchmark().assumed, benchmark());
  EXPECT_NEAR(fit.depth_m, 0.73e-3, 1e-6);
  EXPECT_NEAR(fit.way_m, 0.37e-3, 1e-6);
  EXPECT_LT(fit.way_missed_px, 0.02);
  EXPECT_EQ(fit.press.markers, 42);
  EXPECT_EQ(fit.shear.markers, 41);  // all but the one that was fitted
  EXPECT_LT(fit.press.max_px, 0.02);
  EXPECT_LT(fit.shear.max_px, 0.02);
  EXPECT_NEAR(fit.shear.ratio, 1.0, 5e-3);
  EXPECT_LT(fit.shear.angle_deg, 0.5);
  EXPECT_GT(fit.shear.directions, 5);
}

TEST_F(FitField, AnotherPlaceOfTheContactIsWorse) {
  const PressedRuns runs({scratch_ / "base"}, kRadius);
  const MeasuredPressAndShear fields(measured(0.73e-3, 0.0, {0, 0}), measured(0.73e-3, 0.37e-3, {0, 0}), benchmark());
  MarkerAssumptions elsewhere = benchmark().assumed;
  elsewhere.contact_px.x() += 8;
  EXPECT_GT(fit_field(runs, fields, elsewhere, benchmark()).shear.mean_px, 0.1);
}

TEST_F(FitField, WhatWasNotSimulatedIsSaid) {
  const PressedRuns runs({scratch_ / "base"}, kRadius);
  const auto message = [&](double depth_m, double way_m) {
    const MeasuredPressAndShear fields(measured(depth_m, 0.0, {0, 0}), measured(depth_m, way_m, {0, 0}), benchmark());
    return message_of<DataError>([&] { fit_field(runs, fields, benchmark().assumed, benchmark()); });
  };
  EXPECT_EQ(message(1.2e-3, 0.3e-3), "the deepest press, 1 mm, fits best: simulate deeper ones");
  EXPECT_EQ(message(0.2e-3, 0.3e-3), "a press of 0.2 mm fits best, but the shallowest one that is sheared has 0.4 mm");
  EXPECT_EQ(message(0.7e-3, 0.9e-3), "the longest shear, 0.6 mm, fits best: simulate longer ones");
  MarkerBenchmark elsewhere = benchmark();
  elsewhere.shear_marker_px = {62, 65};
  EXPECT_EQ(message_of<DataError>([&] {
              MeasuredPressAndShear(measured(0, 0, {0, 0}), measured(0, 0, {0, 0}), elsewhere);
            }),
            "fields.shear_marker_px: no marker rests within 1 px of (62, 65)");
}

TEST_F(FitField, RunsThatDoNotFitAreRefused) {
  EXPECT_EQ(message_of<DataError>([&] { PressedRuns({scratch_ / "base/deep"}, kRadius); }),
            (scratch_ / "base/deep").string() + ": has presses to fewer than two depths");
  write_run(scratch_ / "base/again", 4, 6);
  EXPECT_THAT(message_of<DataError>([&] { PressedRuns({scratch_ / "base"}, kRadius); }),
              ::testing::HasSubstr("is pressed as deep as"));
  write_run(scratch_ / "base/again", 4, 0);
  EXPECT_EQ(message_of<DataError>([&] { PressedRuns({scratch_ / "base"}, kRadius); }),
            (scratch_ / "base/again").string() + ": is not a press followed by a shear");
}

TEST(FieldErrors, ByHand) {
  Eigen::Matrix2Xd simulated(2, 4), truth(2, 4);
  simulated << 3, 0, 0, 50, 0, 2, 0, 50;
  truth << 0, 0, 0.5, 0, 3, 4, 0, 0;
  const FieldErrors e = field_errors(simulated, truth, 1.0, 3);
  EXPECT_EQ(e.markers, 3);
  EXPECT_NEAR(e.mean_px, (std::sqrt(18.0) + 2.0 + 0.5) / 3.0, 1e-12);
  EXPECT_NEAR(e.median_px, 2.0, 1e-12);
  EXPECT_NEAR(e.max_px, std::sqrt(18.0), 1e-12);
  EXPECT_EQ(e.directions, 2);
  EXPECT_NEAR(e.angle_deg, 45.0, 1e-12);
  EXPECT_NEAR(e.ratio, 5.0 / 7.5, 1e-12);
}

// Whole: vectors in whole pixels, the base, a variant, a scale, and another simulator that slides too little.
TEST_F(FitField, TheProgramWritesTableVectorsAndPictures) {
  for (const char* other : {"slippery", "rival"}) {
    write_run(scratch_ / (std::string("runs/") + other + "/a"), 4, 6);
    write_run(scratch_ / (std::string("runs/") + other + "/b"), 10, 2);
  }
  write_measured();
  const std::string command = fmt::format(
      "cd '{}' && {}/marker_fit --config b.yaml --pressed 0.csv --sheared 1.csv --runs base=base "
      "slippery=runs/slippery/ rival=runs/rival/a --runs rival=runs/rival/b --log-level error --out ",
      (scratch_ / "").string(), TACIPC_BIN_DIR);
  ASSERT_EQ(run_command(command + "fit"), 0) << said_;
  const std::string table = read_file(scratch_ / "fit/table.md");
  EXPECT_THAT(table, ::testing::HasSubstr("\n| base | 0.7"));
  EXPECT_THAT(table,
              ::testing::HasSubstr("\n| slippery | | | the longest shear, 0.2 mm, fits best: simulate longer ones |"));
  EXPECT_THAT(table, ::testing::HasSubstr("\n| rival | | | the longest shear"));
  EXPECT_THAT(table, ::testing::HasSubstr("\n| wider | 0."));
  EXPECT_THAT(table, ::testing::HasSubstr("\n| no displacement at all | | | "));
  EXPECT_THAT(read_file(scratch_ / "fit/vectors.csv"),
              ::testing::StartsWith(
                  "field,x_px,y_px,measured_dx_px,measured_dy_px,simulated_dx_px,simulated_dy_px\npress,15,15,"));
  EXPECT_THAT(read_file(scratch_ / "fit/shear.svg"), ::testing::HasSubstr("press and shear"));
  ConfigReader record = ConfigReader::from_file(scratch_ / "fit/marker_fit.yaml");
  ConfigReader summary = record.section("summary");
  EXPECT_NEAR(summary.number("depth_mm"), 0.7, 0.1);  // of vectors of up to 1.5 px in whole pixels
  EXPECT_NEAR(summary.number("way_mm"), 0.4, 0.03);
  ConfigReader shear = summary.section("shear");
  EXPECT_LT(shear.number("mean_px"), 0.5);  // of rounding alone
}

// A rival whose markers go sideways too little, one without a fit and one without presses, beside ours under a name.
TEST_F(FitField, OtherSimulatorsStandBesideOurs) {
  write_run(scratch_ / "runs/rival/a", 4, 6, 0.7);
  write_run(scratch_ / "runs/rival/b", 10, 7, 0.7);
  write_run(scratch_ / "runs/short/a", 4, 6);
  write_run(scratch_ / "runs/short/b", 10, 2);
  write_run(scratch_ / "runs/shallow/a", 4, 6);
  write_run(scratch_ / "runs/shallow/b", 6, 7);
  write_run(scratch_ / "runs/deep/a", 9, 6);
  write_run(scratch_ / "runs/deep/b", 10, 7);
  std::filesystem::create_directories(scratch_ / "runs/none");
  write_measured();
  const std::string command = fmt::format(
      "cd '{}' && {}/marker_fit --name ours --config b.yaml --pressed 0.csv --sheared 1.csv --runs base=base "
      "rival=runs/rival short=runs/short none=runs/none shallow=runs/shallow deep=runs/deep --log-level error --out "
      "fit",
      (scratch_ / "").string(), TACIPC_BIN_DIR);
  ASSERT_EQ(run_command(command), 0) << said_;
  const std::string table = read_file(scratch_ / "fit/table.md");
  for (const char* row : {"\n| ours | 0.7", "\n| rival | 0.", "\n| short | | | the longest shear", "\n| none | | | ",
                          "\n| shallow | 0.60 (the deepest) | 0.", "\n| deep | 0.90 (the shallowest) | 0."})
    EXPECT_THAT(table, ::testing::HasSubstr(row));
  ConfigReader record = ConfigReader::from_file(scratch_ / "fit/marker_fit.yaml");
  ConfigReader summary = record.section("summary");
  const double own = summary.section("shear").number("mean_px");
  std::vector<ConfigReader> others = summary.sections("others");
  ASSERT_EQ(others.size(), 3u);
  const double theirs = others[0].section("shear").number("mean_px");
  EXPECT_GT(theirs, own);
  const std::string text = read_file(scratch_ / "fit/others.md");
  EXPECT_THAT(text, ::testing::HasSubstr(fmt::format("Shear, mean end-point error of 41 vectors: ours {:.2f} px, rival "
                                                     "{:.2f} px ({:.2f} times), short no fit, none no fit, shallow ",
                                                     own, theirs, theirs / own)));
  EXPECT_THAT(text, ::testing::HasSubstr(" times). Nearest: "));
  EXPECT_THAT(read_file(scratch_ / "fit/rival_shear.svg"), ::testing::HasSubstr(">rival, press and shear: "));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "fit/short_shear.svg"));
}

TEST(MarkerBenchmark, SaysWhatIsWrong) {
  std::string text = kBenchmark;
  text.replace(text.find("deepest_mm: 1.0"), 15, "deepest_mm: 0.4");
  text.replace(text.find("name: wider"), 11, "name: slippery");
  EXPECT_EQ(faults_in<MarkerBenchmark>(text, "b.yaml"),
            (std::vector<std::string>{"b.yaml:18:40: runs.deepest_mm: 0.4 is outside (0.4, inf)",
                                      "b.yaml:21:12: variants[1].name: is given twice"}));
}

}  // namespace fit_field_test
}  // namespace tacipc
