// The contact terms' part of Newton's system.
#pragma once

#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/blend.h"

namespace tacipc {

/// How the object takes part in a system.
struct ObjectMotion {
  const Positions& of_vertices;  // rows like x; zero for the gel's
  bool in_full;                  // blocks of the object are needed: it has free axes, or does more than translate
  Vector3 translation;           // of all of its vertices, unless in full
};

/// Adds weight × the term at x in a fixed order, each stencil's Hessian blended of the exact one and its PSD
/// approximation by the share of its vertices. `active`: the term's stencils that do not vanish at x.
///
/// Pairs of gel and object are evaluated eight at a time, and neighbours in the list that push on the same vertex, edge
/// or triangle of the gel are summed before they are added: the broad phase finds them one after the other. Where the
/// object translates by d, H_c d of these needs none of its blocks: translating everything changes nothing, so it is
/// −H d of the gel.
void assemble_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                      const FreeVertices& free, int first_object_vertex, const Blend& blend, const ObjectMotion& motion,
                      NewtonSystem& system);

/// Turns the Hessian of a system assembled with the blend `before` into that of `after`; gradients stay. Marks the rows
/// of the vertices it changes; not those of bodies.
void reblend_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                     const FreeVertices& free, int first_object_vertex, const Blend& before, const Blend& after,
                     const ObjectMotion& motion, NewtonSystem& system, std::vector<char>& changed_rows);

}  // namespace tacipc
