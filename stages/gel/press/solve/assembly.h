// Gradient and Hessian of the incremental potential over the free vertices.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/incremental_potential.h"
#include "stages/gel/press/solve/block_matrix.h"

namespace tacipc {

/// H p = −g − H_c d, the Newton step while prescribed vertices move by d, and the same for the object as a whole should
/// it be free to shift: shifting it by q moves all its vertices by q.
struct NewtonSystem {
  BlockMatrix hessian;
  Eigen::VectorXd gradient;  // g over the free vertices
  Eigen::VectorXd coupling;  // H_c d: columns of the prescribed vertices times their motion
  Eigen::Matrix<double, Eigen::Dynamic, 3> object_border;  // ∂²/∂x∂q
  Matrix3 object_hessian;                                  // ∂²/∂q²
  Vector3 object_gradient;                                 // ∂/∂q
  Vector3 object_coupling;                                 // H d for q
};

/// Pattern of the Hessian of a term over all tetrahedra: all vertex pairs that share a stencil, which also covers every
/// contact of the gel with a prescribed object.
std::shared_ptr<const BlockPattern> mesh_pattern(const FreeVertices& free, const EnergyTerm& term);

/// The pattern, or a larger one if stencils of the term that are active at x couple vertices it does not (gel against
/// gel, or against a body that moves freely: then all of the term's stencils are covered, for more of them will be
/// active soon).
std::shared_ptr<const BlockPattern> cover_contacts(std::shared_ptr<const BlockPattern> pattern,
                                                   const FreeVertices& free, int first_object_vertex,
                                                   const ContactTerm& term, const std::vector<int>& active,
                                                   const Positions& x);

/// Makes it a system of zeros.
void clear(NewtonSystem& system, const FreeVertices& free, std::shared_ptr<const BlockPattern> pattern);
/// All of it but the Hessian.
void clear_gradient(NewtonSystem& system, const FreeVertices& free);

/// Adds weight × term at x in a fixed order. `order` is hessian or psd; `motion` (rows like x) is how prescribed
/// vertices move; those from `first_object_vertex` on are the object's.
void assemble(const WeightedTerm& term, const Positions& x, const FreeVertices& free, int first_object_vertex,
              Order order, const Positions& motion, NewtonSystem& system);

/// Whether the term is one of the gel with the same Hessian everywhere: an inertia, or its viscous memory.
bool has_constant_hessian(const WeightedTerm& term, int first_object_vertex);
/// Adds weight × gradient at x of such a term.
void add_gradient(const WeightedTerm& term, const Positions& x, const FreeVertices& free, NewtonSystem& system);

/// Adds an inertia of the gel, times how its free vertices move along, to the coupling; nothing for other terms.
void add_inertia_coupling(const WeightedTerm& term, int first_object_vertex, const Positions& motion,
                          const FreeVertices& free, NewtonSystem& system);

/// Adds the derivatives of one contact pair; only those of `wanted` vertices are there. A vertex that a body carries
/// passes its derivatives on to the body's points, each by its weight.
void scatter_pair(std::span<const int> stencil, PairVertices wanted, const PairLocal& local, double weight,
                  const FreeVertices& free, int first_object_vertex, const Positions& motion, NewtonSystem& system);

/// Gradient of one term at every vertex, prescribed ones too, in the term's unit per metre.
Positions gradient_of(const EnergyTerm& term, const Positions& x);

}  // namespace tacipc
