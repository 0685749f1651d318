#include "stages/gel/press/solve/free_bodies.h"

#include <algorithm>

#include "stages/gel/press/energy/orthogonality.h"

namespace tacipc {

void add_free_bodies(const SolverModel& model, const State& state, Step& step) {
  const StepGoal& goal = step.goal;
  for (Step::Body& free : step.bodies) {
    const auto i = static_cast<std::size_t>(free.body);
    const AffineBody& body = model.bodies[i];
    const Vector3 load_n = goal.body_load_n.empty() ? goal.load_n : goal.body_load_n[i];
    const int first = model.mesh.control_row(free.body);
    free.acceleration_m_s2 = model.settings.gravity_m_s2 + load_n / body.mass_kg;
    free.weight_n = body.mass_kg * std::max(model.settings.gravity_m_s2.norm(), load_n.norm() / body.mass_kg);
    free.predicted =
        predicted(body, state.x.middleRows<4>(first), state.object_motion[i], free.acceleration_m_s2, goal.h_s);
    step.terms.bodies.push_back(
        {std::make_shared<Inertia>(Eigen::VectorXd::Constant(4, 0.25 * body.mass_kg), Positions(free.predicted), first),
         std::make_shared<Orthogonality>(first, body, orthogonality_pa(body))});
  }
}

void finish_bodies(const SolverModel& model, const std::vector<Wrench>& between, Step& step, State& state) {
  const double h = step.goal.h_s;
  const int count = model.mesh.num_bodies();
  double worst = -1.0;
  std::size_t next = 0;
  for (const CarriedBody& body : step.newton.free().carried) body.carry(step.x);
  for (int b = 0; b < static_cast<int>(model.bodies.size()); ++b) {
    const auto i = static_cast<std::size_t>(b);
    const AffineBody& body = model.bodies[i];
    const int first = model.mesh.control_row(b);
    if (next == step.bodies.size() || step.bodies[next].body != b) {
      // A held body gets the momentum of its prescribed rigid motion.
      const ControlPoints before = state.x.middleRows<4>(first);
      const ControlPoints now =
          ControlPoints(step.goal.control_target.middleRows<4>(4 * b)).rowwise() + step.object_shift.transpose();
      state.object_motion[i] = after_step(body, before, now, {}, Vector3::Zero(), h);
      step.x.middleRows<4>(first) = now;
      continue;
    }
    const Step::Body& free = step.bodies[next++];
    const ControlPoints now = step.x.middleRows<4>(first);
    state.object_motion[i] = after_step(body, free.predicted, now, state.object_motion[i], free.acceleration_m_s2, h);
    const Wrench inertia = wrench_of(now, 0.25 * body.mass_kg / (h * h) * (now - free.predicted));
    const Vector3 center = center_of(now);
    Vector3 force = -inertia.force_n, torque = -inertia.torque_n_m;
    for (int other = 0; other < count; ++other) {
      const Wrench& of_contact = between[static_cast<std::size_t>((model.mesh.num_gels() + b) * count + other)];
      force += of_contact.force_n;
      torque += of_contact.torque_n_m - center.cross(of_contact.force_n);
    }
    const double part =
        std::max(force.norm(), torque.norm() / kBodyTorqueArm_m) / std::max(free.weight_n, kLeastWeight);
    if (part <= worst) continue;
    worst = part;
    step.report.body_residual_n = force.norm();
    step.report.body_residual_n_m = torque.norm();
    step.report.body_load_n = free.weight_n;
  }
}

}  // namespace tacipc
