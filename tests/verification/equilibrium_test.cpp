// Deformations that every mesh must reproduce exactly, for both material laws and both elements; momentum and energy.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/measure/front_surface.h"
#include "tests/verification/equilibrium.h"
#include "verification/closed_forms.h"
#include "verification/gel_shapes.h"

namespace tacipc::verify {
namespace equilibrium_test {

struct PatchCase {
  std::string law;
  Element element;
  double poissons_ratio;
};

void PrintTo(const PatchCase& c, std::ostream* out) { *out << c.law << ", nu " << c.poissons_ratio; }

std::string name_of(const ::testing::TestParamInfo<PatchCase>& info) {
  return info.param.law + (info.param.element == Element::linear ? "_linear_" : "_averaged_") +
         std::to_string(static_cast<int>(std::lround(1e4 * info.param.poissons_ratio)));
}

class PatchTest : public ::testing::TestWithParam<PatchCase> {
 protected:
  Elastic gel() const { return {1.0e5, GetParam().poissons_ratio}; }
  std::vector<WeightedTerm> elasticity(const TetMesh& mesh) const {
    const ElasticLaw law = make_elastic_law(GetParam().law, gel().shear_modulus_pa(), gel().lame_lambda_pa());
    return {{1.0, make_elasticity(mesh.positions, mesh.tets, law, GetParam().element)}};
  }
};

/// A block with its inner vertices moved about, so that no tetrahedron is like another.
TetMesh shaken_block() {
  TetMesh mesh = make_gel({BoxGel{.width_m = 4e-3,
                                  .height_m = 4e-3,
                                  .thickness_m = 3e-3,
                                  .near_m = 1e-3,
                                  .near_half_m = 2e-3,
                                  .growth = 1.0,
                                  .far_m = 1e-3,
                                  .layer_m = 1e-3,
                                  .layer_growth = 1.0}},
                          "");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.2e-3, 0.2e-3);
  std::vector<bool> outside(static_cast<std::size_t>(mesh.num_vertices()), false);
  for (Eigen::Index f = 0; f < mesh.boundary.rows(); ++f)
    for (int c = 0; c < 3; ++c) outside[mesh.boundary(f, c)] = true;
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v)
    for (int c = 0; c < 3; ++c)
      if (!outside[v]) mesh.positions(v, c) += shift(random);
  return mesh;
}

TEST_P(PatchTest, AnyUniformDeformationOfTheBoundaryIsUniformInside) {
  const TetMesh mesh = shaken_block();
  Matrix3 F;
  F << 1.05, 0.12, -0.04, 0.03, 0.94, 0.08, -0.06, 0.05, 0.98;
  std::vector<bool> fixed(static_cast<std::size_t>(3 * mesh.num_vertices()), false);
  for (Eigen::Index f = 0; f < mesh.boundary.rows(); ++f)
    for (int c = 0; c < 9; ++c) fixed[3 * mesh.boundary(f, c / 3) + c % 3] = true;
  const Positions target = mesh.positions * F.transpose();
  Positions x = target;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.02e-3, 0.02e-3);
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (!fixed[i]) x.data()[i] += shift(random);
  find_equilibrium(elasticity(mesh), fixed, 1e-13, x);
  EXPECT_LT((x - target).cwiseAbs().maxCoeff(), 1e-6 * 4e-3);
}

TEST_P(PatchTest, UniformCompressionWithFreeSidesIsTheClosedForm) {
  const TetMesh mesh = shaken_block();
  const auto terms = elasticity(mesh);
  for (const double stretch : {0.999, 0.8}) {
    // Both faces slide: z is prescribed, x on the vertical line through the middle, y too; x of one more vertex's
    // y-coordinate stops the turn.
    std::vector<bool> fixed(static_cast<std::size_t>(3 * mesh.num_vertices()), false);
    Positions x = mesh.positions;
    for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
      const double z = mesh.positions(v, 2);
      x(v, 2) = z * stretch;
      if (z > -1e-12 || z < -3e-3 + 1e-12) fixed[3 * v + 2] = true;
      const bool middle = mesh.positions.row(v).head<2>().norm() < 1e-12 && z > -1e-12;
      const bool beside = std::abs(mesh.positions(v, 1)) < 1e-12 && mesh.positions(v, 0) > 2e-3 - 1e-12 && z > -1e-12;
      if (middle) fixed[3 * v] = fixed[3 * v + 1] = true;
      if (beside) fixed[3 * v + 1] = true;
    }
    find_equilibrium(terms, fixed, 1e-13, x);
    const Compression expected = uniform_compression(GetParam().law, gel(), stretch);
    Positions target = mesh.positions;
    target.leftCols<2>() *= expected.lateral_stretch;
    target.col(2) *= stretch;
    EXPECT_LT((x - target).cwiseAbs().maxCoeff(), 1e-6 * 4e-3);
    // Force of the upper face on what holds it, over the undeformed area.
    const Positions gradient = total_gradient(terms, x);
    double force = 0.0;
    for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v)
      if (mesh.positions(v, 2) > -1e-12) force += gradient(v, 2);
    EXPECT_NEAR(force / 16e-6 / expected.nominal_stress_pa, 1.0, 1e-6) << "stretch " << stretch;
  }
}

class WideLayerTest : public PatchTest {};

TEST_P(WideLayerTest, InsideShearIsSimple) {
  // 36 thicknesses wide. A pressure at the ends fades like e^{−kx}, k² = 12 μ/((λ + 2μ) h²): over a thickness for
  // ν = 0.43, but over many for a nearly incompressible gel, which is left out here.
  const double h = 1e-3, shift = 0.3e-3;
  const TetMesh mesh = make_gel({BoxGel{.width_m = 36 * h,
                                        .height_m = 36 * h,
                                        .thickness_m = h,
                                        .near_m = h,
                                        .near_half_m = 18 * h,
                                        .growth = 1.0,
                                        .far_m = h,
                                        .layer_m = h / 2,
                                        .layer_growth = 1.0}},
                                "");
  const auto terms = elasticity(mesh);
  std::vector<bool> fixed(static_cast<std::size_t>(3 * mesh.num_vertices()), false);
  Positions x = mesh.positions;
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
    const double z = mesh.positions(v, 2);
    x(v, 0) += shift * (1.0 + z / h);
    if (z > -1e-12 || z < -h + 1e-12) fixed[3 * v] = fixed[3 * v + 1] = fixed[3 * v + 2] = true;
  }
  const Positions simple = x;
  find_equilibrium(terms, fixed, 1e-13, x);
  const Positions gradient = total_gradient(terms, x);
  const double expected = layer_shear_force_n(gel(), h, h * h, shift);  // of a square of the layer's thickness
  const FrontSurface front = make_front_surface(mesh);
  const std::vector<double> area = lumped_areas(front, on_front(front, mesh.positions));
  std::vector<double> area_of(static_cast<std::size_t>(mesh.num_vertices()), 0.0);
  for (std::size_t i = 0; i < area.size(); ++i) area_of[front.vertices[i]] = area[i];
  int seen = 0;
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
    if (mesh.positions.row(v).head<2>().cwiseAbs().maxCoeff() > 3.5 * h) continue;
    ++seen;
    EXPECT_LT((x.row(v) - simple.row(v)).norm(), 1e-6 * h);
    if (GetParam().law == "neo_hookean" && mesh.positions(v, 2) > -1e-12) {
      EXPECT_NEAR(gradient(v, 0) / expected * h * h / area_of[v], 1.0, 1e-6) << mesh.positions.row(v);
    }
  }
  EXPECT_GT(seen, 100);
}

TEST_P(PatchTest, InternalForcesHaveNoNetForceOrTorque) {
  const TetMesh mesh = shaken_block();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-0.05e-3, 0.05e-3);
  Positions x = mesh.positions;
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] += shift(random);
  const Positions gradient = total_gradient(elasticity(mesh), x);
  Vector3 torque = Vector3::Zero();
  for (Eigen::Index v = 0; v < x.rows(); ++v) torque += Vector3(x.row(v)).cross(Vector3(gradient.row(v)));
  EXPECT_LT(gradient.colwise().sum().norm(), 1e-11 * gradient.cwiseAbs().sum());
  EXPECT_LT(torque.norm(), 1e-11 * 4e-3 * gradient.cwiseAbs().sum());
}

TEST_P(PatchTest, AFreeBodyKeepsItsMomentumAndNeverGainsEnergy) {
  const TetMesh mesh = shaken_block();
  const auto elastic = elasticity(mesh);
  const Eigen::VectorXd mass =
      lumped_masses(mesh.tets, make_rest_tets(mesh.positions, mesh.tets), mesh.num_vertices(), 1010.0);
  const double step_s = 2e-4;
  Positions x = mesh.positions;
  x.col(0) *= 1.1;  // let go stretched, flying and turning
  Positions velocity = Positions::Zero(x.rows(), 3);
  for (Eigen::Index v = 0; v < x.rows(); ++v) velocity.row(v) << 0.3 - 20.0 * x(v, 1), 20.0 * x(v, 0), 0.1;
  const auto momentum = [&] { return Vector3((mass.asDiagonal() * velocity).colwise().sum()); };
  const auto energy = [&] {
    return total_value(elastic, x) + 0.5 * mass.dot(Eigen::VectorXd(velocity.rowwise().squaredNorm()));
  };
  const Vector3 before = momentum();
  double last = energy();
  const std::vector<bool> fixed(static_cast<std::size_t>(3 * mesh.num_vertices()), false);
  for (int i = 0; i < 10; ++i) {
    const Positions x_hat = x + step_s * velocity;
    const Positions old = x;
    find_equilibrium({{1.0, std::make_shared<Inertia>(mass, x_hat)}, {step_s * step_s, elastic[0].term}}, fixed, 1e-14,
                     x);
    velocity = (x - old) / step_s;
    EXPECT_LT((momentum() - before).norm(), 1e-8 * before.norm());
    const double now = energy();
    EXPECT_LE(now, last * (1.0 + 1e-10)) << "step " << i;
    last = now;
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, WideLayerTest,
                         ::testing::Values(PatchCase{"neo_hookean", Element::linear, 0.3},
                                           PatchCase{"neo_hookean", Element::linear, 0.43},
                                           PatchCase{"stvk_hencky", Element::linear, 0.43},
                                           PatchCase{"neo_hookean", Element::averaged_volume, 0.43}),
                         name_of);

INSTANTIATE_TEST_SUITE_P(Materials, PatchTest,
                         ::testing::Values(PatchCase{"neo_hookean", Element::linear, 0.3},
                                           PatchCase{"neo_hookean", Element::linear, 0.43},
                                           PatchCase{"stvk_hencky", Element::linear, 0.43},
                                           PatchCase{"neo_hookean", Element::averaged_volume, 0.43},
                                           PatchCase{"neo_hookean", Element::averaged_volume, 0.4999},
                                           PatchCase{"stvk_hencky", Element::averaged_volume, 0.49}),
                         name_of);

}  // namespace equilibrium_test
}  // namespace tacipc::verify
