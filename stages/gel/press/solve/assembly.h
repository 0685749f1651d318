// Gradient and Hessian of the incremental potential over the free vertices.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/incremental_potential.h"
#include "stages/gel/press/solve/block_matrix.h"

namespace tacipc {

/// Newton system H p = −g − H_c d for the free vertices, where prescribed vertices move by d. If the object may
/// translate as a whole, its shift q, which moves all its vertices by q, is a further unknown.
struct NewtonSystem {
  BlockMatrix hessian;
  Eigen::VectorXd gradient;  // gradient g over the free vertices
  Eigen::VectorXd coupling;  // H_c d: columns of the prescribed vertices times their motion
  Eigen::Matrix<double, Eigen::Dynamic, 3> object_border;  // mixed derivative ∂²/∂x∂q
  Matrix3 object_hessian;                                  // second derivative ∂²/∂q²
  Vector3 object_gradient;                                 // gradient ∂/∂q
  Vector3 object_coupling;                                 // H d for q
};

/// Pattern of the Hessian of a term over all tetrahedra: all vertex pairs that share a stencil. It also covers every
/// contact of the gel with a prescribed object.
std::shared_ptr<const BlockPattern> mesh_pattern(const FreeVertices& free, const EnergyTerm& term);

/// Pattern extended by vertex pairs that active stencils of the term couple at x: contact between gels, or with a free
/// body. With a free body all stencils of the term are covered, because more of them will soon be active.
/// \return the given pattern if it already covers them
std::shared_ptr<const BlockPattern> cover_contacts(std::shared_ptr<const BlockPattern> pattern,
                                                   const FreeVertices& free, int first_object_vertex,
                                                   const ContactTerm& term, const std::vector<int>& active,
                                                   const Positions& x);

/// Resets the system to zeros with this pattern.
void clear(NewtonSystem& system, const FreeVertices& free, std::shared_ptr<const BlockPattern> pattern);
/// Resets everything except the Hessian to zero.
void clear_gradient(NewtonSystem& system, const FreeVertices& free);

/// Adds weight × term at x in a fixed order.
/// \param order hessian or psd
/// \param motion displacements of prescribed vertices, rows like x; rows from `first_object_vertex` on are the object's
void assemble(const WeightedTerm& term, const Positions& x, const FreeVertices& free, int first_object_vertex,
              Order order, const Positions& motion, NewtonSystem& system);

/// Whether the term acts on the gel and has a constant Hessian: inertia or viscous memory.
bool has_constant_hessian(const WeightedTerm& term, int first_object_vertex);
/// Adds weight × gradient at x of a term with a constant Hessian.
void add_gradient(const WeightedTerm& term, const Positions& x, const FreeVertices& free, NewtonSystem& system);

/// Adds the coupling by the gel's inertia if its free vertices have a prescribed motion. Does nothing for other terms.
void add_inertia_coupling(const WeightedTerm& term, int first_object_vertex, const Positions& motion,
                          const FreeVertices& free, NewtonSystem& system);

/// Adds the derivatives of one contact pair, of which only those of `wanted` vertices exist. A vertex of an affine body
/// passes its derivatives on to the control points, each by its weight.
void scatter_pair(std::span<const int> stencil, PairVertices wanted, const PairLocal& local, double weight,
                  const FreeVertices& free, int first_object_vertex, const Positions& motion, NewtonSystem& system);

/// Gradient of a term at every vertex, including prescribed ones, in the term's unit per metre.
Positions gradient_of(const EnergyTerm& term, const Positions& x);

}  // namespace tacipc
