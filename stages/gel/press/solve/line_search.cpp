#include "stages/gel/press/solve/line_search.h"

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

constexpr int kMaxHalvings = 40;
/// Fraction of the longest step of a vertex from which a step counts as one of the longest.
constexpr double kFarthest = 0.3;

}  // namespace

double largest_row(const Positions& p, Eigen::Index rows) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < rows; ++i) largest = std::max(largest, p.row(i).squaredNorm());
  return std::sqrt(largest);
}

void raise_shares_of_farthest(const Positions& p, Blend& blend) {
  const double far = kFarthest * largest_row(p, p.rows());
  for (Eigen::Index v = 0; v < p.rows(); ++v) {
    if (p.row(v).norm() >= far) blend.raise_after_shortening(static_cast<int>(v));
  }
}

std::optional<double> line_search(const NewtonDirection& direction, double limit, Step& step, Minimisation& run,
                                  SolverTimes& times) {
  const auto value = [&](const Positions& at) {
    return timed(times.line_search_s, [&] { return run.energy.value(at, &run.active.at(at)); });
  };
  const double before = run.value ? *run.value : value(step.x);
  // Near the minimum the decrease is below rounding; a step that changes nothing measurable is also accepted.
  const double rounding = kEnergyRounding * std::abs(before);
  double alpha = limit;
  for (int halvings = 0; halvings <= kMaxHalvings; ++halvings, alpha *= 0.5) {
    const Positions trial = step.x + alpha * direction.p;
    const double after = value(trial);
    if (!(after <= before + kSufficientDecrease * alpha * direction.slope + rounding)) continue;
    if (step.arrived && halvings > 0) raise_shares_of_farthest(direction.p.topRows(step.blend.size()), step.blend);
    step.x = trial;
    step.object_shift += alpha * direction.object_shift;
    run.value = after;
    return alpha;
  }
  return std::nullopt;
}

}  // namespace tacipc
