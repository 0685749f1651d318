// Broad phase between two surfaces that share no vertex.
#pragma once

#include <vector>

#include "stages/gel/press/contact/contact_mesh.h"
#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Appends every pair of a vertex, edge or triangle of `a` and a triangle, edge or vertex of `b` that comes within
/// `within_m` while the vertices move straight from x to x + p, or a superset. Nothing is cached between calls: suited
/// to surfaces that touch at few locations.
void pairs_between(const Surface& a, const Surface& b, const Positions& x, const Positions& p, double within_m,
                   std::vector<ContactPair>& out);

}  // namespace tacipc
