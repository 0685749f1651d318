// docs/files.md lists what the code declares, no more and no less.
#include <gmock/gmock.h>

#include <fmt/core.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "common/base/files.h"
#include "common/sample/dataset_plan.h"
#include "common/sample/pose_file.h"
#include "common/sample/press_folder.h"
#include "common/sample/render_folder.h"
#include "common/sample/robot_folder.h"
#include "common/sample/scene_folder.h"
#include "stages/image/track/track_arrays.h"

namespace tacipc {
namespace sample_files_page_test {

const std::string kPage = read_file(TACIPC_SOURCE_DIR "/docs/files.md");

/// The rows of the table below a heading, without its two lines of head.
std::string table_below(const std::string& heading) {
  std::istringstream lines(kPage);
  std::string rows;
  bool below = false;
  int count = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) below = line == "## " + heading;
    if (below && line.starts_with("|") && ++count > 2) rows += line + "\n";
  }
  return rows;
}

std::string type_of(const NpyField& field) {
  constexpr const char* kTypes[] = {"f8", "i4", "u1"};
  return fmt::format("{} {}", kTypes[static_cast<int>(field.type)], shape_text(field));
}

std::string row_of(const NpyField& field) {
  return fmt::format("| `{}` | {} | {} | {} |\n", field.file, type_of(field), field.unit, field.meaning);
}

std::string row_of(const ImageField& field) {
  std::string channels;
  for (const std::string& channel : field.channels) channels += " " + channel;
  const std::string name = std::regex_replace(field.file, std::regex(R"(\{:02\})"), "NN");
  return fmt::format("| `{}` | {}{} | {} | {} |\n", name, field.is_float() ? "float" : "8 bit", channels, field.unit,
                     field.meaning);
}

/// Folders of arrays by the headings of their tables.
const std::map<std::string, std::span<const NpyField>> kFolders{{"The press folder", press_fields()},
                                                                {"The grasp folder", grasp_fields()},
                                                                {"The scene folder", scene_fields()},
                                                                {"The robot folder", robot_fields()}};

TEST(FilesPage, ListsTheFoldersOfArrays) {
  for (const auto& [heading, fields] : kFolders) {
    std::string expected;
    for (const NpyField& field : fields) expected += row_of(field);
    EXPECT_EQ(table_below(heading), expected) << heading;
  }
}

TEST(FilesPage, ANameHasOneLayoutAndOneMeaning) {
  std::map<std::string, std::string> rows;
  for (const auto& [heading, fields] : kFolders) {
    for (const NpyField& field : fields) {
      const std::string name = std::filesystem::path(field.file).filename(), row = row_of(field);
      EXPECT_EQ(rows.try_emplace(name, row).first->second, row) << heading;
    }
  }
}

TEST(FilesPage, EveryCodeOfAnArrayHasItsDeclaration) {
  EXPECT_EQ(field_of(PressArray::holder_pose).file, "holder_pose.npy");
  EXPECT_EQ(&field_of(PressArray::front_shear), &press_fields().back());
  EXPECT_EQ(&field_of(GraspArray::momentum), &grasp_fields().back());
  EXPECT_EQ(&field_of(SceneArray::soft_positions), &scene_fields().back());
  EXPECT_EQ(&field_of(RobotArray::answers), &robot_fields().back());
}

TEST(FilesPage, ListsTheFolderOfAFrame) {
  std::string expected;
  for (const ImageField& field : frame_fields()) expected += row_of(field);
  expected += row_of(marker_px_field());
  EXPECT_EQ(table_below("The render folder"), expected);
}

TEST(FilesPage, SaysWhatADatasetRounds) {
  std::string expected;
  for (const ImageField& field : frame_fields()) {
    const DatasetNumbers& numbers = field.in_dataset;
    if (!numbers.rounded()) continue;
    expected += fmt::format("| `{}` | {} | 2^{} {} |\n", field.file,
                            numbers.type == ExrNumbers::halves ? "half" : "float", numbers.step_exponent, field.unit);
  }
  EXPECT_EQ(table_below("Maps of a dataset"), expected);
}

TEST(FilesPage, ListsTheColumnsOfAPlan) {
  std::string expected;
  for (const PlanColumn& column : plan_columns())
    expected += fmt::format("| `{}` | {} |\n", column.name, column.meaning);
  EXPECT_EQ(table_below("The table of samples"), expected);
}

TEST(FilesPage, ListsTheArraysOfOtherStages) {
  const std::pair<const char*, const NpyField&> others[] = {{"track", marker_track_field()},
                                                            {"track", marker_quality_field()},
                                                            {"calibrate", ball_poses_field()},
                                                            {"shade", image_poses_field()}};
  for (const auto& [stage, field] : others) {
    const std::string row =
        fmt::format("| `{}` | {} | {} | {}, {} |\n", field.file, stage, type_of(field), field.unit, field.meaning);
    EXPECT_NE(kPage.find(row), std::string::npos) << row;
  }
}

/// Unit that the page over a dataset gives for a file; empty if it does not show the file.
std::string unit_on_overview(const std::string& file) {
  static const std::string page = read_file(TACIPC_SOURCE_DIR "/stages/dataset/report/dataset/frames.html");
  const std::string cell = "<td class=\"word\">";
  const std::size_t at = page.find("/" + file);
  if (at == std::string::npos) return "";
  const std::size_t begin = page.find(cell, at) + cell.size();
  return page.substr(begin, page.find("</td>", begin) - begin);
}

TEST(FilesPage, ThePageOverADatasetHasTheSameUnits) {
  std::set<std::string> shown;
  const auto compare = [&](const std::string& file, const std::string& unit) {
    const std::string there = unit_on_overview(file);
    if (there.empty() || unit == "code") return;
    shown.insert(file);
    EXPECT_NE((", " + there + ",").find(", " + unit + ","), std::string::npos) << file << ": " << there;
  };
  for (const NpyField& field : press_fields()) compare(field.file, field.unit);
  for (const ImageField& field : frame_fields()) compare(field.file, field.unit);
  compare(marker_px_field().file, marker_px_field().unit);
  EXPECT_THAT(shown, ::testing::UnorderedElementsAre("depth.exr", "indentation.exr", "marker_px.npy", "markers.npy",
                                                     "normal.exr", "object_pose.npy", "traction.exr", "traction.npy",
                                                     "wrench.npy"));
}

TEST(FilesPage, NamesNoArrayThatNobodyDeclares) {
  std::set<std::string> declared{marker_px_field().file, marker_track_field().file, marker_quality_field().file,
                                 ball_poses_field().file, image_poses_field().file};
  for (const auto& [heading, fields] : kFolders) {
    for (const NpyField& field : fields) declared.insert(std::filesystem::path(field.file).filename());
  }
  const std::regex name(R"((\w+\.npy))");
  for (std::sregex_iterator at(kPage.begin(), kPage.end(), name), end; at != end; ++at)
    EXPECT_TRUE(declared.contains(at->str())) << at->str();
}

}  // namespace sample_files_page_test
}  // namespace tacipc
