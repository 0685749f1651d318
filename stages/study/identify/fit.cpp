#include "stages/study/identify/fit.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/rng.h"

namespace tacipc {
namespace {

/// Step of differences, in standard deviations of the prior.
constexpr double kStep = 1e-3;

/// Residuals; nothing if the mechanics are not possible (a marker beyond the simulation or the camera's view, no finite
/// force).
std::optional<Eigen::VectorXd> possible_residuals(const MechanicsModel& model, const Eigen::VectorXd& u) {
  try {
    Eigen::VectorXd r = model.residuals(u);
    if (r.allFinite()) return r;
  } catch (const DataError&) {
  }
  return std::nullopt;
}

double scaled(const Unknown& unknown, double u) { return (u - unknown.u_mean()) / unknown.prior.sigma; }

/// Central differences with `step` (in u) inside the bounds; one-sided at the bounds.
Eigen::MatrixXd jacobian(const MechanicsModel& model, const Eigen::VectorXd& u, const Eigen::VectorXd& step) {
  const Eigen::Index n = u.size();
  Eigen::MatrixXd out(model.rows() + n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Unknown& unknown = model.unknowns()[i];
    Eigen::VectorXd low = u, high = u;
    low[i] = std::max(u[i] - step[i], unknown.u_low());
    high[i] = std::min(u[i] + step[i], unknown.u_high());
    out.col(i) = (model.residuals(high) - model.residuals(low)) / (high[i] - low[i]);
  }
  return out;
}

Eigen::VectorXd small_steps(const MechanicsModel& model) {
  Eigen::VectorXd step(model.unknowns().size());
  for (Eigen::Index i = 0; i < step.size(); ++i) step[i] = kStep * model.unknowns()[i].prior.sigma;
  return step;
}

/// Residuals over the unknowns in standard deviations of their priors, in which all are of order one.
class ScaledCost final : public ceres::CostFunction {
 public:
  explicit ScaledCost(const MechanicsModel& model) : model_(model) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.unknowns().size()));
    set_num_residuals(static_cast<int>(model.rows() + model.unknowns().size()));
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::VectorXd u = u_of(model_.unknowns(), parameters[0]);
    const auto r = possible_residuals(model_, u);
    if (!r) return false;
    std::ranges::copy(*r, residuals);
    if (!jacobians || !jacobians[0]) return true;
    Eigen::MatrixXd j;
    try {
      j = jacobian(model_, u, small_steps(model_));
    } catch (const DataError&) {
      return false;
    }
    for (Eigen::Index i = 0; i < u.size(); ++i) j.col(i) *= model_.unknowns()[i].prior.sigma;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(jacobians[0], j.rows(),
                                                                                       j.cols()) = j;
    return j.allFinite();
  }
  static Eigen::VectorXd u_of(const Unknowns& unknowns, const double* s) {
    Eigen::VectorXd u(unknowns.size());
    for (Eigen::Index i = 0; i < u.size(); ++i)
      u[i] =
          std::clamp(unknowns[i].u_mean() + s[i] * unknowns[i].prior.sigma, unknowns[i].u_low(), unknowns[i].u_high());
    return u;
  }

 private:
  const MechanicsModel& model_;
};

/// \param held unknown that stays at its start, or −1
std::pair<Eigen::VectorXd, int> minimise(const MechanicsModel& model, const Eigen::VectorXd& start, Eigen::Index held) {
  const Unknowns& unknowns = model.unknowns();
  const int n = static_cast<int>(unknowns.size());
  std::vector<double> s(n);
  for (Eigen::Index i = 0; i < n; ++i) s[i] = scaled(unknowns[i], start[i]);
  ceres::Problem problem;
  problem.AddResidualBlock(new ScaledCost(model), nullptr, s.data());
  if (held >= 0) problem.SetManifold(s.data(), new ceres::SubsetManifold(n, {static_cast<int>(held)}));
  for (int i = 0; i < n; ++i) {
    const double low = scaled(unknowns[i], unknowns[i].u_low()), high = scaled(unknowns[i], unknowns[i].u_high());
    if (std::isfinite(low)) problem.SetParameterLowerBound(s.data(), i, low);
    if (std::isfinite(high)) problem.SetParameterUpperBound(s.data(), i, high);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-10;
  options.parameter_tolerance = 1e-8;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw DataError("the fit failed: {}", summary.message);
  return {ScaledCost::u_of(unknowns, s.data()), static_cast<int>(summary.iterations.size())};
}

/// Covariance of u. Markers between frames are interpolated, with a kink at each frame. Differences over small steps
/// give first standard deviations; differences over steps of that size then average over the kinks.
Eigen::MatrixXd covariance_at(const MechanicsModel& model, const Eigen::VectorXd& u) {
  const Eigen::Index n = u.size();
  Eigen::VectorXd step = small_steps(model);
  Eigen::MatrixXd covariance;
  for (int round = 0; round < 3; ++round) {
    const Eigen::MatrixXd j = jacobian(model, u, step);
    covariance = (j.transpose() * j).ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    // Step for one unknown with the others held: it changes the residuals by about one standard deviation.
    for (Eigen::Index i = 0; i < n; ++i) step[i] = 1.0 / j.col(i).norm();
  }
  return covariance;
}

}  // namespace

Fit fit_mechanics(MechanicsModel& model) {
  constexpr Eigen::Index kEnoughRows = 8;
  constexpr int kRounds = 6;
  Fit fit{.u = model.unknowns().prior_mean(), .covariance = {}};
  model.residuals(fit.u);  // throws a message about data that no mechanics fit
  for (int round = 0;; ++round) {
    const auto [u, iterations] = minimise(model, fit.u, -1);
    fit.u = u;
    fit.iterations += iterations;
    bool changed = false;
    for (std::size_t m = 0; m < model.spec().measurements.size(); ++m) {
      const Eigen::VectorXd off = model.off(m, u);
      if (off.size() < kEnoughRows) continue;
      const double factor =
          std::max(1.0, model.sigma_factor[m] * std::sqrt(off.squaredNorm() / static_cast<double>(off.size())));
      changed |= std::abs(factor / model.sigma_factor[m] - 1.0) > 0.01;
      model.sigma_factor[m] = factor;
    }
    if (!changed) break;
    if (round == kRounds) {
      log_warning("deviations of measurements still grow after {} fits", kRounds);
      break;
    }
  }
  fit.covariance = covariance_at(model, fit.u);
  return fit;
}

std::vector<ProfilePoint> profile(const MechanicsModel& model, const Fit& fit, Eigen::Index unknown, int points) {
  const Unknown& held = model.unknowns()[unknown];
  const double deviation = std::sqrt(fit.covariance(unknown, unknown));
  const double low = std::max(fit.u[unknown] - 3.0 * deviation, held.u_low());
  const double high = std::min(fit.u[unknown] + 3.0 * deviation, held.u_high());
  const double least = model.residuals(fit.u).squaredNorm();
  std::vector<ProfilePoint> out;
  for (int i = 0; i < points; ++i) {
    Eigen::VectorXd start = fit.u;
    start[unknown] = low + (high - low) * i / (points - 1);
    const Eigen::VectorXd u = minimise(model, start, unknown).first;
    out.push_back({.value = held.value_of(start[unknown]), .cost = model.residuals(u).squaredNorm() - least});
  }
  return out;
}

double Posterior::deviation(const Eigen::VectorXd& values) const {
  const double m = mean(values);
  return std::sqrt(weight.dot((values.array() - m).square().matrix()));
}

double Posterior::quantile(const Eigen::VectorXd& values, double share) const {
  std::vector<Eigen::Index> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  double below = 0.0;
  for (const Eigen::Index i : order) {
    below += weight[i];
    if (below >= share) return values[i];
  }
  return values[order.back()];
}

std::vector<Eigen::Index> Posterior::resampled(int count) const {
  std::vector<Eigen::Index> out;
  double below = 0.0;
  Eigen::Index i = -1;
  for (int k = 0; k < count; ++k) {
    const double share = (k + 0.5) / count;
    while (i + 1 < weight.size() && (i < 0 || below < share)) below += weight[++i];
    out.push_back(i);
  }
  return out;
}

Posterior draw_posterior(const MechanicsModel& model, const Fit& fit, int draws, int seed) {
  constexpr int kFreedom = 5;
  const Eigen::Index n = fit.u.size();
  const Eigen::LLT<Eigen::MatrixXd> factor(fit.covariance);
  const Eigen::MatrixXd lower = factor.matrixL();
  const double least = model.residuals(fit.u).squaredNorm();
  const auto base = static_cast<std::uint64_t>(seed);
  Posterior out{.u = Eigen::MatrixXd(n, draws), .weight = Eigen::VectorXd::Zero(draws)};
  std::uint64_t counter = 0;
  const auto normal = [&] { return random_normal(base, hash_of("posterior"), counter++); };
  Eigen::VectorXd logarithm = Eigen::VectorXd::Constant(draws, -HUGE_VAL);
  for (int k = 0; k < draws; ++k) {
    Eigen::VectorXd z(n);
    for (double& value : z) value = normal();
    double chi2 = 0.0;
    for (int i = 0; i < kFreedom; ++i) chi2 += std::pow(normal(), 2);
    const Eigen::VectorXd t = z * std::sqrt(kFreedom / chi2);
    out.u.col(k) = fit.u + lower * t;
    if (!model.unknowns().within_bounds(out.u.col(k))) continue;
    const double density = -0.5 * (kFreedom + static_cast<double>(n)) * std::log1p(t.squaredNorm() / kFreedom);
    if (const auto r = possible_residuals(model, out.u.col(k)))
      logarithm[k] = -0.5 * (r->squaredNorm() - least) - density;
  }
  const double largest = logarithm.maxCoeff();
  if (!std::isfinite(largest)) throw DataError("no draw of the mechanics is possible");
  for (int k = 0; k < draws; ++k) out.weight[k] = std::exp(logarithm[k] - largest);
  out.weight /= out.weight.sum();
  out.effective_draws = 1.0 / out.weight.squaredNorm();
  return out;
}

double prior_deviation(const Unknown& unknown) {
  constexpr int kSteps = 4000;
  const double low = std::max(scaled(unknown, unknown.u_low()), -8.0),
               high = std::min(scaled(unknown, unknown.u_high()), 8.0);
  double sum = 0.0, first = 0.0, second = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = low + (high - low) * (i + 0.5) / kSteps, density = std::exp(-0.5 * s * s);
    sum += density;
    first += density * s;
    second += density * s * s;
  }
  return unknown.prior.sigma * std::sqrt(second / sum - std::pow(first / sum, 2));
}

bool told_by_measurements(const Unknown& unknown, double deviation_u) {
  return deviation_u * deviation_u < 0.5 * std::pow(prior_deviation(unknown), 2);
}

}  // namespace tacipc
