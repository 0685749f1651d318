// The contact terms' part of Newton's system.
#pragma once

#include "stages/press/solve/assembly.h"

namespace tacipc {

/// Adds weight × the term at x in a fixed order, with the blend of exact and positive Hessian that
/// NewtonStepper::direction looks for. Blocks of the object are left out unless `with_object` (it moves or yields; what
/// is free is never left out). `active`: the term's stencils that do not vanish at x.
///
/// Pairs of gel and object go eight at a time, and neighbours in the list that push on the same vertex, edge or
/// triangle of the gel are summed up before they are added: the broad phase finds them one after the other.
void assemble_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                      const FreeVertices& free, int first_object_vertex, double blend, bool with_object,
                      const Positions& motion, NewtonSystem& system);

}  // namespace tacipc
