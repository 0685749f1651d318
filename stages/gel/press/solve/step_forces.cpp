#include "stages/gel/press/solve/step_forces.h"

#include <algorithm>
#include <cmath>

#include "stages/gel/press/energy/joined_term.h"
#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/body_wrenches.h"
#include "stages/gel/press/solve/local_patch.h"

namespace tacipc {
namespace {

/// Fraction of the largest force on a vertex below which a vertex counts as untouched.
constexpr double kTouching = 1e-9;

/// Computes StepForces::stand_off_m.
double stand_off(const ContactBarrier& barrier, const Positions& x) {
  double force = 0.0, moment = 0.0;
  for (const int i : barrier.active(x)) {
    if (barrier.of_gel_alone(i) || barrier.of_objects_alone(i)) continue;
    const ContactBarrier::Push push = barrier.push(i, gather(x, barrier.pairs()[i]));
    force += push.force;
    moment += push.force * std::sqrt(push.feature.squared_distance);
  }
  return force > 0.0 ? moment / force : 0.0;
}

/// Contact state of each gel vertex. \param normal contact forces on the gel
std::vector<ContactState> contact_states(const Step& step, const Positions& normal) {
  const Eigen::Index n = normal.rows();
  std::vector<ContactState> states(static_cast<std::size_t>(n), ContactState::none);
  // Weights of both signs cancel only to rounding.
  const double touching_n = kTouching * std::sqrt(normal.rowwise().squaredNorm().maxCoeff());
  std::vector<double> all(static_cast<std::size_t>(n), 0.0), slipping(static_cast<std::size_t>(n), 0.0);
  for (Eigen::Index v = 0; v < n; ++v)
    if (normal.row(v).norm() > touching_n) states[v] = ContactState::stick;
  if (!step.friction) return states;
  for (int i = 0; i < step.friction->num_stencils(); ++i) {
    const auto stencil = step.friction->stencil(i);
    const bool slips = step.friction->relative_slide(i, step.x) >= 1.0;
    for (std::size_t k = 0; k < stencil.size(); ++k) {
      if (stencil[k] >= n) continue;
      const double share =
          std::abs(step.friction->weights(i)[static_cast<Eigen::Index>(k)]) * step.friction->normal_force(i);
      all[stencil[k]] += share;
      if (slips) slipping[stencil[k]] += share;
    }
  }
  for (Eigen::Index v = 0; v < n; ++v) {
    if (states[v] != ContactState::none && slipping[v] > 0.5 * all[v]) states[v] = ContactState::slip;
  }
  return states;
}

}  // namespace

StepForces no_forces(int num_gel_vertices) {
  const Positions zero = Positions::Zero(num_gel_vertices, 3);
  return {.normal = zero,
          .friction = zero,
          .mount = zero,
          .body = zero,
          .contact_state = std::vector<ContactState>(static_cast<std::size_t>(num_gel_vertices), ContactState::none)};
}

ForceReport::ForceReport(const SolverModel& model, CollisionDetector& detector) : model_(model), detector_(detector) {
  std::vector<bool> held(static_cast<std::size_t>(model.mesh.num_vertices()), false);
  for (const int v : model.gel.glued) held[v] = true;
  elasticity_at_mount_ = restricted(model.gel.elasticity, held);
}

StepForces ForceReport::at_end_of(const Step& step) {
  const Eigen::Index n = model_.mesh.num_gel_vertices;
  const double h2 = step.goal.h_s * step.goal.h_s;
  // Ê is h² times an energy.
  const auto force_of = [&](double weight, const EnergyTerm& term) -> Positions {
    return -weight / h2 * gradient_of(term, step.x).topRows(n);
  };
  StepForces forces = no_forces(model_.mesh.num_gel_vertices);
  const auto take_from_mount = [&](const Positions& force) {
    for (const int v : model_.gel.glued) forces.mount.row(v) -= force.row(v);
  };
  const auto touching = model_.barrier(detector_.pairs_at(step.x));
  forces.stand_off_m = stand_off(*touching, step.x);
  const IncrementalPotential energy = step.potential(touching);
  const auto elastic = parts_of(model_.gel.elasticity), at_mount = parts_of(elasticity_at_mount_);
  for (const WeightedTerm& part : energy.terms) {
    if (part.term == step.terms.object_pull || part.term == step.terms.constraint) continue;
    if (const auto found = std::find(elastic.begin(), elastic.end(), part.term); found != elastic.end()) {
      take_from_mount(force_of(part.weight, *at_mount[static_cast<std::size_t>(found - elastic.begin())]));
      continue;
    }
    // A damping force is linear in the displacement: it dissipates twice its energy.
    if (part.term == step.terms.stiffness_damping)
      forces.damping_loss_j = 2.0 * part.weight / h2 * part.term->value(step.x);
    const Positions force = force_of(part.weight, *part.term);
    // Inside the gel it cancels with the elastic force.
    if (part.term != step.terms.viscous_memory) forces.body += force;
    take_from_mount(force);
  }
  if (energy.friction.term) {
    const Positions on_all = -energy.friction.weight / h2 * gradient_of(*energy.friction.term, step.x);
    forces.friction = on_all.topRows(n);
    forces.friction_loss_j = -(on_all.array() * (step.x - step.compared_start()).array()).sum();
    take_from_mount(forces.friction);
  }
  forces.normal = force_of(energy.barrier.weight, *energy.barrier.term);
  forces.contact_j = energy.barrier.weight / h2 * energy.barrier.term->value(step.x);
  take_from_mount(forces.normal);
  if (!model_.bodies.empty() || model_.settings.wrenches_between_bodies) {
    const auto bodies = static_cast<std::size_t>(model_.mesh.num_bodies());
    forces.between.assign(bodies * bodies, {Vector3::Zero(), Vector3::Zero()});
    for (const WeightedContact* contact : {&energy.barrier, &energy.friction}) {
      if (contact->term) add_body_wrenches(model_.mesh, *contact->term, contact->weight / h2, step.x, forces.between);
    }
  }
  forces.contact_state = contact_states(step, forces.normal);
  return forces;
}

}  // namespace tacipc
