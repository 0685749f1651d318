// Assembly of the contact terms into the Newton system.
#pragma once

#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/blend.h"

namespace tacipc {

/// Motion of the object in a system.
struct ObjectMotion {
  const Positions& of_vertices;  // displacements, rows like x; zero for gel vertices
  bool in_full;         // whether blocks of the object are needed: it has free axes, or does not only translate
  Vector3 translation;  // translation of all object vertices if not in_full
};

/// Adds weight × the term at x in a fixed order. Each stencil's Hessian is blended from the exact one and its PSD
/// approximation by the share of its vertices.
/// \param active the term's stencils that do not vanish at x
///
/// Pairs of gel and object are evaluated eight at a time. Neighbours in the list that push on the same vertex, edge or
/// triangle of the gel are summed before they are added, because the broad phase lists them consecutively. If the
/// object translates by d, H_c d of these pairs needs none of the object's blocks: a translation of everything changes
/// nothing, so H_c d = −H d over the gel's vertices.
void assemble_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                      const FreeVertices& free, int first_object_vertex, const Blend& blend, const ObjectMotion& motion,
                      NewtonSystem& system);

/// Replaces the Hessian of a system assembled with the blend `before` by that of `after`; gradients stay. Marks the
/// rows of changed vertices, except those of bodies.
void reblend_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                     const FreeVertices& free, int first_object_vertex, const Blend& before, const Blend& after,
                     const ObjectMotion& motion, NewtonSystem& system, std::vector<char>& changed_rows);

}  // namespace tacipc
