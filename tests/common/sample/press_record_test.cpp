#include "common/sample/press_record.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace press_record_test {

template <typename Summary>
Record recorded(const ScratchFolder& folder, const Summary& summary) {
  return Record::from_file(folder.file("press.yaml", to_yaml(Value::Map{{"summary", record_lines(summary)}})));
}

TEST(PressRecord, IsReadAsItWasWritten) {
  const ScratchFolder folder;
  PressSummary written{.gel_vertices = 7, .face = "-z", .min_distance_m = 2e-6, .verdict = kPassed};
  written.limits.balance_relative = 1e-3;
  written.per_frame = {{.phase = "press", .press_force_n = 0.25, .sticking = 3}, {.phase = "free", .body_strain = 0.5}};
  const auto summary = summary_of<PressSummary>(recorded(folder, written));
  EXPECT_EQ(summary.required(&PressSummary::gel_vertices), 7);
  EXPECT_EQ(summary.find(&PressSummary::face), "-z");
  EXPECT_EQ(summary.required(&PressSummary::min_distance_m), 2e-6);
  EXPECT_EQ(summary.required(&PressSummary::converged), false);
  EXPECT_EQ(summary.section(&PressSummary::limits).required(&PressLimits::balance_relative), 1e-3);
  const auto frames = summary.sections(&PressSummary::per_frame);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].required(&PressFrameLines::press_force_n), 0.25);
  EXPECT_EQ(frames[0].number(&PressFrameLines::sticking), 3.0);
  EXPECT_EQ(frames[0].find(&PressFrameLines::body_strain), std::nullopt);
  EXPECT_EQ(frames[1].find(&PressFrameLines::body_strain), 0.5);
}

TEST(PressRecord, VectorsAndMapsOfAGraspAreReadAsTheyWereWritten) {
  const ScratchFolder folder;
  GraspSummary written{.gravity_m_s2 = Vector3(0, 0, -9.81), .slip_right = SlipLines{.first_slip_s = 0.5}};
  written.pose = {.rotation_xyzw = {0, 0, 0, 1}, .grip_m = Vector3(1, 2, 3), .lever_m = 0.25};
  const auto summary = summary_of<GraspSummary>(recorded(folder, written));
  EXPECT_EQ(summary.required(&GraspSummary::gravity_m_s2), Vector3(0, 0, -9.81));
  EXPECT_EQ(summary.section(&GraspSummary::pose).required(&HeldPoseLines::grip_m), Vector3(1, 2, 3));
  EXPECT_FALSE(summary.has(&GraspSummary::slip_left));
  EXPECT_EQ(summary.section(&GraspSummary::slip_left).find(&SlipLines::first_slip_s), std::nullopt);
  EXPECT_EQ(summary.section(&GraspSummary::slip_right).find(&SlipLines::first_slip_s), 0.5);
}

TEST(PressRecord, ThePhaseOfASceneMayBeNegative) {
  const ScratchFolder folder;
  SceneSummary written;
  written.per_frame = {{.phase = -1}};
  const auto frames = summary_of<SceneSummary>(recorded(folder, written)).sections(&SceneSummary::per_frame);
  EXPECT_EQ(frames.at(0).number(&SceneFrameLines::phase), -1.0);
}

TEST(PressRecord, KeysStandInTheOrderOfTheStructWithoutEmptyOnes) {
  EXPECT_EQ(to_yaml(record_lines(SceneBodyLines{.name = "block", .kind = "rigid", .mass_kg = 0.5})),
            "name: block\nkind: rigid\nmass_kg: 0.5\n");
}

TEST(PressRecord, WhatIsMissingOrOfAnotherTypeIsRefusedAtItsPlace) {
  const ScratchFolder folder;
  const std::string file = folder.file("press.yaml", "summary:\n  min_distance_m: near\n  per_frame:\n    - {}\n");
  const auto summary = summary_of<PressSummary>(Record::from_file(file));
  EXPECT_EQ(message_of<DataError>([&] { summary.required(&PressSummary::min_distance_m); }),
            file + ": summary.min_distance_m: expected a number, found 'near'");
  const auto frames = summary.sections(&PressSummary::per_frame);
  EXPECT_EQ(message_of<DataError>([&] { frames.at(0).required(&PressFrameLines::min_gap_m); }),
            file + ": summary.per_frame[0].min_gap_m: missing");
}

/// First column of the table below a heading.
std::vector<std::string> table_keys(const std::string& heading) {
  std::istringstream lines(read_file(TACIPC_SOURCE_DIR "/docs/files.md"));
  std::vector<std::string> keys;
  bool below = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) below = line == "## " + heading;
    if (below && line.starts_with("| `")) keys.push_back(line.substr(3, line.find('`', 3) - 3));
  }
  return keys;
}

/// The names in backticks between two texts of a page.
std::vector<std::string> listed(const std::string& page, const std::string& begin, const std::string& end) {
  const std::string text = read_file(TACIPC_SOURCE_DIR "/docs/" + page);
  std::vector<std::string> names;
  const std::size_t first = text.find(begin);
  if (first == std::string::npos) return names;
  std::istringstream list(text.substr(first + begin.size(), text.find(end, first) - first - begin.size()));
  std::string word;
  for (bool inside = false; std::getline(list, word, '`'); inside = !inside)
    if (inside) names.push_back(word);
  return names;
}

template <HasRecordKeys Lines>
std::vector<std::string> key_names() {
  return std::apply([](const auto&... keys) { return std::vector<std::string>{keys.name...}; }, Lines::keys());
}

TEST(PressRecord, ThePagesListTheKeys) {
  EXPECT_EQ(table_keys("Summary of a press"), key_names<PressSummary>());
  EXPECT_EQ(table_keys("Frames of a press record"), key_names<PressFrameLines>());
  EXPECT_EQ(listed("grasp.md", "Keys of the record's `summary`:", ".\n"), key_names<GraspSummary>());
  EXPECT_EQ(listed("grasp.md", "Keys of `pose`:", ".\n"), key_names<HeldPoseLines>());
  EXPECT_EQ(listed("grasp.md", "Keys of `slip_left` and `slip_right`:", ".\n"), key_names<SlipLines>());
  EXPECT_EQ(listed("grasp.md", "Keys of each frame:", ".\n"), key_names<GraspFrameLines>());
  EXPECT_EQ(listed("scenes.md", "Keys of the record's `summary`:", ".\n"), key_names<SceneSummary>());
  EXPECT_EQ(listed("scenes.md", "Keys of each body:", ".\n"), key_names<SceneBodyLines>());
  EXPECT_EQ(listed("scenes.md", "Keys of each entry of `contact`, the contact of a pair that the scene names:", ". "),
            key_names<ContactLines>());
  EXPECT_EQ(listed("scenes.md", "Keys of each entry of `held`:", ".\n"), key_names<HeldBodyLines>());
  EXPECT_EQ(listed("scenes.md", "Keys of each frame:", ".\n"), key_names<SceneFrameLines>());
}

TEST(PressRecord, ThePageOfTheVerdictListsTheLimits) {
  std::vector<std::string> expected = key_names<PressLimits>();
  // In brackets beside its key: the check that `gel_in_object` belongs to.
  expected.insert(std::find(expected.begin(), expected.end(), "gel_in_object") + 1, "containment");
  EXPECT_EQ(listed("verdict.md", "`report` reads them:", ".\n"), expected);
}

}  // namespace press_record_test
}  // namespace tacipc
