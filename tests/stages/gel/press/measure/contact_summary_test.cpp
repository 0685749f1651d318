#include "stages/gel/press/measure/contact_summary.h"

#include <gtest/gtest.h>

#include <numbers>

#include "common/base/error.h"
#include "tests/scratch_folder.h"
#include "tests/stages/gel/press/measure/fronts.h"

namespace tacipc {
namespace contact_summary_test {

TEST(ContactSummary, OfTwoTrianglesByHand) {
  // A unit square of two triangles; the vertex of one triangle alone and one of both carry force.
  const Positions positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const FrontSurface front{.vertices = {0, 3, 5, 9}, .triangles = Triangles{{0, 1, 2}, {0, 2, 3}}};
  Positions normal = Positions::Zero(4, 3);
  normal.row(0) << 0, 3, -4;
  normal.row(1) << 0, 0, -7;
  const ContactSummary contact = measure_contact(
      front, positions, normal, {ContactState::stick, ContactState::slip, ContactState::none, ContactState::slip});
  EXPECT_DOUBLE_EQ(contact.area_m2, 2.0 / 6.0 + 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(contact.mean_pressure_pa, 12.0 / 0.5);
  EXPECT_DOUBLE_EQ(contact.peak_pressure_pa, 42.0);
  EXPECT_EQ(contact.sticking, 1);
  EXPECT_EQ(contact.slipping, 2);
}

TEST(ContactSummary, HertzPressureHasItsAreaItsMeanAndItsPeak) {
  // p = p0 √(1 − r²/a²) on a disc of radius a = 2 mm: mean 2/3 p0.
  Positions positions;
  const FrontSurface front = square_front(120, 0.006, 0.3, positions);
  const auto lumped = lumped_areas(front, positions);
  Positions normal = Positions::Zero(positions.rows(), 3);
  const double a = 0.002, p0 = 5e4;
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const double s = 1.0 - positions.row(v).squaredNorm() / (a * a);
    if (s > 0.0) normal(v, 2) = -p0 * std::sqrt(s) * lumped[static_cast<std::size_t>(v)];
  }
  const ContactSummary contact = measure_contact(front, positions, normal, {});
  EXPECT_NEAR(contact.area_m2, std::numbers::pi * a * a, 0.01 * std::numbers::pi * a * a);
  EXPECT_NEAR(contact.mean_pressure_pa, 2.0 / 3.0 * p0, 0.01 * p0);
  EXPECT_NEAR(contact.peak_pressure_pa, p0, 0.01 * p0);
  EXPECT_LE(contact.peak_pressure_pa, p0);
}

TEST(ContactSummary, CountsDeformedAreas) {
  Positions positions;
  const FrontSurface front = square_front(10, 0.01, 0.3, positions);
  const Positions normal = Positions::Constant(positions.rows(), 3, 1e-3);
  const double rest_m2 = measure_contact(front, positions, normal, {}).area_m2;
  EXPECT_NEAR(rest_m2, 1e-4, 1e-18);
  const Positions stretched = positions * Eigen::DiagonalMatrix<double, 3>(2.0, 3.0, 1.0);
  EXPECT_NEAR(measure_contact(front, stretched, normal, {}).area_m2, 6.0 * rest_m2, 1e-17);
}

TEST(ContactSummary, WithoutContactIsZeroAndWithoutAreaAnError) {
  const Positions positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const FrontSurface front{.vertices = {4, 5, 6}, .triangles = Triangles{{0, 1, 2}}};
  Positions normal = Positions::Zero(3, 3);
  const ContactSummary contact = measure_contact(front, positions, normal, std::vector<ContactState>(3));
  EXPECT_EQ(contact.area_m2, 0.0);
  EXPECT_EQ(contact.mean_pressure_pa, 0.0);
  EXPECT_EQ(contact.peak_pressure_pa, 0.0);
  EXPECT_EQ(contact.sticking + contact.slipping, 0);
  normal(1, 2) = -0.25;
  EXPECT_EQ(message_of<SolverError>([&] { measure_contact(front, positions, normal, {}); }),
            "gel vertex 5 carries 0.25 N, but the front around it has no area");
}

}  // namespace contact_summary_test
}  // namespace tacipc
