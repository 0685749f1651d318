#include "stages/gel/press/energy/incremental_potential.h"

#include "stages/gel/press/energy/joined_term.h"

namespace tacipc {

double IncrementalPotential::value(const Positions& x, const std::vector<int>* active) const {
  double value = 0.0;
  for (const WeightedTerm& part : terms) value += part.weight * part.term->value(x);
  for (const WeightedTerm& part : of_bodies) value += part.weight * part.term->value(x);
  if (friction.term) value += friction.weight * friction.term->value(x);
  if (barrier.term) value += barrier.weight * (active ? barrier.term->value_of(*active, x) : barrier.term->value(x));
  return value;
}

IncrementalPotential make_incremental_potential(const StepTerms& terms, const StepWeights& w) {
  const double h = w.h_s;
  IncrementalPotential out;
  const auto add = [&](double weight, std::shared_ptr<const EnergyTerm> term) {
    if (term) out.terms.push_back({weight, std::move(term)});
  };
  add(1.0, terms.inertia);
  add(1.0, terms.object_pull);
  add(w.mass_damping_per_s * h, terms.mass_damping);
  add(w.stiffness_damping_s * h, terms.stiffness_damping);
  add(h * h, terms.gravity);
  add(h * h, terms.constraint);
  add(h * h, terms.viscous_memory);
  for (const StepTerms::Body& body : terms.bodies) {
    out.of_bodies.push_back({1.0, body.inertia});
    out.of_bodies.push_back({h * h, body.orthogonality});
  }
  const auto elastic = parts_of(terms.elasticity);
  for (std::size_t k = 0; k < elastic.size(); ++k)
    add(h * h * (w.elastic_factors.empty() ? 1.0 : w.elastic_factors[k]), elastic[k]);
  out.friction = {w.of_friction(h * h), terms.friction};
  out.barrier = {w.of_barrier(h * h), terms.barrier};
  return out;
}

}  // namespace tacipc
