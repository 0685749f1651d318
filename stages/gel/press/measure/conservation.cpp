#include "stages/gel/press/measure/conservation.h"

#include <algorithm>
#include <cassert>

namespace tacipc {
namespace {

struct Momenta {
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
};

/// Calls visit(mass, position, velocity) for each particle: gel vertices, then the centres of free bodies.
template <typename Visit>
void for_each_particle(const Eigen::VectorXd& gel_mass_kg, const WholeInstant& whole, Visit&& visit) {
  for (Eigen::Index v = 0; v < gel_mass_kg.size(); ++v)
    visit(gel_mass_kg[v], Vector3(whole.gel_m.row(v)), Vector3(whole.gel_velocity_m_s.row(v)));
  for (const BodyInstant& body : whole.bodies) {
    if (!body.held) visit(body.body->mass_kg, center_of(body.control), body.motion.velocity_m_s);
  }
}

Momenta momenta_of(const Eigen::VectorXd& gel_mass_kg, const WholeInstant& whole) {
  Momenta sum;
  for_each_particle(gel_mass_kg, whole, [&](double mass, const Vector3& x, const Vector3& v) {
    sum.linear += mass * v;
    sum.angular += mass * x.cross(v);
  });
  for (const BodyInstant& body : whole.bodies) {
    if (!body.held) sum.angular += body.motion.angular_momentum_kg_m2_s;
  }
  return sum;
}

void set_state(WholeAccount& account, const Eigen::VectorXd& gel_mass_kg, const WholeInstant& whole,
               const Momenta& momenta, const Vector3& gravity, double elastic_j, double contact_j) {
  account.kinetic_j = account.gravitational_j = 0.0;
  for (Eigen::Index v = 0; v < gel_mass_kg.size(); ++v) {
    account.kinetic_j += 0.5 * gel_mass_kg[v] * whole.gel_velocity_m_s.row(v).squaredNorm();
    account.gravitational_j -= gel_mass_kg[v] * whole.gel_m.row(v).dot(gravity);
  }
  for (const BodyInstant& body : whole.bodies) {
    if (!body.held) account.kinetic_j += kinetic_energy(*body.body, body.control, body.motion);
    account.gravitational_j -= body.body->mass_kg * center_of(body.control).dot(gravity);
  }
  account.elastic_j = elastic_j;
  account.contact_j = contact_j;
  account.momentum_kg_m_s = momenta.linear;
  account.angular_momentum_kg_m2_s = momenta.angular;
}

double stored_j(const WholeAccount& account) {
  return account.kinetic_j + account.elastic_j + account.contact_j + account.gravitational_j;
}

}  // namespace

StepExchange exchange_of(double h_s, const StepForces& forces, const Positions& mount_before_n, double elastic_j) {
  return {.h_s = h_s,
          .mount_n = forces.mount,
          .mount_before_n = mount_before_n,
          .elastic_j = elastic_j,
          .contact_j = forces.contact_j,
          .friction_loss_j = forces.friction_loss_j,
          .damping_loss_j = forces.damping_loss_j};
}

WholeAccount open_account(const Eigen::VectorXd& gel_mass_kg, const WholeInstant& start, const Vector3& gravity_m_s2,
                          double elastic_j) {
  WholeAccount account;
  set_state(account, gel_mass_kg, start, momenta_of(gel_mass_kg, start), gravity_m_s2, elastic_j, 0.0);
  return account;
}

void regroup(WholeAccount& account, const Eigen::VectorXd& gel_mass_kg, const WholeInstant& now,
             const Vector3& gravity_m_s2) {
  const double stored = stored_j(account);
  const Vector3 momentum = account.momentum_kg_m_s, angular = account.angular_momentum_kg_m2_s;
  set_state(account, gel_mass_kg, now, momenta_of(gel_mass_kg, now), gravity_m_s2, account.elastic_j,
            account.contact_j);
  account.work_j += stored_j(account) - stored;
  account.impulse_n_s += account.momentum_kg_m_s - momentum;
  account.angular_impulse_n_m_s += account.angular_momentum_kg_m2_s - angular;
}

void add_step(WholeAccount& account, const Eigen::VectorXd& gel_mass_kg, const WholeInstant& before,
              const WholeInstant& after, const Vector3& gravity_m_s2, const StepExchange& exchange) {
  assert(before.bodies.size() == after.bodies.size());
  const double h = exchange.h_s;
  Vector3 force = exchange.others.force_n, torque = exchange.others.torque_n_m;
  double work = exchange.others_work_j;
  for (Eigen::Index v = 0; v < exchange.mount_n.rows(); ++v) {
    const Vector3 of_mount = exchange.mount_n.row(v), at = after.gel_m.row(v);
    force += of_mount;
    torque += at.cross(of_mount);
    work += 0.5 * (of_mount + Vector3(exchange.mount_before_n.row(v))).dot(at - Vector3(before.gel_m.row(v)));
  }
  std::vector<Vector3> velocities;
  for_each_particle(gel_mass_kg, before, [&](double, const Vector3&, const Vector3& v) { velocities.push_back(v); });
  Vector3 of_method = Vector3::Zero();
  auto earlier = velocities.begin();
  for_each_particle(gel_mass_kg, after, [&](double mass, const Vector3& x, const Vector3& v) {
    force += mass * gravity_m_s2;
    torque += mass * x.cross(gravity_m_s2);
    of_method += mass * v.cross(*earlier++);
  });

  const Momenta now = momenta_of(gel_mass_kg, after), then = momenta_of(gel_mass_kg, before);
  const double stored = stored_j(account);
  set_state(account, gel_mass_kg, after, now, gravity_m_s2, exchange.elastic_j, exchange.contact_j);
  account.work_j += work;
  account.friction_loss_j += exchange.friction_loss_j;
  account.damping_loss_j += exchange.damping_loss_j;
  account.method_loss_j += work - exchange.friction_loss_j - exchange.damping_loss_j - (stored_j(account) - stored);
  account.impulse_n_s += h * force;
  account.angular_impulse_n_m_s += h * torque;
  account.method_angular_n_m_s += h * of_method;
  account.momentum_residual_n = std::max(account.momentum_residual_n, ((now.linear - then.linear) / h - force).norm());
  account.angular_residual_n_m =
      std::max(account.angular_residual_n_m, ((now.angular - then.angular) / h - torque - of_method).norm());
}

}  // namespace tacipc
