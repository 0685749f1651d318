#include "stages/study/identify/node_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tacipc {
namespace {

/// Power that keeps the sign, so that it has an inverse.
double power(double y, double exponent) { return std::copysign(std::pow(std::abs(y), exponent), y); }

/// Slope at the middle of three points that keeps the interpolant between them monotone.
double middle_slope(double left_width, double left, double right_width, double right) {
  if (left * right <= 0.0) return 0.0;
  const double a = 2.0 * right_width + left_width, b = right_width + 2.0 * left_width;
  return (a + b) / (a / left + b / right);
}

}  // namespace

Eigen::Index NodeGrid::size() const {
  Eigen::Index count = 1;
  for (const auto& axis : axes_) count *= static_cast<Eigen::Index>(axis.size());
  return count;
}

Eigen::VectorXd NodeGrid::weights(const std::vector<double>& at) const {
  assert(at.size() == axes_.size());
  Eigen::VectorXd out = Eigen::VectorXd::Ones(1);
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const auto& axis = axes_[k];
    const Eigen::Index n = std::ssize(axis);
    Eigen::VectorXd longer(out.size() * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      double weight = 1.0;
      for (Eigen::Index j = 0; j < n; ++j)
        if (j != i) weight *= (at[k] - axis[j]) / (axis[i] - axis[j]);
      for (Eigen::Index o = 0; o < out.size(); ++o) longer[o * n + i] = weight * out[o];
    }
    out = std::move(longer);
  }
  return out;
}

Curve::Curve(const std::vector<double>& x, const Eigen::VectorXd& y, double exponent) : exponent_(exponent), x_(x) {
  const std::size_t n = x.size();
  assert(n >= 3 && static_cast<std::size_t>(y.size()) == n);
  for (const double value : y) root_.push_back(power(value, exponent));
  const auto width = [&](std::size_t i) { return x_[i + 1] - x_[i]; };
  const auto secant = [&](std::size_t i) { return (root_[i + 1] - root_[i]) / width(i); };
  slope_.push_back(secant(0));
  for (std::size_t i = 1; i + 1 < n; ++i)
    slope_.push_back(middle_slope(width(i - 1), secant(i - 1), width(i), secant(i)));
  slope_.push_back(secant(n - 2));
}

double Curve::at(double place) const {
  assert(place >= 0.0);
  if (place >= x_.back()) return power(root_.back() + slope_.back() * (place - x_.back()), 1.0 / exponent_);
  const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, place);
  const auto i = static_cast<std::size_t>(above - x_.begin()) - 1;
  const double h = x_[i + 1] - x_[i], t = (place - x_[i]) / h;
  const double hermite = (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t) * root_[i] +
                         t * (1.0 - t) * (1.0 - t) * h * slope_[i] + t * t * (3.0 - 2.0 * t) * root_[i + 1] +
                         t * t * (t - 1.0) * h * slope_[i + 1];
  return power(hermite, 1.0 / exponent_);
}

}  // namespace tacipc
