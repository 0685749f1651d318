// The same claims for every energy term, and a value of each by hand.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <random>

#include "stages/gel/press/energy/averaged_elasticity.h"
#include "stages/gel/press/energy/axis_springs.h"
#include "stages/gel/press/energy/barrier.h"
#include "stages/gel/press/energy/contact_barrier.h"
#include "stages/gel/press/energy/dirichlet.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/energy/friction.h"
#include "stages/gel/press/energy/inertia.h"
#include "stages/gel/press/energy/linear_load.h"
#include "stages/gel/press/energy/orthogonality.h"
#include "stages/gel/press/energy/stiffness_damping.h"
#include "stages/gel/press/energy/viscous_memory.h"
#include "stages/gel/press/solve/assembly.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/convergence_order.h"
#include "tests/stages/gel/press/elastic_block.h"

namespace tacipc {
namespace energy_term_test {

/// A term with one stencil at a given place.
struct Case {
  std::string name;
  std::shared_ptr<EnergyTerm> term;
  Eigen::VectorXd x;
  double step;  // first step of the differences
  bool translation_invariant;
  bool rotation_invariant;
  bool quadratic = false;  // differences are exact
};

Positions rows(const Vector12& x) { return Eigen::Map<const Positions>(x.data(), 4, 3); }

/// The tetrahedron with three edges of length 1 along the axes.
RestBody unit_body() {
  const Tetrahedra tets{{0, 1, 2, 3}};
  return {tets, make_rest_tets(Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, tets)};
}

Case tet_case(const std::string& name, const ElasticLaw& law, double squeeze) {
  Vector12 rest;
  rest << 0, 0, 0, 1, 0.1, 0, 0.2, 0.9, 0, 0.1, 0.2, 1.1;
  Vector12 x = rest;
  for (int i = 0; i < 4; ++i) {
    x[3 * i + 2] *= squeeze;
    x[3 * i] += 0.3 * rest[3 * i + 1];
    x[3 * i + 1] += 0.1 * rest[3 * i + 2];
  }
  return {name, std::make_shared<Elasticity>(rows(rest), Tetrahedra{{0, 1, 2, 3}}, law), x, 1e-3, true, true};
}

/// The six tetrahedra of a cube as one cluster, each deformed differently.
Case cluster_case(const std::string& name, const ElasticLaw& law, double squeeze) {
  const Block block = make_block(Vector3::Ones(), {1, 1, 1}, 0.0);
  Positions x = block.rest;
  x.col(2) *= squeeze;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double t = static_cast<double>(v);
    x.row(v) += 0.08 * Vector3(std::sin(3.0 * t), std::cos(5.0 * t), std::sin(2.0 + t)).transpose();
  }
  return {name,
          std::make_shared<AveragedElasticity>(block.rest, block.tets, law, TetClusters{{0, 1, 2, 3, 4, 5}}),
          x.reshaped<Eigen::RowMajor>(),
          1e-3,
          true,
          true};
}

/// A box turned, sheared and squeezed along its height.
Case orthogonality_case(const std::string& name, double squeeze) {
  const TriangleMesh box = make_box(Vector3::Zero(), {1.5, 1.0, 0.8});
  const AffineBody body = make_affine_body(box.positions, box.triangles, 1.0);
  Matrix3 A = Vector3(1.1, 0.9, squeeze).asDiagonal();
  A(0, 1) = 0.2;
  A = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()) * A;
  const ControlPoints x = body.rest_m * A.transpose();
  return {name, std::make_shared<Orthogonality>(0, body, 2.0), x.reshaped<Eigen::RowMajor>(), 1e-3, true, true};
}

Case pair_case(const std::string& name, ContactPair::Kind kind, const Vector12& x, double weight = 1.0,
               std::uint8_t shape = 0) {
  // The barrier looks its mesh up: both live as long as the case.
  struct Held {
    ContactMesh mesh;
    std::optional<ContactBarrier> barrier;
  };
  const auto held = std::make_shared<Held>();
  held->mesh.num_gel_vertices = 0;  // everything belongs to the object, so d̂ is not cut by the distance at rest
  held->mesh.num_object_vertices = 4;
  held->mesh.rest_positions = rows(x);
  // Edges much longer at rest than now make the mollifier's threshold large enough to matter for the case that says so.
  if (name == "edge_edge_mollified") held->mesh.rest_positions *= 6.0;
  held->barrier.emplace(held->mesh, std::vector<ContactPair>{{kind, {0, 1, 2, 3}, weight, shape}},
                        ContactLaws({.d_hat_m = 0.5}));
  return {name, std::shared_ptr<EnergyTerm>(held, &*held->barrier), x, 1e-3, true, true};
}

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"inertia", std::make_shared<Inertia>(Eigen::VectorXd::Constant(1, 2.0), Positions{{0.1, 0.2, 0.3}}),
                 Vector3(0.3, -0.2, 0.5), 1e-3, false, false, true});
  all.push_back({"axis_springs", std::make_shared<AxisSprings>(0, Vector3(2.0, 0.0, 50.0), Vector3(0.1, 0.2, 0.3)),
                 Vector3(0.4, -0.1, 0.2), 1e-2, false, false, true});
  all.push_back({"linear_load", std::make_shared<LinearLoad>(std::vector<int>{0}, Positions{{0.1, -2.0, 0.3}}),
                 Vector3(0.3, -0.2, 0.5), 1e-3, false, false, true});
  all.push_back(
      {"dirichlet",
       std::make_shared<Dirichlet>(std::vector<int>{0}, Positions{{0.1, -2.0, 0.3}}, Positions{{4.0, 1.0, -2.0}}, 3.0),
       Vector3(0.3, -0.2, 0.5), 1e-3, false, false, true});
  Vector12 x;
  for (const double squeeze : {0.4, 1.9}) {
    const std::string how = squeeze < 1.0 ? "pressed" : "stretched";
    all.push_back(tet_case("neo_hookean_" + how, NeoHookean{2.0, 7.0}, squeeze));
    all.push_back(tet_case("stvk_hencky_" + how, StvkHencky{2.0, 7.0}, squeeze));
    all.push_back(cluster_case("averaged_neo_hookean_" + how, NeoHookean{2.0, 7.0}, squeeze));
    all.push_back(cluster_case("averaged_stvk_hencky_" + how, StvkHencky{2.0, 7.0}, squeeze));
  }
  for (const Case& body : std::vector<Case>(all.end() - 2, all.end())) {
    const auto start = Eigen::Map<const Positions>(body.x.data(), body.x.size() / 3, 3);
    all.push_back({"damped_" + body.name, std::make_shared<StiffnessDamping>(body.term, start), 1.1 * body.x, 1e-3,
                   true, false, true});
  }
  all.push_back(orthogonality_case("orthogonality_pressed", 0.5));
  all.push_back(orthogonality_case("orthogonality_stretched", 1.4));
  for (const double push : {0.0, 8.0}) {
    Case memory = tet_case(push > 0.0 ? "viscous_memory_pushes" : "viscous_memory", NeoHookean{2.0, 7.0}, 0.4);
    memory.term = std::make_shared<ViscousMemory>(std::make_shared<RestBody>(unit_body()),
                                                  SymmetricRows{{3.0 - push, 2.0, 1.0 - push, 0.3, -0.5, 0.7}});
    memory.quadratic = true;
    all.push_back(memory);
  }
  using Kind = ContactPair::Kind;
  x << 0.25, 0.22, 0.3, 0, 0, 0.02, 1, 0, -0.03, 0, 1, 0.01;
  all.push_back(pair_case("point_triangle_inside", Kind::point_triangle, x));
  all.push_back(pair_case("point_triangle_taken_back", Kind::point_triangle, x, -1.0));
  x << 0.45, -0.2, 0.25, 0, 0, 0, 1, 0, 0, 0, 1, 0;
  all.push_back(pair_case("point_triangle_edge", Kind::point_triangle, x));
  x << -0.1, -0.2, 0.25, 0, 0, 0, 1, 0, 0, 0, 1, 0;
  all.push_back(pair_case("point_triangle_corner", Kind::point_triangle, x));
  x << -0.5, 0.1, 0, 0.5, -0.1, 0, 0.05, -0.5, 0.3, 0, 0.5, 0.25;
  all.push_back(pair_case("edge_edge_inside", Kind::edge_edge, x));
  all.push_back(pair_case("edge_edge_weighted", Kind::edge_edge, x, 0.02));
  x << -0.5, 0.1, 0, 0.5, -0.1, 0, 0.1, 0.2, 0.2, 0.3, 0.9, 0.25;
  all.push_back(pair_case("edge_edge_end", Kind::edge_edge, x));
  x << -0.5, 0, 0, 0.5, 0.02, 0, -0.45, -0.1, 0.3, 0.55, 0.3, 0.27;
  all.push_back(pair_case("edge_edge_mollified", Kind::edge_edge, x));
  x << 0.25, 0.22, 0.3, 0, 0, 0.02, 1, 0, -0.03, 0, 1, 0.01;
  all.push_back(pair_case("corner_above_face", Kind::point_triangle, x, 1.0, kIsShape));
  x << 0.45, -0.2, 0.25, 0, 0, 0, 1, 0, 0, 0, 1, 0;
  all.push_back(pair_case("corner_beside_face", Kind::point_triangle, x, 1.0, kIsShape | rim_edge(0)));
  for (const double epsilon : {0.5, 0.02}) {
    x << 0.25, 0.22, 0.3, 0, 0, 0.02, 1, 0, -0.03, 0, 1, 0.01;
    const auto start = Eigen::Map<const Positions>(x.data(), 4, 3);
    ContactMesh mesh;
    mesh.num_object_vertices = 4;
    mesh.rest_positions = start;
    const ContactBarrier barrier(mesh, {{Kind::point_triangle, {0, 1, 2, 3}}}, ContactLaws({.d_hat_m = 0.5}));
    Vector12 moved = x;
    moved[0] += 0.1;
    moved[4] -= 0.15;
    all.push_back({epsilon > 0.1 ? "friction_sticks" : "friction_slips",
                   std::make_shared<Friction>(barrier, start, start, epsilon), moved, 1e-3, true, false, false});
  }
  return all;
}

class TermTest : public ::testing::TestWithParam<Case> {
 protected:
  Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(GetParam().term->stencil(0).size()); }
  Local at(const Eigen::VectorXd& x, Order order) const {
    Local local;
    GetParam().term->evaluate(0, x, order, local);
    return local;
  }
  /// As long as the stencil's coordinates, without a pattern in it.
  Eigen::VectorXd direction() const {
    Eigen::VectorXd d(size());
    for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::sin(1.0 + 2.3 * static_cast<double>(i));
    return d;
  }
};

TEST_P(TermTest, GradientConvergesAtSecondOrder) {
  const Eigen::VectorXd x = GetParam().x, d = direction();
  const double exact = at(x, Order::gradient).gradient.dot(d);
  const auto error = [&](double h) {
    return std::abs((at(x + h * d, Order::value).value - at(x - h * d, Order::value).value) / (2 * h) - exact);
  };
  if (GetParam().quadratic) {
    EXPECT_LT(error(1e-3), 1e-11 * (1.0 + std::abs(exact)));
  } else {
    EXPECT_NEAR(convergence_order(error, 4 * GetParam().step), 2.0, 0.1);
  }
}

TEST_P(TermTest, HessianConvergesAtSecondOrder) {
  const Eigen::VectorXd x = GetParam().x, d = direction();
  const Eigen::VectorXd exact = at(x, Order::hessian).hessian * d;
  const auto error = [&](double h) {
    const Eigen::VectorXd difference =
        (at(x + h * d, Order::gradient).gradient - at(x - h * d, Order::gradient).gradient) / (2 * h);
    return (difference - exact).norm();
  };
  if (GetParam().quadratic) {
    EXPECT_LT(error(1e-3), 1e-11 * (1.0 + exact.norm()));
  } else {
    EXPECT_NEAR(convergence_order(error, 4 * GetParam().step), 2.0, 0.1);
  }
}

TEST_P(TermTest, HessianIsSymmetricAndItsStandInHasNoNegativeEigenvalue) {
  const Local exact = at(GetParam().x, Order::hessian), psd = at(GetParam().x, Order::psd);
  const Eigen::MatrixXd &H = exact.hessian, &P = psd.hessian;
  ASSERT_EQ(H.rows(), size());
  ASSERT_EQ(P.rows(), size());
  EXPECT_LE((H - H.transpose()).norm(), 1e-12 * H.norm());
  EXPECT_LE((P - P.transpose()).norm(), 1e-12 * P.norm());
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(P).eigenvalues()[0], -1e-10 * P.norm());
  EXPECT_EQ(exact.value, psd.value);
  EXPECT_TRUE(exact.gradient == psd.gradient);
}

TEST_P(TermTest, NoNetForceAndNoNetTorque) {
  const Case& c = GetParam();
  const Local local = at(c.x, Order::gradient);
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
  for (int i = 0; i < size() / 3; ++i) {
    const Vector3 f = local.gradient.segment<3>(3 * i), arm = c.x.segment<3>(3 * i);
    force += f;
    torque += arm.cross(f);
  }
  const double scale = local.gradient.norm();
  EXPECT_TRUE(!c.translation_invariant || force.norm() < 1e-12 * scale) << force.transpose();
  EXPECT_TRUE(!c.rotation_invariant || torque.norm() < 1e-12 * scale) << torque.transpose();
}

INSTANTIATE_TEST_SUITE_P(Terms, TermTest, ::testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

TEST(Inertia, ValueByHand) {
  Local local;
  Inertia(Eigen::VectorXd::Constant(1, 4.0), Positions::Zero(1, 3)).evaluate(0, Vector3(1, 2, 2), Order::value, local);
  EXPECT_EQ(local.value, 18.0);
}

TEST(LinearLoad, ValueByHandOnTheListedVertexAlone) {
  Local local;
  const LinearLoad load({7}, Positions{{1.0, 2.0, -3.0}});
  EXPECT_EQ(load.stencil(0)[0], 7);
  load.evaluate(0, Vector3(2, 1, 0.5), Order::gradient, local);
  EXPECT_EQ(local.value, -2.5);
  EXPECT_TRUE(local.gradient == Vector3(-1, -2, 3));
}

TEST(StiffnessDamping, IsTheElasticEnergyOfTheStepTakenFromRest) {
  const Positions rest{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto elasticity = std::make_shared<Elasticity>(rest, Tetrahedra{{0, 1, 2, 3}}, NeoHookean{2.0, 7.0});
  const StiffnessDamping damping(elasticity, rest);
  Eigen::VectorXd x = rest.reshaped<Eigen::RowMajor>();
  Local local;
  damping.evaluate(0, x, Order::value, local);
  EXPECT_EQ(local.value, 0.0);
  x[11] += 0.1;  // Hooke: V (μ + λ/2) ε² with ε = 0.1, V = 1/6
  damping.evaluate(0, x, Order::value, local);
  EXPECT_NEAR(local.value, 5.5 * 0.01 / 6.0, 1e-15);
  for (Eigen::Index k = 0; k < 12; ++k) x[k] = rest(k / 3, k % 3) + 0.2 * static_cast<double>(k % 3);
  damping.evaluate(0, x, Order::value, local);
  EXPECT_NEAR(local.value, 0.0, 1e-15);  // moved as a whole
}

TEST(ViscousMemory, IsStressTimesGreensStrain) {
  const ViscousMemory memory(std::make_shared<RestBody>(unit_body()), SymmetricRows{{2.0, 3.0, 5.0, 0.0, 7.0, 0.0}});
  Eigen::VectorXd x(12);
  x << 0, 0, 0, 1.2, 0, 0, 0, 1, 0, 0.5, 0, 1;  // F = [1.2 0 0.5; 0 1 0; 0 0 1]
  Local local;
  memory.evaluate(0, x, Order::value, local);
  // E_xx = 0.22, E_xz = 0.3, E_zz = 0.125.
  EXPECT_NEAR(local.value, (2.0 * 0.22 + 2.0 * 7.0 * 0.3 + 5.0 * 0.125) / 6.0, 1e-15);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  memory.evaluate(0, x, Order::value, local);
  EXPECT_EQ(local.value, 0.0);
}

TEST(Barrier, VanishesSmoothlyAtDHatAndDivergesAtContact) {
  EXPECT_EQ(barrier(1.0, 1.0), 0.0);
  EXPECT_NEAR(barrier_d1(1.0 - 1e-9, 1.0), 0.0, 1e-8);
  EXPECT_NEAR(barrier_d2(1.0 - 1e-9, 1.0), 0.0, 1e-8);
  EXPECT_TRUE(std::isinf(barrier(0.0, 1.0)));
  EXPECT_NEAR(barrier(0.5, 1.0), 0.25 * std::log(2.0), 1e-15);
}

TEST(Barrier, DerivativesConvergeAtSecondOrder) {
  for (const double s : {0.1, 0.5, 0.9}) {
    const auto first = [&](double h) {
      return std::abs((barrier(s + h, 1.0) - barrier(s - h, 1.0)) / (2 * h) - barrier_d1(s, 1.0));
    };
    const auto second = [&](double h) {
      return std::abs((barrier_d1(s + h, 1.0) - barrier_d1(s - h, 1.0)) / (2 * h) - barrier_d2(s, 1.0));
    };
    EXPECT_NEAR(convergence_order(first, 1e-2), 2.0, 0.1) << s;
    EXPECT_NEAR(convergence_order(second, 1e-2), 2.0, 0.1) << s;
  }
}

TEST(ContactBarrier, NeighboursCloserThanDHatAtRestDoNotPush) {
  ContactMesh mesh;
  mesh.num_gel_vertices = 4;
  mesh.rest_positions = Positions{{0.2, 0.2, 0.1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const ContactBarrier term(mesh, {{ContactPair::Kind::point_triangle, {0, 1, 2, 3}}}, ContactLaws({.d_hat_m = 0.5}));
  Local local;
  Eigen::VectorXd x = mesh.rest_positions.reshaped<Eigen::RowMajor>();
  term.evaluate(0, x, Order::value, local);
  EXPECT_TRUE(local.zero);
  x[2] = 0.04;  // nearer than half the distance at rest: now it does
  term.evaluate(0, x, Order::value, local);
  EXPECT_GT(local.value, 0.0);
}

TEST(Friction, PartRisesSmoothlyToOneAndItsIntegralIsTheEnergy) {
  EXPECT_EQ(friction_part(0.0, 0.1), 0.0);
  EXPECT_DOUBLE_EQ(friction_part(0.05, 0.1), 0.75);
  EXPECT_EQ(friction_part(0.1, 0.1), 1.0);
  EXPECT_EQ(friction_part(3.0, 0.1), 1.0);
  EXPECT_DOUBLE_EQ(friction_integral(0.1, 0.1), 0.1);  // the constant of the paper: f0 = y from the threshold on
  for (const double y : {0.02, 0.07, 0.3}) {
    const auto error = [&](double h) {
      return std::abs((friction_integral(y + h, 0.1) - friction_integral(y - h, 0.1)) / (2 * h) -
                      friction_part(y, 0.1));
    };
    if (y < 0.1) {
      EXPECT_NEAR(convergence_order(error, 1e-2), 2.0, 0.1) << y;
    } else {
      EXPECT_LT(error(1e-2), 1e-12);
    }
  }
}

/// A point that slides over a level triangle: the force is the barrier's on the point, times f1, against the motion.
TEST(Friction, IsTheNormalForceTimesItsPartAgainstTheMotion) {
  ContactMesh mesh;
  mesh.num_object_vertices = 4;
  mesh.rest_positions = Positions{{0.2, 0.2, 0.3}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const ContactBarrier barrier(mesh, {{ContactPair::Kind::point_triangle, {0, 1, 2, 3}}},
                               ContactLaws({.d_hat_m = 0.5}));
  Local normal, friction;
  Eigen::VectorXd x = mesh.rest_positions.reshaped<Eigen::RowMajor>();
  barrier.evaluate(0, x, Order::gradient, normal);
  const Friction term(barrier, mesh.rest_positions, mesh.rest_positions, 0.1);
  x[0] += 0.03;
  x[1] += 0.04;  // slides by 0.05, half the threshold
  x[2] += 0.01;  // rising is no sliding
  term.evaluate(0, x, Order::gradient, friction);
  const double lambda = std::abs(normal.gradient[2]);
  EXPECT_NEAR(friction.gradient[0], 0.75 * lambda * 0.6, 1e-14);
  EXPECT_NEAR(friction.gradient[1], 0.75 * lambda * 0.8, 1e-14);
  EXPECT_NEAR(friction.gradient[2], 0.0, 1e-16);
  EXPECT_NEAR(term.relative_slide(0, x.reshaped<Eigen::RowMajor>(4, 3)), 0.5, 1e-12);
}

TEST(Friction, MixtureIsTheWeightedSumAndForgetsWhatHasFaded) {
  ContactMesh mesh;
  mesh.num_object_vertices = 4;
  mesh.rest_positions = Positions{{0.2, 0.2, 0.3}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const ContactBarrier barrier(mesh, {{ContactPair::Kind::point_triangle, {0, 1, 2, 3}}},
                               ContactLaws({.d_hat_m = 0.5}));
  Positions nearer = mesh.rest_positions, x = mesh.rest_positions;
  nearer(0, 2) = 0.1;
  x(0, 0) += 0.03;
  const auto start = std::make_shared<const Friction>(barrier, mesh.rest_positions, mesh.rest_positions, 0.1);
  const Friction newer(barrier, nearer, mesh.rest_positions, 0.1);
  const auto mixed = start->mixed_with(newer, 0.25);
  ASSERT_EQ(mixed->num_stencils(), 2);
  EXPECT_DOUBLE_EQ(mixed->normal_force(0), 0.75 * start->normal_force(0));
  EXPECT_DOUBLE_EQ(mixed->normal_force(1), 0.25 * newer.normal_force(0));
  const Positions sum = 0.75 * gradient_of(*start, x) + 0.25 * gradient_of(newer, x);
  EXPECT_LT((gradient_of(*mixed, x) - sum).norm(), 1e-12 * sum.norm());
  // Halved ten times, the first friction and the first newer one are down to a thousandth and go.
  auto faded = start;
  for (int i = 0; i < 9; ++i) faded = faded->mixed_with(newer, 0.5);
  EXPECT_EQ(faded->num_stencils(), 10);
  faded = faded->mixed_with(newer, 0.5);
  EXPECT_EQ(faded->num_stencils(), 9);
}

}  // namespace energy_term_test
}  // namespace tacipc
