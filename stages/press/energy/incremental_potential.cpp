#include "stages/press/energy/incremental_potential.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace tacipc {
namespace {

constexpr int kChunk = 1024;

/// Σᵢ eᵢ(x): partial sums over fixed chunks, added in order, so that the result does not depend on the threads.
double sum(const EnergyTerm& term, const Positions& x) {
  const int count = term.num_stencils();
  std::vector<double> partial(static_cast<std::size_t>((count + kChunk - 1) / kChunk));
  tbb::parallel_for(std::size_t{0}, partial.size(), [&](std::size_t chunk) {
    const int first = static_cast<int>(chunk) * kChunk;
    Local local;
    Eigen::VectorXd local_x;
    double value = 0.0;
    for (int i = first; i < std::min(count, first + kChunk); ++i) {
      gather(x, term.stencil(i), local_x);
      term.evaluate(i, local_x, Order::value, local);
      value += local.value;
    }
    partial[chunk] = value;
  });
  double value = 0.0;
  for (const double part : partial) value += part;
  return value;
}

}  // namespace

double IncrementalPotential::value(const Positions& x) const {
  double value = 0.0;
  for (const auto& [weight, term] : terms) value += weight * sum(*term, x);
  return value;
}

IncrementalPotential make_incremental_potential(double h_s, double kappa, std::shared_ptr<const Inertia> inertia,
                                                std::shared_ptr<const Elasticity> elasticity,
                                                std::shared_ptr<const ContactBarrier> barrier) {
  return {{{1.0, std::move(inertia)}, {h_s * h_s, std::move(elasticity)}, {kappa, std::move(barrier)}}};
}

}  // namespace tacipc
