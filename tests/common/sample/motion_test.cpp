// Phases: where they put the object, and what of a file they refuse.
#include "common/sample/motion.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/sample/sample_spec.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace motion_test {

using ::testing::ElementsAre;

/// An object whose reference point lies 1 mm right of the origin and 0.05 mm above the gel.
PhaseStart start_at_rest() {
  Matrix4 placed = Matrix4::Identity();
  placed(0, 3) = 1e-3;
  placed(2, 3) = 5e-5;
  return {.gel_from_object = placed,
          .placed = placed,
          .reference_m = Vector3::Zero(),
          .lowest_z_m = 5e-5,
          .start_z_m = 5e-5,
          .free = {},
          .load_n = Vector3::Zero()};
}

Phase phase_of(const std::string& text) { return config_from_text<Phase>(text, "x.yaml"); }

TEST(Goal, PressLowersTheLowestPointEvenly) {
  const Phase phase = phase_of("{kind: press, depth_mm: 0.45, steps: 5}");
  EXPECT_NEAR(goal_of(phase, 1, start_at_rest(), 0.01).gel_from_object(2, 3), -5e-5, 1e-18);
  EXPECT_NEAR(goal_of(phase, 5, start_at_rest(), 0.01).gel_from_object(2, 3), -4.5e-4, 1e-18);
  EXPECT_EQ(goal_of(phase, 5, start_at_rest(), 0.01).duration_s, 0.01);
  EXPECT_EQ(goal_of(phase, 5, start_at_rest(), 0.01).gel_from_object(0, 3), 1e-3);
}

TEST(Goal, ShearFollowsItsDirection) {
  const Phase phase = phase_of("{kind: shear, distance_mm: 2, direction_deg: 90, steps: 4, substeps: 2}");
  EXPECT_EQ(time_steps(phase), 8);
  const Goal goal = goal_of(phase, 4, start_at_rest(), 0.01);
  EXPECT_NEAR(goal.gel_from_object(0, 3), 1e-3, 1e-18);
  EXPECT_NEAR(goal.gel_from_object(1, 3), 1e-3, 1e-18);
  EXPECT_EQ(goal.gel_from_object(2, 3), 5e-5);
}

TEST(Goal, TwistTurnsAboutTheReferencePoint) {
  const Phase phase = phase_of("{kind: twist, angle_deg: 90, steps: 2}");
  const Matrix4 half = goal_of(phase, 1, start_at_rest(), 0.01).gel_from_object;
  EXPECT_NEAR(half(0, 0), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(half(1, 0), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(half(0, 3), 1e-3, 1e-18);  // the point itself stays
  EXPECT_EQ(half(2, 3), 5e-5);
}

TEST(Goal, TiltLeansTheTopTowardsItsDirection) {
  const Phase phase = phase_of("{kind: tilt, angle_deg: 10, direction_deg: 90, steps: 1}");
  const Matrix4 pose = goal_of(phase, 1, start_at_rest(), 0.01).gel_from_object;
  const Vector3 up = pose.topLeftCorner<3, 3>() * Vector3::UnitZ();
  EXPECT_NEAR(up.y(), std::sin(10 * std::numbers::pi / 180), 1e-15);
  EXPECT_NEAR(up.x(), 0.0, 1e-16);
  EXPECT_NEAR(pose(2, 3), 5e-5, 1e-18);
}

TEST(Goal, ReleaseGoesBackToTheHeightOfFrame0) {
  PhaseStart start = start_at_rest();
  start.gel_from_object(2, 3) = start.lowest_z_m = -4e-4;
  const Phase phase = phase_of("{kind: release, steps: 3}");
  EXPECT_NEAR(goal_of(phase, 3, start, 0.01).gel_from_object(2, 3), 5e-5, 1e-18);
  EXPECT_NEAR(goal_of(phase_of("{kind: release, height_mm: 1, steps: 3}"), 3, start, 0.01).gel_from_object(2, 3), 1e-3,
              1e-18);
}

TEST(Goal, LoadsRampAndAreHeldUntilAPressOrARelease) {
  const Phase press = phase_of("{kind: press, force_n: 4, steps: 8}");
  PhaseStart start = start_at_rest();
  Goal goal = goal_of(press, 2, start, 0.01);
  EXPECT_EQ(goal.load_n, Vector3(0, 0, -1));
  EXPECT_EQ(goal.free, (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(goal.gel_from_object, start.gel_from_object);
  start.load_n = Vector3(0, 0, -4);
  start.free = {false, false, true};
  goal = goal_of(phase_of("{kind: shear, distance_mm: 1, steps: 2}"), 1, start, 0.01);
  EXPECT_EQ(goal.load_n, Vector3(0, 0, -4));
  EXPECT_TRUE(goal.free[2]);
  goal = goal_of(phase_of("{kind: release, steps: 2}"), 1, start, 0.01);
  EXPECT_FALSE(goal.free[2]);
  EXPECT_EQ(goal.load_n, Vector3::Zero());
  // A load along the plane: shear takes the plane over again.
  start.free = {true, true, true};
  start.load_n = Vector3(0.1, 0, -4);
  goal = goal_of(phase_of("{kind: shear, distance_mm: 1, steps: 2}"), 1, start, 0.01);
  EXPECT_EQ(goal.free, (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(goal.load_n, Vector3(0, 0, -4));
}

class Path : public ::testing::Test {
 protected:
  Phase read(const std::string& rows, const std::string& more = "") {
    scratch_.file("path.csv", rows);
    return read_config<Phase>(scratch_.file("motion.yaml", "{kind: path, file: path.csv" + more + "}"));
  }
  std::string refusal(const std::string& rows) {
    try {
      read(rows);
    } catch (const DataError& error) {
      const std::string text = error.what();
      return text.substr(text.find("path.csv"));
    }
    return "accepted";
  }
  ScratchFolder scratch_;
};

TEST_F(Path, FollowsItsRowsWithTheirTimes) {
  const Phase phase = read(
      "t,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n0.02,0.001,0,-0.0001,0,0,0,1\n"
      "0.05,0.001,0,-0.0001,0,0,0.70710678118,0.70710678118\n",
      ", substeps: 2");
  EXPECT_EQ(phase.steps, 2);
  const PhaseStart start = start_at_rest();
  Goal goal = goal_of(phase, 1, start, 0.01);
  EXPECT_DOUBLE_EQ(goal.duration_s, 0.01);
  EXPECT_NEAR(goal.gel_from_object(0, 3), 1.5e-3, 1e-15);
  EXPECT_NEAR(goal.gel_from_object(2, 3), 0.0, 1e-15);
  goal = goal_of(phase, 4, start, 0.01);
  EXPECT_DOUBLE_EQ(goal.duration_s, 0.015);
  EXPECT_NEAR(goal.gel_from_object(1, 0), 1.0, 1e-9);    // a quarter turn …
  EXPECT_NEAR(goal.gel_from_object(0, 3), 2e-3, 1e-12);  // … about the reference point
}

TEST_F(Path, AbsoluteRowsAreGelFromObject) {
  const Phase phase = read("0,0,0,0.001,0,0,0,1\n0.01,0.002,0,0.0005,0,0,0,1\n", ", relative_to: sensor");
  const Goal goal = goal_of(phase, 1, start_at_rest(), 0.01);
  EXPECT_NEAR(goal.gel_from_object(0, 3), 2e-3, 1e-18);
  EXPECT_NEAR(goal.gel_from_object(2, 3), 5e-4, 1e-18);
}

TEST_F(Path, NamesTheLineThatIsWrong) {
  EXPECT_EQ(refusal("t,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n1,0,0,oops,0,0,0,1\n"),
            "path.csv:3: expected the eight numbers t,x,y,z,qx,qy,qz,qw");
  EXPECT_EQ(refusal("0,0,0,0,0,0,0,1\n1,0,0,0,0,0,0\n"), "path.csv:2: expected the eight numbers t,x,y,z,qx,qy,qz,qw");
  EXPECT_EQ(refusal("0,0,0,0,0,0,0,2\n"), "path.csv:1: the quaternion has length 2, expected 1");
  EXPECT_EQ(refusal("0,0,0,0,0,0,0,1\n0,0,0,0,0,0,0,1\n"), "path.csv:2: times must start at 0 and ascend");
  EXPECT_EQ(refusal("1,0,0,0,0,0,0,1\n"), "path.csv:1: times must start at 0 and ascend");
  EXPECT_EQ(refusal("0,0,0,0,0,0,0,1\n"), "path.csv: a path needs at least two rows");
}

TEST(SampleSpec, FaultsOfPhasesAreNamedTogether) {
  const auto faults = faults_in<SampleSpec>(
      "motion:\n  - {kind: press, force_n: 4, depth_mm: 1, steps: 5}\n  - {kind: twist, angle: 5, steps: 5}\n"
      "  - {kind: load, force_n: [0, 0, -1], free: zw, steps: 1}\n"
      "  - {kind: free, steps: 1}\n",
      "x.yaml");
  EXPECT_THAT(
      faults,
      ElementsAre("x.yaml:2:28: motion[0].force_n: a press has a depth_mm or a force_n, not both",
                  "x.yaml:2:28: motion[0].force_n: a force moves the object only if its object.density_kg_m3 is given",
                  "x.yaml:3:5: motion[1].angle_deg: missing", "x.yaml:3:19: motion[1].angle: unknown key",
                  "x.yaml:4:27: motion[2].force_n: a force moves the object only if its object.density_kg_m3 is given",
                  "x.yaml:4:45: motion[2].free: 'zw' is not made of the letters x, y, z",
                  "x.yaml:5:12: motion[3].kind: the object is free only if its object.density_kg_m3 is given"));
}

}  // namespace motion_test
}  // namespace tacipc
