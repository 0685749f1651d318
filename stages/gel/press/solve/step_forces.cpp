// Within a time step: the forces it ends with.
#include <algorithm>
#include <cmath>

#include "stages/gel/press/energy/joined_term.h"
#include "stages/gel/press/solve/body_wrenches.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {
namespace {

constexpr double kTouching = 1e-9;  // of the largest force on a vertex

/// StepForces::stand_off_m.
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

}  // namespace

StepForces TimeStepper::no_forces() const {
  const Positions zero = Positions::Zero(mesh_.num_gel_vertices, 3);
  return {
      .normal = zero,
      .friction = zero,
      .mount = zero,
      .body = zero,
      .contact_state = std::vector<ContactState>(static_cast<std::size_t>(mesh_.num_gel_vertices), ContactState::none)};
}

void TimeStepper::record_forces(const Step& step) {
  const Eigen::Index n = mesh_.num_gel_vertices;
  const double h2 = step.goal.h_s * step.goal.h_s;
  // Ê is h² times an energy.
  const auto force_of = [&](double weight, const EnergyTerm& term) -> Positions {
    return -weight / h2 * gradient_of(term, step.x).topRows(n);
  };
  const auto take_from_mount = [&](const Positions& force) {
    for (const int v : gel_.glued) forces_.mount.row(v) -= force.row(v);
  };
  forces_ = no_forces();
  const auto touching = barrier(pairs_at(step.x));
  forces_.stand_off_m = stand_off(*touching, step.x);
  const IncrementalPotential energy = potential(step, touching);
  const auto elastic = parts_of(gel_.elasticity), at_mount = parts_of(elasticity_at_mount_);
  for (const WeightedTerm& part : energy.terms) {
    if (part.term == step.terms.object_pull || part.term == step.terms.constraint) continue;
    if (const auto found = std::find(elastic.begin(), elastic.end(), part.term); found != elastic.end()) {
      take_from_mount(force_of(part.weight, *at_mount[static_cast<std::size_t>(found - elastic.begin())]));
      continue;
    }
    // Half of what a damping force, linear in the way it acts along, takes.
    if (part.term == step.terms.stiffness_damping)
      forces_.damping_loss_j = 2.0 * part.weight / h2 * part.term->value(step.x);
    const Positions force = force_of(part.weight, *part.term);
    // Inside the gel it cancels with the elasticity's.
    if (part.term != step.terms.viscous_memory) forces_.body += force;
    take_from_mount(force);
  }
  if (energy.friction.term) {
    const Positions on_all = -energy.friction.weight / h2 * gradient_of(*energy.friction.term, step.x);
    forces_.friction = on_all.topRows(n);
    forces_.friction_loss_j = -(on_all.array() * (step.x - step.compared_start()).array()).sum();
    take_from_mount(forces_.friction);
  }
  forces_.normal = force_of(energy.barrier.weight, *energy.barrier.term);
  forces_.contact_j = energy.barrier.weight / h2 * energy.barrier.term->value(step.x);
  take_from_mount(forces_.normal);
  if (!bodies_.empty() || settings_.wrenches_between_bodies) {
    const auto bodies = static_cast<std::size_t>(mesh_.num_bodies());
    forces_.between.assign(bodies * bodies, {Vector3::Zero(), Vector3::Zero()});
    for (const WeightedContact* contact : {&energy.barrier, &energy.friction}) {
      if (contact->term) add_body_wrenches(mesh_, *contact->term, contact->weight / h2, step.x, forces_.between);
    }
  }

  // Where weights of both signs cancel, rounding is left.
  const double touching_n = kTouching * std::sqrt(forces_.normal.rowwise().squaredNorm().maxCoeff());
  std::vector<double> all(static_cast<std::size_t>(n), 0.0), slipping(static_cast<std::size_t>(n), 0.0);
  for (Eigen::Index v = 0; v < n; ++v)
    forces_.contact_state[v] = forces_.normal.row(v).norm() > touching_n ? ContactState::stick : ContactState::none;
  if (!step.friction) return;
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
    if (forces_.contact_state[v] != ContactState::none && slipping[v] > 0.5 * all[v])
      forces_.contact_state[v] = ContactState::slip;
  }
}

}  // namespace tacipc
