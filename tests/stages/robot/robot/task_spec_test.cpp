#include "stages/robot/robot/task_spec.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/config_text.h"

namespace tacipc {
namespace task_spec_test {

using ::testing::Contains;
using ::testing::ElementsAre;

const std::string kBegin =
    "model: m.xml\npads: {name: left, geom: pad}\nobjects: {name: cup, mesh: cup.ply, mass_g: 20}\n";
const std::string kSteps = "steps: {seconds: 1}\n";

TaskSpec read(const std::string& text) { return config_from_text<TaskSpec>(text, "tasks/t.yaml"); }
std::vector<std::string> faults(const std::string& text) { return faults_in<TaskSpec>(text, "tasks/t.yaml"); }

TEST(TaskSpec, EveryValueIsInSiAndFilesStandBesideTheTask) {
  const TaskSpec task = read(
      "variables: {a: 1}\n"
      "model: robots/m.xml\n"
      "frame_s: 0.02\n"
      "pads:\n"
      "  - {name: left, geom: l, at_mm: [0, 0, 3.5], turn_deg: [180, 0, 0], radius_mm: 5}\n"
      "  - {name: right, geom: r}\n"
      "objects:\n"
      "  - {name: cup, mesh: cup.ply, unit: mm, mass_g: 20, at_mm: [1, 2, 3], turn_deg: [0, 0, 90], held_s: 0.3}\n"
      "  - {name: ball, mesh: ball.ply, density_kg_m3: 1000}\n"
      "  - {name: table, kind: fixed, mesh: table.ply}\n"
      "contact: [{between: [left, cup], friction: 0.4, d_hat_mm: 0.01}]\n"
      "coupling: {window_frames: 3, tolerance: 0.01, most_tries: 7, stiffness_n_m: 5000, smallest_wrench_n: 0.1, "
      "position_tolerance_um: 2}\n"
      "steps:\n"
      "  - {seconds: 0.5, set: {a: 0.1, b: -2}, limit: {a: 3}, smooth: false, until: {pad: right, force_n: 2}}\n"
      "  - {seconds: 1, move: {site: hand, by_mm: [1, 2, 3], turn_deg: [0, 90, 0]}, until: {site: hand, above_mm: 4}}\n"
      "  - {seconds: 1, move: {site: hand, to_mm: [4, 5, 6]}}\n"
      "  - {seconds: 1, shake: {site: hand, amplitude_mm: [0, 0, 4], frequency_hz: 3}}\n");
  EXPECT_EQ(task.model, "tasks/robots/m.xml");
  EXPECT_EQ(task.frame_s, 0.02);
  ASSERT_EQ(task.pads.size(), 2u);
  EXPECT_EQ(task.pads[0].geom, "l");
  EXPECT_DOUBLE_EQ(task.pads[0].radius_m, 0.005);
  Matrix4 mount = Matrix4::Identity();
  mount.diagonal() << 1, -1, -1, 1;
  mount(2, 3) = 0.0035;
  EXPECT_LT((task.pads[0].geom_from_gel - mount).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(task.pads[1].geom_from_gel, Matrix4::Identity());
  ASSERT_EQ(task.objects.size(), 3u);
  const ObjectSpec& cup = task.objects[0];
  EXPECT_EQ(cup.mesh, "tasks/cup.ply");
  EXPECT_EQ(cup.unit, "mm");
  EXPECT_DOUBLE_EQ(cup.mass.mass_kg.value(), 0.02);
  EXPECT_LT((cup.at_m.value() - Vector3(1e-3, 2e-3, 3e-3)).norm(), 1e-15);
  EXPECT_LT((cup.turn_rad.value() - Vector3(0, 0, std::numbers::pi / 2)).norm(), 1e-15);
  EXPECT_EQ(cup.held_s, 0.3);
  EXPECT_EQ(task.objects[1].mass.density_kg_m3, 1000.0);
  EXPECT_FALSE(task.objects[1].mass.mass_kg || task.objects[1].at_m || task.objects[1].turn_rad);
  EXPECT_TRUE(task.objects[2].fixed);
  ASSERT_EQ(task.contact.size(), 1u);
  EXPECT_THAT(task.contact[0].between, ElementsAre("left", "cup"));
  EXPECT_EQ(task.contact[0].friction, 0.4);
  EXPECT_EQ(task.contact[0].d_hat_mm, 0.01);
  EXPECT_EQ(task.coupling.window_frames, 3);
  EXPECT_EQ(task.coupling.tolerance, 0.01);
  EXPECT_EQ(task.coupling.most_tries, 7);
  EXPECT_DOUBLE_EQ(task.coupling.position_tolerance_m, 2e-6);
  EXPECT_EQ(task.coupling.stiffness_n_m, 5000.0);
  EXPECT_EQ(task.coupling.smallest_wrench_n, 0.1);
  ASSERT_EQ(task.steps.size(), 4u);
  EXPECT_THAT(task.steps[0].set,
              ElementsAre(std::pair<std::string, double>("a", 0.1), std::pair<std::string, double>("b", -2.0)));
  EXPECT_THAT(task.steps[0].limit, ElementsAre(std::pair<std::string, double>("a", 3.0)));
  EXPECT_FALSE(task.steps[0].smooth);
  EXPECT_EQ(task.steps[0].until.value().pad, "right");
  EXPECT_EQ(task.steps[0].until.value().force_n, 2.0);
  EXPECT_TRUE(task.steps[1].smooth);
  EXPECT_LT((task.steps[1].by_m - Vector3(1e-3, 2e-3, 3e-3)).norm(), 1e-15);
  EXPECT_LT((task.steps[1].turn_rad - Vector3(0, std::numbers::pi / 2, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(task.steps[1].until.value().above_m.value(), 0.004);
  EXPECT_FALSE(task.steps[1].to_m);
  EXPECT_LT((task.steps[2].to_m.value() - Vector3(4e-3, 5e-3, 6e-3)).norm(), 1e-15);
  EXPECT_EQ(task.steps[3].site, "hand");
  EXPECT_LT((task.steps[3].shake_m - Vector3(0, 0, 4e-3)).norm(), 1e-15);
  EXPECT_EQ(task.steps[3].frequency_hz, 3.0);
}

TEST(TaskSpec, WhatIsMissingIsSaid) {
  EXPECT_THAT(faults("frame_s: 0.01\n"),
              ElementsAre("tasks/t.yaml:1:1: model: missing", "tasks/t.yaml:1:1: pads: missing",
                          "tasks/t.yaml:1:1: objects: missing", "tasks/t.yaml:1:1: steps: missing"));
}

TEST(TaskSpec, BodiesThatTouchAreAmongItsOwn) {
  EXPECT_THAT(faults(kBegin + "contact: [{between: [left, mug]}]\n" + kSteps),
              Contains("tasks/t.yaml:4:28: contact[0].between[1]: 'mug' is not one of left, cup (did you mean cup?)"));
}

struct Fault {
  const char* text;
  const char* message;
};

class TaskFault : public testing::TestWithParam<Fault> {};

TEST_P(TaskFault, IsSaidOnceWithItsPlace) { EXPECT_THAT(faults(GetParam().text), ElementsAre(GetParam().message)); }

// Lines are counted from the first of each text.
#define PADS "pads: {name: left, geom: pad}\n"
#define CUP "objects: {name: cup, mesh: cup.ply, mass_g: 20}\n"
#define STEPS "steps: {seconds: 1}\n"
INSTANTIATE_TEST_SUITE_P(
    All, TaskFault,
    testing::Values(
        Fault{"model: m\nframe_s: 0\n" PADS CUP STEPS, "tasks/t.yaml:2:10: frame_s: 0 is outside (0, 1]"},
        Fault{"model: m\npads: {name: a/b, geom: pad}\n" CUP STEPS,
              "tasks/t.yaml:2:14: pads.name: a name has letters, digits, _ and - alone"},
        Fault{"model: m\npads: {name: a, geom: pad, radius_mm: 0}\n" CUP STEPS,
              "tasks/t.yaml:2:39: pads.radius_mm: 0 is outside (0, inf)"},
        Fault{"model: m\npads: [{name: a, geom: p}, {name: a, geom: q}]\n" CUP STEPS,
              "tasks/t.yaml:2:35: pads[1].name: another pad or object has this name"},
        Fault{"model: m\n" PADS "objects: {name: left, mesh: c, mass_g: 1}\n" STEPS,
              "tasks/t.yaml:3:17: objects.name: another pad or object has this name"},
        Fault{"model: m\n" PADS "objects: {name: cup, mesh: c}\n" STEPS,
              "tasks/t.yaml:3:10: objects.density_kg_m3: missing"},
        Fault{"model: m\n" PADS "objects: {name: cup, mesh: c, mass_g: 1, density_kg_m3: 2}\n" STEPS,
              "tasks/t.yaml:3:57: objects.density_kg_m3: give mass_g or density_kg_m3, not both"},
        Fault{"model: m\n" PADS "objects: {name: cup, mesh: c, mass_g: 0}\n" STEPS,
              "tasks/t.yaml:3:39: objects.mass_g: 0 is outside (0, inf)"},
        Fault{"model: m\n" PADS "objects: {name: cup, mesh: c, unit: ft, mass_g: 1}\n" STEPS,
              "tasks/t.yaml:3:37: objects.unit: 'ft' is not one of m, cm, mm, um, in (did you mean m?)"},
        Fault{"model: m\n" PADS "objects: {name: cup, kind: fixed, mesh: c, mass_g: 1}\n" STEPS,
              "tasks/t.yaml:3:44: objects.mass_g: unknown key"},
        Fault{"model: m\n" PADS CUP "contact: [{between: [left]}]\n" STEPS,
              "tasks/t.yaml:4:21: contact[0].between: expected the names of two pads or objects"},
        Fault{"model: m\n" PADS CUP "contact: [{between: [cup, cup]}]\n" STEPS,
              "tasks/t.yaml:4:27: contact[0].between[1]: cup is given twice"},
        Fault{"model: m\n" PADS CUP "contact: [{between: [left, cup], friction: -1}]\n" STEPS,
              "tasks/t.yaml:4:44: contact[0].friction: -1 is outside [0, inf)"},
        Fault{"model: m\n" PADS CUP "coupling: {most_tries: 1}\n" STEPS,
              "tasks/t.yaml:4:24: coupling.most_tries: 1 is outside [2, 100]"},
        Fault{"model: m\n" PADS CUP "coupling: {tolerance: 0.2}\n" STEPS,
              "tasks/t.yaml:4:23: coupling.tolerance: 0.2 is outside (0, 0.1]"},
        Fault{"model: m\n" PADS CUP "steps: {seconds: 0}\n",
              "tasks/t.yaml:4:18: steps.seconds: 0 is outside (0, 1000]"},
        Fault{"model: m\n" PADS CUP "steps: {seconds: 1, limit: {a: 0}}\n",
              "tasks/t.yaml:4:32: steps.limit.a: 0 is outside (0, inf)"},
        Fault{"model: m\n" PADS CUP "steps: {seconds: 1, move: {site: a, by_mm: [1, 2, 3], to_mm: [1, 2, 3]}}\n",
              "tasks/t.yaml:4:44: steps.move.by_mm: give by_mm or to_mm, not both"},
        Fault{"model: m\n" PADS CUP
              "steps: {seconds: 1, move: {site: a}, shake: {site: b, amplitude_mm: [1, 2, 3], frequency_hz: 1}}\n",
              "tasks/t.yaml:4:52: steps.shake.site: a step moves or shakes, not both"},
        Fault{"model: m\n" PADS CUP "steps: {seconds: 1, until: {pad: right, force_n: 1}}\n",
              "tasks/t.yaml:4:34: steps.until.pad: 'right' is not one of left"},
        Fault{"model: m\n" PADS CUP "steps: {seconds: 1, until: {site: a}}\n",
              "tasks/t.yaml:4:35: steps.until.site: give its height as above_mm or as below_mm"},
        Fault{"model: m\n" PADS CUP "steps: {seconds: 1, until: {site: a, above_mm: 1, below_mm: 2}}\n",
              "tasks/t.yaml:4:35: steps.until.site: give its height as above_mm or as below_mm"},
        Fault{"model: m\n" PADS CUP "steps: {seconds: 1, moves: {site: a}}\n",
              "tasks/t.yaml:4:21: steps.moves: unknown key (did you mean move?)"}));

}  // namespace task_spec_test
}  // namespace tacipc
