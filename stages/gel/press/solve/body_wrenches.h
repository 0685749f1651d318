// Contact wrenches between bodies.
#pragma once

#include <vector>

#include "common/base/wrench.h"
#include "stages/gel/press/contact/contact_mesh.h"
#include "stages/gel/press/energy/contact_term.h"

namespace tacipc {

/// Adds the wrenches by which a contact term acts at x between any two bodies (ContactMesh::body_of()), −weight × its
/// gradient. The wrench on body a by body b is at index a × number of bodies + b: force in N and torque about the
/// world's origin in N m if weight × the term is an energy in J. Contact of a body with itself is left out.
void add_body_wrenches(const ContactMesh& mesh, const ContactTerm& term, double weight, const Positions& x,
                       std::vector<Wrench>& between);

}  // namespace tacipc
