// Folders of several simulators written by hand: what is read, what differs, what the page says.
#include "verification/simulator_comparison.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "common/format/npy.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc::verify {
namespace simulator_comparison_test {

using ::testing::HasSubstr;
using ::testing::Not;

/// Three markers, (8, 8), (9, 11) and (3, 3), at x = 1, 2 and 3 mm; a press, then three frames in which the object goes
/// 0.1 mm a frame, or turns by 0.01 rad, and every marker goes `part` of 0.1 mm along y a frame.
std::filesystem::path write_run(const ScratchFolder& folder, const std::string& name, const std::string& stage,
                                const std::string& settings, double part, bool turns = false) {
  constexpr std::size_t kFrames = 5, kMarkers = 3;
  std::vector<double> poses, moved, markers;
  for (std::size_t f = 0; f < kFrames; ++f) {
    const double step = f < 2 ? 0.0 : static_cast<double>(f - 1), angle = turns ? 0.01 * step : 0.0;
    const double c = std::cos(angle), s = std::sin(angle), y = turns ? 0.0 : 1e-4 * step;
    for (const double p : {c, -s, 0.0, 0.0, s, c, 0.0, y, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0}) poses.push_back(p);
    for (std::size_t m = 0; m < kMarkers; ++m) {
      for (const double d : {9.0, 9.0, 9.0, 0.0, part * 1e-4 * step, 7.0}) moved.push_back(d);
      for (const double x : {1e-3 * static_cast<double>(m + 1), 0.0, 0.0}) markers.push_back(x);
    }
  }
  const auto out = folder / name;
  folder.file(name + "/" + stage + ".yaml",
              fmt::format("stage: {}\nname: {}\nconfig:\n  config: {{{}}}\nsummary:\n  frames: 5\n{}", stage, name,
                          settings, stage == "mpm" ? "  marker_change_at_half_speed: 0.0123\n" : ""));
  folder.file(name + "/markers.csv", "marker,row,column,vertex0\n0,8,8,1\n1,9,11,1\n2,3,3,1\n");
  write_npy(out / "object_pose.npy", {kFrames, 4, 4}, poses.data());
  write_npy(out / "marker_displacement.npy", {kFrames, kMarkers, 2, 3}, moved.data());
  write_npy(out / "markers.npy", {kFrames, kMarkers, 3}, markers.data());
  const std::vector<std::uint8_t> phase{0, 2, 3, 3, 3};
  write_npy(out / "phase.npy", {kFrames}, phase.data());
  return out;
}

const SimulatorComparison kConfig{.title = "made",
                                  .chosen = {.first_row = 8, .last_row = 12, .first_column = 8, .last_column = 11},
                                  .motions = {"shear"},
                                  .simulators = {{"ours", "Ours"}, {"rival", "The rival"}},
                                  .reported_below = 0.9};

TEST(SimulatorRun, ReadsWhatPressAndMpmLeave) {
  const ScratchFolder folder;
  const SimulatorRun run =
      SimulatorRun::read(write_run(folder, "a", "mpm", "grid: {spacing_mm: 0.4, origin_mm: [1, 2]}, step: 3", 0.5));
  EXPECT_EQ(run.stage, "mpm");
  EXPECT_EQ(run.half_speed_change, 0.0123);
  EXPECT_EQ(run.settings, (std::vector<std::pair<std::string, std::string>>{
                              {"grid.spacing_mm", "0.4"}, {"grid.origin_mm", "[1, 2]"}, {"step", "3"}}));
  EXPECT_NEAR(mean_displacements(*run.motion, kConfig.chosen).back(), 1.5e-4, 1e-15);
  EXPECT_NEAR(mean_of_carried(*run.motion, kConfig.chosen).back(), 3e-4, 1e-15);
}

TEST(SimulatorRun, StuckMarkersTurnWithTheObject) {
  const ScratchFolder folder;
  const SimulatorRun run = SimulatorRun::read(write_run(folder, "a", "press", "a: 1", 0.5, true));
  // Chords of 0.03 rad at 1 and 2 mm from the axis.
  EXPECT_NEAR(mean_of_carried(*run.motion, kConfig.chosen).back(), 1.5e-3 * 2.0 * std::sin(0.015), 1e-12);
}

TEST(SimulatorRun, SaysWhyThereIsNothing) {
  const ScratchFolder folder;
  folder.file("x/mpm.failed.yaml", "stage: mpm\nmessage: too fast\n");
  folder.file("y/else.txt", "");
  EXPECT_EQ(SimulatorRun::read(folder / "x").failure, "too fast");
  EXPECT_EQ(SimulatorRun::read(folder / "y").failure, "left no record");
  EXPECT_FALSE(SimulatorRun::read(folder / "x").motion);
}

TEST(DifferingSettings, NamesChangedAddedAndMissingOnes) {
  const SimulatorRun a{.name = "a", .stage = "mpm", .motion = {}, .failure = {}, .settings = {{"x", "1"}, {"y", "2"}}};
  const SimulatorRun b{.name = "b", .stage = "mpm", .motion = {}, .failure = {}, .settings = {{"x", "3"}, {"z", "4"}}};
  EXPECT_EQ(differing_settings(a, b), "`x` 1 (3), `y` 2 (not said), `z` not said (4)");
  EXPECT_EQ(differing_settings(a, a), "");
}

TEST(NearestRun, IsOfTheSameStageWithTheFewestDifferences) {
  const ScratchFolder folder;
  const auto read = [&](const std::string& name, const std::string& stage, const std::string& settings) {
    return SimulatorRun::read(write_run(folder, name, stage, settings, 0.5));
  };
  const SimulatorRun press = read("p", "press", "x: 1, y: 2"), far = read("f", "mpm", "x: 1, y: 5"),
                     near = read("n", "mpm", "x: 1, y: 2");
  const std::vector<const SimulatorRun*> all{&press, &far, &near};
  EXPECT_EQ(nearest_run(read("v", "mpm", "x: 9, y: 2"), all), &near);
  EXPECT_EQ(nearest_run(read("w", "mpm", "x: 9, y: 5"), all), &far);
  EXPECT_EQ(nearest_run(read("q", "press", "x: 9, y: 5"), all), &press);
  EXPECT_EQ(nearest_run(SimulatorRun{.name = "", .stage = "other", .motion = {}, .failure = {}}, all), nullptr);
}

/// Ours moves its markers by 0.4 of the way, the rival by `part`; a factor brings the rival to 0.1, another ours to
/// 0.8.
ComparedRuns compared(const ScratchFolder& folder, double part) {
  return {.config = kConfig,
          .runs = {SimulatorRun::read(write_run(folder, "ours", "press", "mu: 0.7", 0.4)),
                   SimulatorRun::read(write_run(folder, "rival", "mpm", "points: 9", part))},
          .factors = {SimulatorRun::read(write_run(folder, "few", "mpm", "points: 1", 0.1)),
                      SimulatorRun::read(write_run(folder, "sticky", "press", "mu: 5", 0.8))}};
}

TEST(ComparisonPage, SaysWhetherThePapersFindingComesOut) {
  const ScratchFolder folder;
  const std::string longer = comparison_page(compared(folder, 0.6), "pics");
  EXPECT_THAT(longer, HasSubstr("| Ours | 120.0 | 40 % | | | | 120.0 |  |\n"));
  EXPECT_THAT(longer, HasSubstr("| The rival | 180.0 | 60 % | 1.50 | 60 | 60 | 180.0 | 1.23 % |\n"));
  EXPECT_THAT(longer,
              HasSubstr("The object is dragged by 0.3 mm. Ours: the markers around its middle move by 120 µm, 40 % "
                        "of the object's travel over them. The rival: 1.50 times that, longer; the paper"));
  EXPECT_THAT(comparison_page(compared(folder, 0.2), "pics"),
              HasSubstr("The rival: 0.50 times that, shorter, as the paper reports."));
  EXPECT_THAT(comparison_page(compared(folder, 0.42), "pics"), HasSubstr("1.05 times that, about as long;"));
  for (const char* link : {"(pics/made_shear_curves.svg)", "(pics/made_shear_ours.svg)", "(pics/made_shear_rival.svg)"})
    EXPECT_THAT(longer, HasSubstr(link));
}

TEST(ComparisonPage, SaysHowFarTheRivalStaysBehind) {
  const ScratchFolder folder;
  ComparedRuns all = compared(folder, 0.6);
  EXPECT_THAT(comparison_page(all, "pics"), Not(HasSubstr("shorter while")));
  for (const std::size_t f : {1, 2}) all.runs[1].motion->markers[f] *= 0.5;  // 30 and 60 of ours' 40 and 80 um
  EXPECT_THAT(comparison_page(all, "pics"),
              HasSubstr("reports clearly shorter ones (shorter while the object is dragged up to 0.2 mm)."));
}

TEST(ComparisonPage, FactorsStandBesideWhatTheyVary) {
  const ScratchFolder folder;
  ComparedRuns all = compared(folder, 0.6);
  all.factors.push_back({.name = "broken", .stage = "", .motion = {}, .failure = "through the gel"});
  const std::string page = comparison_page(all, "pics");
  EXPECT_THAT(page, HasSubstr("| The rival | `points` 1 (9) | 30.0 | 10 % | 0.17 | 0.25 |\n"));
  EXPECT_THAT(page, HasSubstr("| Ours | `mu` 5 (0.7) | 240.0 | 80 % | 2.00 | 2.00 |\n"));
  EXPECT_THAT(page, HasSubstr("| broken | | **failed**: through the gel | | | |\n"));
  EXPECT_THAT(page, HasSubstr("The rival, one value changed: with `points` 1 (9): 30 µm, 0.25 times those of Ours.\n"));
  all.factors.push_back(all.runs[1]);
  all.factors.back().settings = {{"points", "99"}};
  EXPECT_THAT(comparison_page(all, "pics"),
              HasSubstr("shortest vectors with `points` 1 (9): 30 µm, 0.25 times those of Ours; longest with `points` "
                        "99 (9): 180 µm, 1.50 times those of Ours.\n"));
  all.factors.clear();
  EXPECT_THAT(comparison_page(all, "pics"), Not(HasSubstr("One value changed")));
}

TEST(ComparisonPage, ARunThatFailedIsARow) {
  const ScratchFolder folder;
  ComparedRuns all = compared(folder, 0.6);
  all.runs[1] = {.name = "rival", .stage = "", .motion = {}, .failure = "too fast"};
  const std::string page = comparison_page(all, "pics");
  EXPECT_THAT(page, HasSubstr("| The rival | **failed**: too fast | | | | | | |\n"));
  EXPECT_THAT(page, Not(HasSubstr("made_shear_rival.svg")));
  EXPECT_THAT(comparison_curve_svg(all, 0), Not(HasSubstr("The rival")));
}

TEST(ComparisonCurves, HoldEverySimulatorAndTheObject) {
  const ScratchFolder folder;
  const ComparedRuns all = compared(folder, 0.6);
  const std::string csv = comparison_curve_csv(all, 0);
  EXPECT_THAT(csv, HasSubstr("\nours,4,0.3,120,300\n"));
  EXPECT_THAT(csv, HasSubstr("\nrival,2,0.1,60,100\n"));
  const std::string svg = comparison_curve_svg(all, 0);
  for (const char* label : {"Ours", "The rival", "stuck to the object"}) EXPECT_THAT(svg, HasSubstr(label));
}

TEST(MarkerQuiver, OneScaleForSeveralPictures) {
  const ScratchFolder folder;
  const ComparedRuns all = compared(folder, 0.8);
  const auto scale = [&](std::size_t s, std::optional<double> longest_m) {
    const std::string svg = marker_quiver_svg(*all.at(s, 0).motion, kConfig.chosen, longest_m);
    return svg.substr(svg.find("arrows drawn"));
  };
  EXPECT_NE(scale(0, std::nullopt), scale(1, std::nullopt));
  const double longest_m = longest_displacement(*all.at(1, 0).motion);
  EXPECT_NEAR(longest_m, 2.4e-4, 1e-15);
  EXPECT_EQ(scale(0, longest_m), scale(1, longest_m));
  EXPECT_EQ(scale(1, longest_m), scale(1, std::nullopt));
}

TEST(SimulatorComparison, ReadsItsKeys) {
  for (const char* name : {"board3", "quick"}) {
    const auto config = read_config<SimulatorComparison>(std::string(TACIPC_SOURCE_DIR) +
                                                         "/configs/studies/paper/markers/" + name + ".yaml");
    EXPECT_EQ(config.simulators.front().label, "TacIPC");
    EXPECT_TRUE(config.chosen.has(12, 11));
  }
  const ScratchFolder folder;
  const auto file = folder.file("c.yaml",
                                "title: t\nrows: {first: 8, last: 9}\ncolumns: {first: 8, last: 11}\nmotions: []\n"
                                "simulators:\n  - {name: a, label: b}\nreported_below: 0\n");
  const std::string place = file.string();
  EXPECT_EQ(faults_of([&] { read_config<SimulatorComparison>(file); }),
            (std::vector<std::string>{place + ":4:10: motions: name at least one",
                                      place + ":6:3: simulators: name at least two",
                                      place + ":7:17: reported_below: 0 is outside (0, inf)"}));
}

}  // namespace simulator_comparison_test
}  // namespace tacipc::verify
