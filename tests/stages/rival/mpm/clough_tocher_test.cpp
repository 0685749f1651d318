// The interpolant against SciPy's, and what it must reproduce.
#include "stages/rival/mpm/clough_tocher.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "stages/rival/mpm/gel_lattice.h"

namespace tacipc {
namespace clough_tocher_test {

/// 13 × 11 points 0.2 apart around the origin, moved to where `place` says.
struct Sheet {
  Points2 points;
  Triangles triangles;

  explicit Sheet(const std::function<Eigen::Vector2d(double, double)>& place) {
    const GelLattice lattice =
        make_gel_lattice({.counts = std::array{13, 11, 2}, .spacing_m = 0.2, .on_faces = true}, {});
    Positions front = front_at_rest(lattice);
    for (Eigen::Index p = 0; p < front.rows(); ++p)
      front.row(p).head<2>() = place(front(p, 0), front(p, 1)).transpose();
    points = front.leftCols<2>();
    triangles = triangulate(lattice, front);
  }
};

/// The same as made by the lines of GriddataOfScipy.
Sheet waves() {
  return Sheet([](double x, double y) {
    return Eigen::Vector2d(x + 0.06 * std::sin(2.0 * y + 0.3) + 0.03 * x * y,
                           y + 0.05 * std::cos(1.7 * x) - 0.02 * x * x);
  });
}

double interpolated(const CloughTocher& surface, Eigen::Index num_triangles, const Eigen::Vector2d& point) {
  for (Eigen::Index t = 0; t < num_triangles; ++t) {
    const Vector3 at = surface.barycentric(t, point);
    if (at.minCoeff() >= -1e-12) return surface.value(t, at);
  }
  ADD_FAILURE() << point.transpose() << " lies in no triangle";
  return 0.0;
}

TEST(CloughTocher, EqualsGriddataOfScipy) {
  // SciPy 1.10.1:
  //   i, j = np.meshgrid(np.arange(13), np.arange(11), indexing="ij")
  //   x, y = 0.2 * (i - 6), 0.2 * (j - 5)
  //   xd = x + 0.06 * np.sin(2.0 * y + 0.3) + 0.03 * x * y
  //   yd = y + 0.05 * np.cos(1.7 * x) - 0.02 * x * x
  //   z = -0.5 * np.exp(-1.5 * ((x - 0.2) ** 2 + (y + 0.1) ** 2)) + 0.1 * x * y
  //   griddata(np.c_[xd.ravel(), yd.ravel()], z.ravel(), (u, v), method="cubic")
  struct Value {
    double u, v, z;
    double tolerance;
  };
  // SciPy fills the whole convex hull: slivers along the rim, where it curves inwards, reach the next points'
  // gradients.
  constexpr double kRim = 1e-4, kInside = 1e-6;
  const Value golden[] = {{0, 0, -0.46556334417050504, kInside},        {0.21, -0.13, -0.4993174272792161, kInside},
                          {-0.73, 0.41, -0.11327154724104037, kInside}, {0.9, -0.6, -0.20383177310070577, kRim},
                          {0.333, 0.555, -0.2689076530868595, kInside}, {-1.05, -0.7, 0.03527994957296408, kRim},
                          {0.05, 0.62, -0.23962709691921447, kInside},  {1.0, 0.5, -0.0795459387773524, kInside}};
  const Sheet sheet = waves();
  const Sheet rest([](double x, double y) { return Eigen::Vector2d(x, y); });
  Eigen::VectorXd z(sheet.points.rows());
  for (Eigen::Index p = 0; p < z.size(); ++p) {
    const double x = rest.points(p, 0), y = rest.points(p, 1);
    z[p] = -0.5 * std::exp(-1.5 * ((x - 0.2) * (x - 0.2) + (y + 0.1) * (y + 0.1))) + 0.1 * x * y;
  }
  const CloughTocher surface(sheet.points, z, sheet.triangles);
  for (const Value& value : golden)
    EXPECT_NEAR(interpolated(surface, sheet.triangles.rows(), {value.u, value.v}), value.z, value.tolerance)
        << value.u << ", " << value.v;
}

TEST(CloughTocher, ReproducesPlanes) {
  const Sheet sheet = waves();
  const auto plane = [](double x, double y) { return 0.3 - 0.7 * x + 1.9 * y; };
  Eigen::VectorXd z(sheet.points.rows());
  for (Eigen::Index p = 0; p < z.size(); ++p) z[p] = plane(sheet.points(p, 0), sheet.points(p, 1));
  const CloughTocher surface(sheet.points, z, sheet.triangles);
  for (const auto& [x, y] : {std::pair{0.1, 0.2}, {-0.9, 0.4}, {0.75, -0.33}})
    EXPECT_NEAR(interpolated(surface, sheet.triangles.rows(), {x, y}), plane(x, y), 1e-5);
}

TEST(CloughTocher, GradientDoesNotJump) {
  const Sheet sheet = waves();
  Eigen::VectorXd z(sheet.points.rows());
  for (Eigen::Index p = 0; p < z.size(); ++p) z[p] = std::sin(3.0 * sheet.points(p, 0)) * sheet.points(p, 1);
  const CloughTocher surface(sheet.points, z, sheet.triangles);
  // Along a line through many triangles, slopes of neighbouring pieces differ by no more than the curvature allows; a
  // jump would not shrink with the pieces.
  const auto largest_change = [&](double h) {
    double largest = 0.0, before = NAN;
    for (double x = -0.8; x < 0.8; x += h) {
      const auto at = [&](double u) { return interpolated(surface, sheet.triangles.rows(), {u, 0.13 + 0.4 * u}); };
      const double slope = (at(x + h) - at(x)) / h;
      if (!std::isnan(before)) largest = std::max(largest, std::abs(slope - before));
      before = slope;
    }
    return largest;
  };
  const double coarse = largest_change(2e-3), fine = largest_change(5e-4);
  EXPECT_GT(coarse, 1e-3) << "the line is curved";
  EXPECT_LT(fine, 0.35 * coarse);
}

}  // namespace clough_tocher_test
}  // namespace tacipc
