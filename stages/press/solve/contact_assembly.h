// The contact terms' part of Newton's system.
#pragma once

#include "stages/press/solve/assembly.h"
#include "stages/press/solve/blend.h"

namespace tacipc {

/// How the object takes part in a system.
struct ObjectMotion {
  const Positions& of_vertices;  // rows like x; zero for the gel's
  /// Blocks of the object are wanted: it yields, or does not move by one shift.
  bool in_full;
  Vector3 shift;  // of all of its vertices, unless in full
};

/// Adds weight × the term at x in a fixed order, each stencil's Hessian blended of the exact and the positive one as
/// its vertices have it. `active`: the term's stencils that do not vanish at x.
///
/// Pairs of gel and object go eight at a time, and neighbours in the list that push on the same vertex, edge or
/// triangle of the gel are summed up before they are added: the broad phase finds them one after the other. Where the
/// object is shifted by d, H_c d of these needs none of its blocks: shifting everything changes nothing, so it is −H d
/// of the gel.
void assemble_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                      const FreeVertices& free, int first_object_vertex, const Blend& blend, const ObjectMotion& motion,
                      NewtonSystem& system);

/// Makes the Hessian of a system that has been assembled with the one blend that with the other; gradients stay.
void reblend_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                     const FreeVertices& free, int first_object_vertex, const Blend& before, const Blend& after,
                     const ObjectMotion& motion, NewtonSystem& system);

}  // namespace tacipc
