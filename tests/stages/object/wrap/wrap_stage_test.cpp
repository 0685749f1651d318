// The program as a user runs it.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/program_test.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace wrap_stage_test {

using ::testing::HasSubstr;

class WrapStage : public ProgramTest {
 protected:
  /// A box of 1 inch without its lid.
  WrapStage() {
    const TriangleMesh box = make_box(Vector3::Zero(), Vector3(1, 0.6, 0.4));
    write_ply(mesh_, without_faces(box, {2, 3}));
  }
  int wrap(const std::string& object, const std::string& out, const std::string& threads = "1") {
    const auto file = scratch_.file("object.yaml", object);
    return run_command(fmt::format("{}/wrap --mesh {} --object {} --out {} --threads {}", TACIPC_BIN_DIR,
                                   mesh_.string(), file.string(), (scratch_ / out).string(), threads));
  }
  int decimate(const std::string& mesh, const std::string& object) {
    return run_command(fmt::format(
        "{}/decimate --config {}/configs/objects/decimate/default.yaml --mesh {} --object {} --out {}", TACIPC_BIN_DIR,
        TACIPC_SOURCE_DIR, (scratch_ / mesh).string(), (scratch_ / object).string(), (scratch_ / "small").string()));
  }

  std::filesystem::path mesh_ = scratch_ / "box.ply";
};

TEST_F(WrapStage, DecimateTakesWhatItMade) {
  ASSERT_EQ(wrap("{unit: in, up: +z, scale: 0.5, wrap: {alpha_mm: 1}}", "made"), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("lengths are in in (object file)"));
  EXPECT_THAT(said_, HasSubstr("the mesh is replaced by a surface wrapped around it"));
  const std::string record = read_file(scratch_ / "made/wrap.yaml");
  for (const char* line : {"unit: in\n", "scale: 0.5\n", "alpha_mm: 1\n", "wrap_to_mesh_mm:", "seen_mesh_to_wrap_mm:"})
    EXPECT_THAT(record, HasSubstr(line));
  EXPECT_EQ(read_file(scratch_ / "made/object.yaml"), "unit: m\nup: \"+z\"\n");
  const Positions p = read_triangle_mesh(scratch_ / "made/object.ply", 1.0).positions;
  EXPECT_NEAR(p.col(0).maxCoeff() - p.col(0).minCoeff(), 12.7e-3 + 2e-3 / 15, 5e-5);
  ASSERT_EQ(decimate("made/object.ply", "made/object.yaml"), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("decimate: nothing to repair\n"));
  EXPECT_EQ(decimate("box.ply", "object.yaml"), 2);
  EXPECT_THAT(said_, HasSubstr("object.yaml: wrap: is for the stage wrap"));
}

TEST_F(WrapStage, WritesTheSameBytesEveryTime) {
  // A regular body has many places that are equally good for the next point.
  ASSERT_EQ(wrap("{unit: in, wrap: {relative_alpha: 0.02}}", "one"), 0) << said_;
  for (const char* again : {"1", "2"}) {
    ASSERT_EQ(wrap("{unit: in, wrap: {relative_alpha: 0.02}}", "other", again), 0) << said_;
    for (const char* file : {"object.ply", "object.yaml", "wrap.yaml"})
      EXPECT_EQ(read_file(scratch_ / "one" / file), read_file(scratch_ / "other" / file)) << file;
  }
}

TEST_F(WrapStage, SaysWhereAlphaIsWrong) {
  const auto refused = [&](const std::string& text, const std::string& message) {
    EXPECT_EQ(wrap(text, "made"), 2) << text;
    EXPECT_THAT(said_, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "made/wrap.yaml"));
  };
  refused("unit: mm\nwrap: {alpha_mm: -1}\n", "object.yaml:2:18: wrap.alpha_mm: -1 is outside (0, inf)");
  refused("unit: mm\nwrap: {relative_alpha: 2}\n", "object.yaml:2:24: wrap.relative_alpha: 2 is outside [0.0005, 0.5]");
  refused("unit: mm\nwrap: {alpha: 1}\n", "object.yaml:2:8: wrap.alpha: unknown key");
  refused("unit: mm\nwrap: yes\n", "object.yaml:2:7: wrap: expected a map");
  EXPECT_EQ(wrap("{unit: m, wrap: {alpha_mm: 0.01}}", "made"), 1);
  EXPECT_THAT(said_, HasSubstr("box.ply: wrap.alpha_mm: 0.01 mm for a mesh of 1233 mm from corner to corner"));
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "made/wrap.failed.yaml"));
}

}  // namespace wrap_stage_test
}  // namespace tacipc
