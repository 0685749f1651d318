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
  for (const WeightedTerm& part : terms) value += part.weight * sum(*part.term, x);
  return value;
}

IncrementalPotential make_incremental_potential(const StepTerms& terms, const StepWeights& w) {
  const double h = w.h_s, kappa = h * h * w.barrier_stiffness_j_m4;
  IncrementalPotential out;
  const auto add = [&](double weight, std::shared_ptr<const EnergyTerm> term, bool contact = false) {
    if (term) out.terms.push_back({weight, std::move(term), contact});
  };
  add(1.0, terms.inertia);
  add(1.0, terms.object_inertia);
  add(w.mass_damping_per_s * h, terms.mass_damping);
  add(w.stiffness_damping_s * h, terms.stiffness_damping);
  add(h * h, terms.gravity);
  add(h * h, terms.constraint);
  add(h * h, terms.elasticity);
  add(kappa * w.friction_coefficient, terms.friction, true);
  add(kappa, terms.barrier, true);
  return out;
}

}  // namespace tacipc
