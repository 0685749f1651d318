// Data that is constant over a simulation, shared by the units of a time step.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/affine_body.h"
#include "stages/gel/press/energy/contact_barrier.h"
#include "stages/gel/press/energy/viscoelasticity.h"
#include "stages/gel/press/solve/blend.h"
#include "stages/gel/press/solve/step_settings.h"

namespace tacipc {

/// The deformable bodies (gels and soft objects) as the solver sees them.
struct GelModel {
  std::shared_ptr<const EnergyTerm> elasticity;  // over all tetrahedra; a JoinedTerm if there are several bodies
  Tetrahedra tets;
  Eigen::VectorXd mass_kg;                                           // lumped mass per vertex
  std::vector<int> glued;                                            // vertices of the glued faces
  std::shared_ptr<const Viscoelasticity> viscoelasticity = nullptr;  // over the same tetrahedra; null: elastic
};

/// Mesh, gel, settings and bodies of a simulation.
struct SolverModel {
  const ContactMesh& mesh;
  GelModel gel;
  StepSettings settings;
  std::vector<AffineBody> bodies;  // the leading objects, which may be free

  /// Barrier between these pairs. \param pairs pairs without weights yet
  std::shared_ptr<const ContactBarrier> barrier(std::vector<ContactPair> pairs) const {
    return std::make_shared<ContactBarrier>(
        mesh, weighted(std::move(pairs), mesh, settings.laws, settings.pair_counting), settings.laws);
  }
  /// Blend with PSD share 1 at every vertex that needs a share.
  Blend full_blend() const {
    // If objects touch nothing but gels, shares of the gel vertices suffice.
    const int vertices = mesh.objects.size() > 1 ? mesh.num_vertices() : mesh.num_gel_vertices;
    return Blend(vertices, settings.newton.adaptive_contact_hessian);
  }
};

}  // namespace tacipc
