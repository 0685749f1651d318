#include "verification/bonded_layer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tacipc::verify {
namespace {

using std::numbers::pi;

/// Abel's transform q(t) of the indenter's profile, as in the header.
double profile_transform(const LayerProblem& problem, double t) {
  switch (problem.shape) {
    case LayerProblem::Shape::sphere: return t * std::atanh(t / problem.radius_m);
    case LayerProblem::Shape::paraboloid: return t * t / problem.radius_m;
    case LayerProblem::Shape::flat: break;
  }
  return 0.0;
}

/// Cosines weighted with √w, c(k, i), such that M(tᵢ, tⱼ) = Σ_k c(k, i) c(k, j). 1 − K decays like e^{−2ω}, so ω ends
/// at 24; a panel is never longer than a quarter of the fastest cosine's wavelength.
Eigen::MatrixXd weighted_cosines(const LayerProblem& problem, const std::vector<double>& t) {
  constexpr double kEnd = 24.0;
  constexpr int kPerPanel = 8;
  const double share = problem.combined_modulus_pa() / problem.gel.plane_modulus_pa();
  const double fastest = *std::ranges::max_element(t) / problem.thickness_m;
  const int panels = 24 + static_cast<int>(std::ceil(kEnd * fastest / (pi / 2.0)));
  Eigen::MatrixXd c(panels * kPerPanel, static_cast<Eigen::Index>(t.size()));
  for (int panel = 0; panel < panels; ++panel) {
    const Quadrature omega = gauss_legendre(kPerPanel, kEnd * panel / panels, kEnd * (panel + 1) / panels);
    for (int q = 0; q < kPerPanel; ++q) {
      const double g = share * (1.0 - bonded_layer_kernel(omega.node[q], problem.gel.poissons_ratio));
      const double root = std::sqrt(std::max(0.0, 2.0 / pi * g * omega.weight[q] / problem.thickness_m));
      for (std::size_t i = 0; i < t.size(); ++i) {
        c(panel * kPerPanel + q, static_cast<Eigen::Index>(i)) =
            root * std::cos(omega.node[q] * t[i] / problem.thickness_m);
      }
    }
  }
  return c;
}

}  // namespace

double LayerProblem::combined_modulus_pa() const {
  const double of_gel = gel.plane_modulus_pa();
  return indenter ? 1.0 / (1.0 / of_gel + 1.0 / indenter->plane_modulus_pa()) : of_gel;
}

double bonded_layer_kernel(double omega, double poissons_ratio) {
  const double k = 3.0 - 4.0 * poissons_ratio, w = omega;
  if (w > 300.0) return 1.0;
  return (2.0 * k * std::sinh(2.0 * w) - 4.0 * w) / (2.0 * k * std::cosh(2.0 * w) + 1.0 + k * k + 4.0 * w * w);
}

Quadrature gauss_legendre(int points, double low, double high) {
  Quadrature out;
  for (int i = 0; i < points; ++i) {
    double x = -std::cos(pi * (i + 0.75) / (points + 0.5)), slope = 1.0;
    for (int newton = 0; newton < 100; ++newton) {
      double p = 1.0, before = 0.0;
      for (int n = 1; n <= points; ++n) {
        const double next = ((2.0 * n - 1.0) * x * p - (n - 1.0) * before) / n;
        before = p;
        p = next;
      }
      slope = points * (x * p - before) / (x * x - 1.0);
      const double step = p / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    out.node.push_back(0.5 * (low + high) + 0.5 * (high - low) * x);
    out.weight.push_back((high - low) / ((1.0 - x * x) * slope * slope));
  }
  return out;
}

LayerSolution solve_bonded_layer(const LayerProblem& problem, double contact_radius_m, double depth_m, int points) {
  const Quadrature nodes = gauss_legendre(points, 0.0, contact_radius_m);
  std::vector<double> t = nodes.node;
  t.push_back(contact_radius_m);  // node for φ(a)
  const Eigen::MatrixXd cosines = weighted_cosines(problem, t);
  const Eigen::MatrixXd M = cosines.transpose() * cosines;
  const Eigen::Map<const Eigen::VectorXd> weight(nodes.weight.data(), points);
  const Eigen::MatrixXd system =
      Eigen::MatrixXd::Identity(points, points) - M.topLeftCorner(points, points) * weight.asDiagonal();
  // φ = δ φ₁ − φ₂, the solutions for unit depth and for the profile.
  Eigen::MatrixXd right(points, 2);
  const double scale = problem.combined_modulus_pa() / pi;
  for (int i = 0; i < points; ++i) right.row(i) << scale, scale * profile_transform(problem, t[i]);
  const Eigen::MatrixXd phi = system.partialPivLu().solve(right);
  const Eigen::RowVector2d force = 2.0 * pi * weight.transpose() * phi;
  LayerSolution out;
  out.contact_radius_m = contact_radius_m;
  if (problem.shape == LayerProblem::Shape::flat) {
    out.depth_m = depth_m;
  } else {
    const Eigen::RowVector2d at_rim = Eigen::RowVector2d(scale, scale * profile_transform(problem, contact_radius_m)) +
                                      M.row(points).head(points) * weight.asDiagonal() * phi;
    out.depth_m = at_rim[1] / at_rim[0];
  }
  out.force_n = out.depth_m * force[0] - force[1];
  return out;
}

LayerSolution press_bonded_layer(const LayerProblem& problem, double depth_m, int points) {
  if (problem.shape == LayerProblem::Shape::flat) {
    return solve_bonded_layer(problem, problem.radius_m, depth_m, points);
  }
  // An incompressible thin layer bulges, so its contact is wider than √(2 R δ). The contact radius of a sphere is below
  // R.
  double low = 0.0, high = 4.0 * std::sqrt(problem.radius_m * depth_m);
  if (problem.shape == LayerProblem::Shape::sphere) high = std::min(high, 0.999999 * problem.radius_m);
  for (int i = 0; i < 60; ++i) {
    const double a = 0.5 * (low + high);
    (solve_bonded_layer(problem, a, 0.0, points).depth_m < depth_m ? low : high) = a;
  }
  return solve_bonded_layer(problem, 0.5 * (low + high), 0.0, points);
}

}  // namespace tacipc::verify
