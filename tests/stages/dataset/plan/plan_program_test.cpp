#include <fmt/core.h>
#include <gmock/gmock.h>

#include "common/base/files.h"
#include "tests/program_test.h"

namespace tacipc {
namespace plan_program_test {

namespace fs = std::filesystem;

class PlanProgram : public ProgramTest {
 protected:
  int plan(const fs::path& config) {
    return run_command(fmt::format("cd {} && {}/plan --config '{}' --out '{}' --log-level error", TACIPC_SOURCE_DIR,
                                   TACIPC_BIN_DIR, config.string(), (scratch_ / "set/plan").string()));
  }
};

TEST_F(PlanProgram, TheShippedDatasetsArePlanned) {
  int found = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(TACIPC_SOURCE_DIR) / "configs/datasets")) {
    if (entry.is_directory()) continue;  // pack, card …: not datasets
    fs::remove_all(scratch_ / "set");
    ASSERT_EQ(plan(fs::relative(entry.path(), TACIPC_SOURCE_DIR)), 0) << entry.path() << ": " << said_;
    const std::string csv = read_file(scratch_ / "set/plan/samples.csv");
    EXPECT_TRUE(csv.starts_with("id,index,split,split_pose,seed,sensor,mesh,object,motion,shard,folder\n"));
    const std::string first = csv.substr(csv.find('\n') + 1), id = first.substr(0, first.find(','));
    EXPECT_TRUE(fs::exists(scratch_ / ("set/samples/000/" + id + "/sample.yaml"))) << id;
    ++found;
  }
  EXPECT_GE(found, 2);
}

TEST_F(PlanProgram, MapsGoToRenderInAFileThatChangesWithThemAlone) {
  const auto write = [&](const std::string& seed, const std::string& maps) {
    return scratch_.file("d.yaml", fmt::format(R"(seed: {1}
sensors: {{sensor: {0}/configs/sensors/mctac.yaml, mesh: {0}/configs/gels/tiny.yaml}}
objects: {{emboss: {0}/configs/objects/patterns/star.yaml}}
motions:
  - {{name: a, samples: 1, motion: {{kind: press, depth_mm: 0.3, steps: 1}}}}
{2})",
                                               TACIPC_SOURCE_DIR, seed, maps));
  };
  const fs::path maps = scratch_ / "set/maps.yaml";
  ASSERT_EQ(plan(write("1", "maps: [tactile, depth]\n")), 0) << said_;
  EXPECT_EQ(read_file(maps), "# Made by the stage plan.\nmaps: [depth, tactile]\n");
  EXPECT_THAT(read_file(scratch_ / "set/plan/dataset.yaml"), ::testing::HasSubstr("maps: [tactile, depth]\n"));
  EXPECT_THAT(read_file(scratch_ / "set/plan/dataset.mk"),
              ::testing::HasSubstr("DATASET_MAPS := $(DATASET_DIR)/maps.yaml\n"));
  const auto old = fs::last_write_time(maps) - std::chrono::hours(1);
  fs::last_write_time(maps, old);
  ASSERT_EQ(plan(write("2", "maps: [depth, tactile]\n")), 0) << said_;
  EXPECT_EQ(fs::last_write_time(maps), old);
  ASSERT_EQ(plan(write("2", "")), 0) << said_;
  EXPECT_NE(fs::last_write_time(maps), old);
  EXPECT_EQ(plan(write("2", "maps: [tactile, deep]\n")), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr("d.yaml:6:17: maps[1]: 'deep' is not one of "));
}

/// Of 640 × 480 pixels a packed frame takes 2.2 MB.
TEST_F(PlanProgram, ShardsAreSizedByTheFramesThatAreRendered) {
  const auto shards = [&](const std::string& frames) {
    scratch_.file("render.yaml", "frames: " + frames + "\nnoise: {seed: 1}\n");
    const fs::path config = scratch_.file("d.yaml", fmt::format(R"(seed: 1
sensors: {{sensor: {0}/configs/sensors/mctac.yaml, mesh: {0}/configs/gels/tiny.yaml}}
objects: {{emboss: {0}/configs/objects/patterns/star.yaml}}
render: render.yaml
motions:
  - name: a
    samples: 4
    motion:
      - {{kind: press, depth_mm: 0.3, steps: 5}}
      - {{kind: shear, distance_mm: 0.1, steps: 2}}
      - {{kind: shear, distance_mm: 0.1, steps: 2}}
      - {{kind: twist, angle_deg: 1, steps: 1}}
outputs: {{shard_mb: 9}}
)",
                                                                TACIPC_SOURCE_DIR));
    EXPECT_EQ(plan(config), 0) << said_;
    const std::string csv = read_file(scratch_ / "set/plan/samples.csv");
    return csv.substr(csv.find("-of-") + 4, 5);
  };
  EXPECT_EQ(shards("last"), "00002");    // 2 frames
  EXPECT_EQ(shards("phases"), "00004");  // 4: neighbouring phases of one kind count as one
  EXPECT_EQ(shards("all"), "00004");     // 11, but a sample is not divided
  scratch_.file("render.yaml", "frames: every\n");
  EXPECT_EQ(plan(scratch_ / "d.yaml"), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr("frames: 'every' is not one of"));
}

TEST_F(PlanProgram, OnlyChangedSamplesAreWrittenAgain) {
  const auto write = [&](const std::string& depth) {
    return scratch_.file("d.yaml", fmt::format(R"(seed: 1
sensors: {{sensor: {0}/configs/sensors/mctac.yaml, mesh: {0}/configs/gels/tiny.yaml}}
objects: {{emboss: {0}/configs/objects/patterns/star.yaml}}
motions:
  - {{name: a, samples: 1, motion: {{kind: press, depth_mm: 0.3, steps: 1}}}}
  - {{name: b, samples: 1, motion: {{kind: press, depth_mm: {1}, steps: 1}}}}
)",
                                               TACIPC_SOURCE_DIR, depth));
  };
  ASSERT_EQ(plan(write("0.3")), 0) << said_;
  const auto a = scratch_ / "set/samples/000/mctac__star__a__000000/sample.yaml",
             b = scratch_ / "set/samples/000/mctac__star__b__000001/sample.yaml";
  const auto old = fs::last_write_time(a) - std::chrono::hours(1);
  for (const auto& file : {a, b}) fs::last_write_time(file, old);
  ASSERT_EQ(plan(write("0.4")), 0) << said_;
  EXPECT_EQ(fs::last_write_time(a), old);
  EXPECT_NE(fs::last_write_time(b), old);
  // Another seed is another sample, though nothing is drawn: its noise differs.
  std::string text = read_file(write("0.4"));
  scratch_.file("d.yaml", text.replace(0, 7, "seed: 2"));
  ASSERT_EQ(plan(scratch_ / "d.yaml"), 0) << said_;
  EXPECT_NE(fs::last_write_time(a), old);
}

TEST_F(PlanProgram, ARefusedPlanLeavesTheOneThereWas) {
  const auto write = [&](const std::string& more) {
    return scratch_.file("d.yaml", fmt::format(R"(seed: 1
sensors: {{sensor: {0}/configs/sensors/mctac.yaml, mesh: {0}/configs/gels/tiny.yaml}}
objects: {{emboss: {0}/configs/objects/patterns/star.yaml}}
motions: {{name: a, samples: 1, motion: {{kind: press, depth_mm: 0.3, steps: 1}}}}
{1})",
                                               TACIPC_SOURCE_DIR, more));
  };
  ASSERT_EQ(plan(write("")), 0) << said_;
  const std::string before = content_hash(scratch_ / "set");
  EXPECT_EQ(plan(write("stop_after_failure: 3\n")), 2);
  EXPECT_THAT(said_, testing::HasSubstr("unknown key (did you mean stop_after_failures?)"));
  EXPECT_EQ(content_hash(scratch_ / "set"), before);
  EXPECT_TRUE(fs::exists(scratch_ / "set/plan/plan.yaml"));
}

TEST_F(PlanProgram, AnObjectsFileSaysHowItsMeshIsTaken) {
  for (const char* name : {"sheet.obj", "cup.obj"}) scratch_.file(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto file = scratch_.file("d.yaml", fmt::format(R"(seed: 1
sensors: {{sensor: {0}/configs/sensors/mctac.yaml, mesh: {0}/configs/gels/tiny.yaml}}
objects:
  - {{meshes: sheet.obj, unit: auto, scale: 2, sheet_thickness_mm: 0.5, height_field: {{side: -y}}}}
  - {{meshes: cup.obj, unit: mm, wrap: {{alpha_mm: 0.5}}}}
motions:
  - {{name: press, samples: 1, motion: {{kind: press, depth_mm: 0.3, steps: 1}}}}
)",
                                                        TACIPC_SOURCE_DIR));
  ASSERT_EQ(plan(file), 0) << said_;
  EXPECT_EQ(read_file(scratch_ / "set/objects/sheet/object.yaml"),
            "unit: auto\nscale: 2\nsheet_thickness_mm: 0.5\nheight_field: {side: \"-y\", spacing_mm: 0.05}\n");
  EXPECT_EQ(read_file(scratch_ / "set/objects/cup/object.yaml"), "unit: mm\nwrap: {alpha_mm: 0.5}\n");
  const std::string rules = read_file(scratch_ / "set/plan/dataset.mk");
  EXPECT_THAT(rules, testing::HasSubstr("dataset_mesh,sheet,"));
  EXPECT_THAT(rules, testing::HasSubstr("dataset_wrapped,cup,"));
}

TEST_F(PlanProgram, FaultsAreAllSaidAndNothingIsPlanned) {
  const auto file = scratch_.file("d.yaml", fmt::format(R"(seed: 1
sensors: {{sensor: {0}/configs/sensors/none.yaml, mesh: {0}/configs/gels/tiny.yaml}}
objects:
  - {{emboss: {0}/configs/objects/patterns, only: [star, sun]}}
  - {{meshes: ., unit: mm}}
  - {{emboss: {0}/configs/objects/patterns/star.yaml}}
  - {{meshes: {0}/configs, unit: mm, scale: fit, height_field: {{side: most_relief}}}}
motions:
  - {{name: a__b, samples: 1, motion: {{kind: press, depth_mm: 0.3, steps: 1}}}}
splits: {{val: 0.5, test: 0.5, test_objects: [moon]}}
outputs: {{keep: [report]}}
)",
                                                        TACIPC_SOURCE_DIR));
  EXPECT_EQ(plan(file), 2);
  for (const char* fault : {"configs/sensors/none.yaml does not exist", "has no sun", "has no meshes in it",
                            "star exists already", "fit is for one sensor", "most_relief is for one sensor",
                            "'a__b' begins or ends with an underscore", "val and test leave nothing to train on",
                            "moon is not one of the objects", "'report' is not one of press, render"})
    EXPECT_THAT(said_, testing::HasSubstr(fault));
  EXPECT_FALSE(fs::exists(scratch_ / "set/samples"));
}

TEST_F(PlanProgram, NamesThatLeadElsewhereAreRefused) {
  for (const char* name : {"meshes/...stl", "meshes/..stl", "meshes/.a.stl"}) scratch_.file(name, "solid\nendsolid\n");
  const auto file = scratch_.file("d.yaml", fmt::format(R"(seed: 1
sensors: {{sensor: {0}/configs/sensors/mctac.yaml, mesh: {0}/configs/gels/tiny.yaml}}
objects: [{{meshes: meshes, unit: mm}}]
motions: [{{name: .., samples: 1, motion: {{kind: press, depth_mm: 0.3, steps: 1}}}}]
)",
                                                        TACIPC_SOURCE_DIR));
  EXPECT_EQ(plan(file), 2);
  for (const char* name :
       {"'..': a name has", "'.': a name has", "'.a': a name has", "motions[0].name: '..': a name has"})
    EXPECT_THAT(said_, testing::HasSubstr(name));
  EXPECT_FALSE(fs::exists(scratch_ / "set/plan/plan.yaml"));
  EXPECT_FALSE(fs::exists(scratch_ / "set/samples"));
}

}  // namespace plan_program_test
}  // namespace tacipc
