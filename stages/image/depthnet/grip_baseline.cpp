#include "stages/image/depthnet/grip_baseline.h"

#include <cassert>
#include <cmath>
#include <cstddef>

#include "common/base/statistics.h"

namespace tacipc {
namespace {

constexpr double kRidge = 1e-6;  // weight per grasp
constexpr int kMaxIterations = 100;

double logistic(double x) { return x >= 0.0 ? 1.0 / (1.0 + std::exp(-x)) : 1.0 - 1.0 / (1.0 + std::exp(x)); }

/// Value log(1 + exp(x)), without overflow.
double softplus(double x) { return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x))); }

}  // namespace

double GripBaseline::probability(double grip_n) const { return logistic(intercept + slope * grip_n); }

GripBaseline fit_grip_baseline(const std::vector<double>& grips_n, const std::vector<bool>& held) {
  assert(grips_n.size() == held.size() && !held.empty());
  const auto [mean, deviation] = mean_and_deviation(grips_n);
  const double scale = deviation > 1e-9 * std::abs(mean) ? 1.0 / deviation : 0.0;  // a single force value has no slope
  const double ridge = kRidge * static_cast<double>(held.size());
  const auto cost = [&](double a, double b) {
    double sum = 0.5 * ridge * b * b;
    for (std::size_t i = 0; i < held.size(); ++i) {
      const double x = a + b * scale * (grips_n[i] - mean);
      sum += softplus(x) - (held[i] ? x : 0.0);
    }
    return sum;
  };
  double a = 0.0, b = 0.0, now = cost(a, b);
  for (int iteration = 0; iteration < kMaxIterations;
       ++iteration) {  // Newton steps, halved until they decrease the cost
    double ga = 0.0, gb = ridge * b, haa = 0.0, hab = 0.0, hbb = ridge;
    for (std::size_t i = 0; i < held.size(); ++i) {
      const double x = scale * (grips_n[i] - mean), p = logistic(a + b * x), w = p * (1.0 - p);
      ga += p - (held[i] ? 1.0 : 0.0);
      gb += (p - (held[i] ? 1.0 : 0.0)) * x;
      haa += w;
      hab += w * x;
      hbb += w * x * x;
    }
    const double det = haa * hbb - hab * hab;
    if (!(det > 0.0)) break;
    double da = -(hbb * ga - hab * gb) / det, db = -(haa * gb - hab * ga) / det;
    double next = cost(a + da, b + db);
    for (int halving = 0; next > now && halving < 40; ++halving) next = cost(a + (da *= 0.5), b + (db *= 0.5));
    if (!(next < now)) break;
    a += da;
    b += db;
    now = next;
  }
  return {.intercept = a - b * scale * mean, .slope = b * scale};
}

}  // namespace tacipc
