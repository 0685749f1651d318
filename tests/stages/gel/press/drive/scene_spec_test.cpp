#include "stages/gel/press/drive/scene_spec.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/config_text.h"

namespace tacipc {
namespace scene_spec_test {

using ::testing::Contains;
using ::testing::HasSubstr;

const std::string kBodies =
    "bodies:\n"
    "  - {name: table, kind: fixed, mesh: table.ply, unit: mm}\n"
    "  - {name: peg, kind: rigid, mesh: parts/peg.ply, mass_g: 20, at_mm: [1, 2, 3], turn_deg: [0, 0, 90],\n"
    "     velocity_mm_s: [10, 0, 0], spin_rad_s: [0, 0, 2]}\n"
    "  - {name: left, kind: gel}\n"
    "  - {name: ball, kind: soft, mesh: ball.msh, material: rubber.yaml}\n";
const std::string kMotion = "motion:\n  - {steps: 4}\n";

SceneSpec read(const std::string& text) { return config_from_text<SceneSpec>(text, "scenes/scene.yaml"); }
std::vector<std::string> faults(const std::string& text) { return faults_in<SceneSpec>(text, "scenes/scene.yaml"); }

TEST(SceneSpec, BodiesAreSortedByKindAndEveryValueIsInSi) {
  const SceneSpec spec = read("gravity_m_s2: [0, 0, -1.6]\n" + kBodies +
                              "contact:\n  - {between: [peg, table], friction: 0.3, d_hat_mm: 0.005}\n"
                              "motion:\n"
                              "  - steps: 4\n    substeps: 5\n"
                              "    move: [{body: left, by_mm: [0, 0, 2], turn_deg: [0, 30, 0], smooth: true}]\n"
                              "    hold: [peg]\n"
                              "  - steps: 2\n    load: [{body: peg, force_n: [0, 0, -3]}]\n");
  ASSERT_EQ(spec.bodies.size(), 4u);
  EXPECT_EQ(spec.bodies[0].name, "left");
  EXPECT_EQ(spec.bodies[1].name, "ball");
  EXPECT_EQ(spec.bodies[1].material, "scenes/rubber.yaml");
  const BodySpec& peg = spec.bodies[2];
  EXPECT_EQ(peg.kind, BodyKind::rigid);
  EXPECT_EQ(peg.mesh, "scenes/parts/peg.ply");
  EXPECT_EQ(peg.metres_per_unit, 1.0);
  EXPECT_EQ(spec.bodies[3].metres_per_unit, 1e-3);
  EXPECT_DOUBLE_EQ(peg.mass.mass_kg.value(), 0.02);
  Matrix4 pose;
  pose << 0, -1, 0, 1e-3, 1, 0, 0, 2e-3, 0, 0, 1, 3e-3, 0, 0, 0, 1;
  EXPECT_LT((peg.world_from_body - pose).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(peg.velocity_m_s, Vector3(0.01, 0, 0));
  EXPECT_EQ(peg.spin_rad_s, Vector3(0, 0, 2));
  EXPECT_EQ(spec.bodies[3].name, "table");
  EXPECT_EQ(spec.count(BodyKind::rigid), 1);
  EXPECT_EQ(spec.gravity_m_s2, Vector3(0, 0, -1.6));
  ASSERT_EQ(spec.contact.size(), 1u);
  EXPECT_EQ(spec.contact[0].between, (std::array{2, 3}));
  EXPECT_EQ(spec.contact[0].friction, 0.3);
  EXPECT_DOUBLE_EQ(spec.contact[0].d_hat_m.value(), 5e-6);
  ASSERT_EQ(spec.motion.size(), 2u);
  const ScenePhase& first = spec.motion[0];
  EXPECT_EQ(first.substeps, 5);
  ASSERT_EQ(first.move.size(), 1u);
  EXPECT_EQ(first.move[0].body, 0);
  EXPECT_EQ(first.move[0].way.shift_m, Vector3(0, 0, 2e-3));
  EXPECT_LT((first.move[0].way.turn_rad - Vector3(0, std::numbers::pi / 6, 0)).norm(), 1e-15);
  EXPECT_TRUE(first.move[0].smooth);
  EXPECT_EQ(first.hold, std::vector{2});
  ASSERT_EQ(spec.motion[1].load_n.size(), 1u);
  EXPECT_EQ(spec.motion[1].load_n[0], std::pair(2, Vector3(0, 0, -3)));
}

TEST(SceneSpec, EachFaultIsNamedWhereItStands) {
  EXPECT_THAT(faults("bodies: [{name: a, kind: fixed, mesh: a.ply}]\n" + kMotion),
              Contains(HasSubstr("a scene has at least one gel")));
  EXPECT_THAT(faults("bodies: [{name: a, kind: gel}, {name: a, kind: gel}]\n" + kMotion),
              Contains(HasSubstr("another body has this name")));
  EXPECT_THAT(faults("bodies: [{name: a/b, kind: gel}]\n" + kMotion), Contains(HasSubstr("letters, digits")));
  EXPECT_THAT(faults("bodies: [{name: a, kind: fixed, mesh: a.ply, unit: ft}]\n" + kMotion),
              Contains(HasSubstr("'ft' is not one of")));
  // Tetrahedra are in metres.
  EXPECT_THAT(faults("bodies: [{name: a, kind: soft, mesh: a.msh, material: a.yaml, unit: mm}]\n" + kMotion),
              Contains(HasSubstr("unit: unknown key")));
  EXPECT_THAT(faults("bodies: [{name: a, kind: gell}]\n" + kMotion), Contains(HasSubstr("gell")));
  EXPECT_THAT(faults("bodies: [{name: a, kind: rigid, mesh: a.ply, mass_g: 2, density_kg_m3: 3}]\n" + kMotion),
              Contains(HasSubstr("not both")));
  EXPECT_THAT(faults(kBodies + "motion:\n  - {steps: 1, move: [{body: table, by_mm: [0, 0, 1]}]}\n"),
              Contains(HasSubstr("gels and rigid bodies can be moved")));
  EXPECT_THAT(faults(kBodies + "motion:\n  - {steps: 1, move: [{body: pig}]}\n"), Contains(HasSubstr("peg")));
  EXPECT_THAT(faults(kBodies + "motion:\n  - {steps: 1, move: [{body: peg}], hold: [peg]}\n"),
              Contains(HasSubstr("moved or held twice")));
  EXPECT_THAT(faults(kBodies + "motion:\n  - {steps: 1, hold: [left]}\n"), Contains(HasSubstr("not a rigid body")));
  EXPECT_THAT(faults(kBodies + "motion:\n  - {steps: 1, load: [{body: ball, force_n: [0, 0, 1]}]}\n"),
              Contains(HasSubstr("a load acts on a rigid body")));
  EXPECT_THAT(faults(kBodies + "motion:\n  - {steps: 2, move: [{body: left, turn_deg: [0, 0, 24]}]}\n"),
              Contains(HasSubstr("more steps")));
  EXPECT_THAT(faults(kBodies + "contact: [{between: [peg]}]\n" + kMotion), Contains(HasSubstr("two bodies")));
}

}  // namespace scene_spec_test
}  // namespace tacipc
