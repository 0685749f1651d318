// A world that no drive moves: what its verdict sees, and what its records say of contact.
#include "stages/gel/press/world/world.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/make_mesh.h"
#include "tests/scratch_folder.h"
#include "tests/stages/gel/press/reference_scene.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace world_test {

using ::testing::HasSubstr;

Body gel_body(const std::string& name) {
  return {.name = name, .tets = block_gel(6, 0.02, 0.004), .material = paper_sensor().material};
}

Body box_body(const std::string& name, const Vector3& low, const Vector3& high, bool closed = true) {
  return {.name = name, .surface = make_box(low, high), .closed = closed};
}

/// The verdict on frame 0 of a gel and an object at rest.
std::string verdict(const Body& object, bool mounts_move) {
  World world(paper_sensor(), friction_config(0.5), {gel_body("gel"), object}, {.mounts_move = mounts_move});
  try {
    std::vector<Frame> frames = world.measure(PhaseKind::reference, -1, {});
    world.judge(0, frames);
  } catch (const VerdictError& error) {
    return error.miss().check + ": " + error.what();
  }
  return "pass";
}

/// A press and a scene see the world with mounts that rest and with mounts that may move.
TEST(World, AnObjectInsideTheGelFailsWhoeverDrivesIt) {
  const Body inside = box_body("seed", {-1e-4, -1e-4, -2.1e-3}, {1e-4, 1e-4, -1.9e-3}),
             open_inside = box_body("seed", {-1e-4, -1e-4, -2.1e-3}, {1e-4, 1e-4, -1.9e-3}, false),
             around = box_body("shell", {-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}),
             apart = box_body("box", {-1e-3, -1e-3, 1e-3}, {1e-3, 1e-3, 2e-3});
  for (const bool mounts_move : {false, true}) {
    EXPECT_EQ(verdict(inside, mounts_move), "containment: frame 0: seed is inside gel");
    EXPECT_EQ(verdict(open_inside, mounts_move), "containment: frame 0: seed is inside gel");
    EXPECT_EQ(verdict(around, mounts_move), "containment: frame 0: gel is inside shell");
    EXPECT_EQ(verdict(apart, mounts_move), "pass");
  }
}

TEST(World, AGelsSimulationHasTheContactOfItsPair) {
  Body block = box_body("block", {-1e-3, -1e-3, 1e-3}, {1e-3, 1e-3, 2e-3});
  Body left = gel_body("left"), right = gel_body("right");
  right.start(2, 3) = -0.1;
  const World world(paper_sensor(), friction_config(0.5), {left, right, block},
                    {.pairs = PairContact{.gel_friction = 0.7,
                                          .pairs = {{.between = {0, 2}, .friction = 0.9, .d_hat_m = 5e-6},
                                                    {.between = {2, 1}, .friction = 0.1}}}});
  EXPECT_EQ(world.simulation_of(0).friction, 0.9);
  EXPECT_EQ(world.simulation_of(0).d_hat_m, 5e-6);
  EXPECT_EQ(world.simulation_of(1).friction, 0.1);
  EXPECT_EQ(world.simulation_of(1).d_hat_m, world.scales().d_hat_m);
  EXPECT_EQ(world.laws().of(0, 1).friction, 0.7);
}

TEST(World, BodiesThatTouchInFrameZeroAreNamed) {
  const World world(paper_sensor(), friction_config(0.5),
                    {gel_body("gel"), box_body("box", {-1e-3, -1e-3, 1e-6}, {1e-3, 1e-3, 1e-3})}, {});
  EXPECT_THAT(message_of<DataError>([&] { world.require_apart(); }),
              HasSubstr("bodies gel and box are 0.001 mm apart"));
}

}  // namespace world_test
}  // namespace tacipc
