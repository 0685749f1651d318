// The sum that a time step minimises.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/contact_barrier.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/energy/inertia.h"

namespace tacipc {

struct WeightedTerm {
  double weight;
  std::shared_ptr<const EnergyTerm> term;
};

/// A term over contact pairs, which couples vertices that share no element; null where there is none.
struct WeightedContact {
  double weight = 0.0;
  std::shared_ptr<const ContactTerm> term = nullptr;
};

/// The parts of one time step; null where a part is absent.
struct StepTerms {
  std::shared_ptr<const EnergyTerm> inertia;            // of the gel about x̂
  std::shared_ptr<const EnergyTerm> object_pull;        // of an object with free axes: its inertia about x̂, its mount
  std::shared_ptr<const EnergyTerm> mass_damping;       // an inertia about the start of the step
  std::shared_ptr<const EnergyTerm> stiffness_damping;  // ½ (x − xᵗ)ᵀ K (x − xᵗ)
  std::shared_ptr<const EnergyTerm> gravity;            // −Σ m g·x where x̂ does not include it
  std::shared_ptr<const EnergyTerm> constraint;         // what an augmented Lagrangian holds
  std::shared_ptr<const EnergyTerm> elasticity;         // of one body, or JoinedTerm of several
  std::shared_ptr<const EnergyTerm> viscous_memory;     // of a gel whose stress relaxes
  struct Body {
    std::shared_ptr<const EnergyTerm> inertia;        // about its points' x̂
    std::shared_ptr<const EnergyTerm> orthogonality;  // what keeps its shape
  };
  std::vector<Body> bodies;  // that move freely
  std::shared_ptr<const ContactTerm> friction;
  std::shared_ptr<const ContactBarrier> barrier;
};

struct StepWeights {
  double h_s = 0.0;
  double barrier_stiffness_j_m4 = 0.0;  // κ/h² of the nominal time step
  double friction_coefficient = 0.0;    // the largest of all pairs of bodies
  double mass_damping_per_s = 0.0;
  double stiffness_damping_s = 0.0;
  /// On each part of the elasticity, more than 1 where stress relaxes; empty: 1 on all.
  std::vector<double> elastic_factors = {};

  /// κ and μκ over h², J/m⁴, times `scale`: forces of contact and friction, or with h² their weights in Ê.
  double of_barrier(double scale) const { return scale * barrier_stiffness_j_m4; }
  double of_friction(double scale) const { return of_barrier(scale) * friction_coefficient; }
};

/// Ê(x) in kg m².   [Eq. 3, 5, 9]
struct IncrementalPotential {
  std::vector<WeightedTerm> terms;           // all but contact, of the gel, and of an object with free axes
  std::vector<WeightedTerm> of_bodies = {};  // of bodies that move freely
  WeightedContact friction = {};
  WeightedContact barrier = {};

  /// Ê(x), +∞ where x is not allowed. The sum runs in a fixed order: terms, bodies, friction, barrier.
  /// \param active the barrier's active pairs at x, if known
  double value(const Positions& x, const std::vector<int>* active = nullptr) const;
};

/// Ê = inertia + αh C_M + βh C_K + h² (f Φ + viscous memory + gravity + constraint + orthogonality) + κ′(μ D + B), κ′ =
/// h² × barrier stiffness: κ for the nominal h; f the elastic factor, of each part of Φ its own.
IncrementalPotential make_incremental_potential(const StepTerms& terms, const StepWeights& weights);

}  // namespace tacipc
