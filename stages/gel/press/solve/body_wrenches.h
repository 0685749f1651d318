// Which body acts on which, and by how much.
#pragma once

#include <vector>

#include "common/base/wrench.h"
#include "stages/gel/press/contact/contact_mesh.h"
#include "stages/gel/press/energy/contact_term.h"

namespace tacipc {

/// Adds what a contact term does at x between any two bodies (ContactMesh::body_of()), −weight × its gradient: on body
/// a by body b at a × number of bodies + b, force in N and torque about the world's origin in N m where weight × the
/// term is an energy in J. What a body does to itself is left out.
void add_body_wrenches(const ContactMesh& mesh, const ContactTerm& term, double weight, const Positions& x,
                       std::vector<Wrench>& between);

}  // namespace tacipc
