// Everything that stays the same during a simulation, as the units of a time step read it.
#pragma once

#include <memory>
#include <vector>

#include "stages/gel/press/energy/affine_body.h"
#include "stages/gel/press/energy/contact_barrier.h"
#include "stages/gel/press/energy/viscoelasticity.h"
#include "stages/gel/press/solve/blend.h"
#include "stages/gel/press/solve/step_settings.h"

namespace tacipc {

/// The gel as the solver sees it; constant during a simulation.
struct GelModel {
  std::shared_ptr<const EnergyTerm> elasticity;  // over all tetrahedra; of several bodies JoinedTerm
  Tetrahedra tets;
  Eigen::VectorXd mass_kg;
  std::vector<int> glued;
  std::shared_ptr<const Viscoelasticity> viscoelasticity = nullptr;  // over the same; null: elastic
};

struct SolverModel {
  const ContactMesh& mesh;
  GelModel gel;
  StepSettings settings;
  std::vector<AffineBody> bodies;  // the first objects, those that may be free

  /// Barrier between these pairs, which carry no weights yet.
  std::shared_ptr<const ContactBarrier> barrier(std::vector<ContactPair> pairs) const {
    return std::make_shared<ContactBarrier>(
        mesh, weighted(std::move(pairs), mesh, settings.laws, settings.pair_counting), settings.laws);
  }
  /// Shares of 1 for all vertices that need some.
  Blend full_blend() const {
    // Where objects touch nothing but gels, vertices of these are enough.
    const int vertices = mesh.objects.size() > 1 ? mesh.num_vertices() : mesh.num_gel_vertices;
    return Blend(vertices, settings.newton.adaptive_contact_hessian);
  }
};

}  // namespace tacipc
