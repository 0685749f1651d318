// Incremental potential: the weighted sum of energies that a time step minimises.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/contact_barrier.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/energy/inertia.h"

namespace tacipc {

/// A term with its weight.
struct WeightedTerm {
  double weight;
  std::shared_ptr<const EnergyTerm> term;
};

/// A weighted term over contact pairs, which couple vertices that share no element; null if there is none.
struct WeightedContact {
  double weight = 0.0;
  std::shared_ptr<const ContactTerm> term = nullptr;
};

/// Terms of one time step; null if a term is absent.
struct StepTerms {
  std::shared_ptr<const EnergyTerm> inertia;            // inertia of the gel about x̂
  std::shared_ptr<const EnergyTerm> object_pull;        // object with free axes: its inertia about x̂, or its mount
  std::shared_ptr<const EnergyTerm> mass_damping;       // inertia about the start of the step
  std::shared_ptr<const EnergyTerm> stiffness_damping;  // energy ½ (x − xᵗ)ᵀ K (x − xᵗ)
  std::shared_ptr<const EnergyTerm> gravity;            // energy −Σ m g·x, if x̂ does not include gravity
  std::shared_ptr<const EnergyTerm> constraint;         // augmented Lagrangian
  std::shared_ptr<const EnergyTerm> elasticity;         // one body, or JoinedTerm of several
  std::shared_ptr<const EnergyTerm> viscous_memory;     // viscous memory of a viscoelastic gel
  /// Terms of a free body.
  struct Body {
    std::shared_ptr<const EnergyTerm> inertia;        // inertia of its control points about x̂
    std::shared_ptr<const EnergyTerm> orthogonality;  // energy that keeps its shape
  };
  std::vector<Body> bodies;  // free bodies
  std::shared_ptr<const ContactTerm> friction;
  std::shared_ptr<const ContactBarrier> barrier;
};

/// Weights of the terms of a time step.
struct StepWeights {
  double h_s = 0.0;
  double barrier_stiffness_j_m4 = 0.0;  // κ/h² for the nominal time step
  double friction_coefficient = 0.0;    // largest of all pairs of bodies
  double mass_damping_per_s = 0.0;
  double stiffness_damping_s = 0.0;
  /// Factor on each part of the elasticity, above 1 for a viscoelastic body; empty: 1 for all parts.
  std::vector<double> elastic_factors = {};

  /// κ/h² and μκ/h², J/m⁴, times `scale`. With scale 1 they turn contact and friction terms into forces; with h² they
  /// are their weights in Ê.
  double of_barrier(double scale) const { return scale * barrier_stiffness_j_m4; }
  double of_friction(double scale) const { return of_barrier(scale) * friction_coefficient; }
};

/// Incremental potential Ê(x), kg m² [Eq. 3, 5, 9].
struct IncrementalPotential {
  std::vector<WeightedTerm> terms;           // terms of the gel and of an object with free axes, without contact
  std::vector<WeightedTerm> of_bodies = {};  // terms of free bodies
  WeightedContact friction = {};
  WeightedContact barrier = {};

  /// Ê(x); +∞ if x is not allowed. Fixed order of summation: terms, bodies, friction, barrier.
  /// \param active the barrier's active pairs at x, if known
  double value(const Positions& x, const std::vector<int>* active = nullptr) const;
};

/// Ê = inertia + αh C_M + βh C_K + h² (f Φ + viscous memory + gravity + constraint + orthogonality) + κ′(μ D + B). κ′ =
/// h² × barrier stiffness, which is κ for the nominal h; f is the elastic factor of each part of Φ.
IncrementalPotential make_incremental_potential(const StepTerms& terms, const StepWeights& weights);

}  // namespace tacipc
