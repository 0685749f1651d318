#include "stages/gel/press/solve/step_terms.h"

#include <numeric>

#include "stages/gel/press/energy/axis_springs.h"
#include "stages/gel/press/energy/linear_load.h"
#include "stages/gel/press/energy/stiffness_damping.h"
#include "stages/gel/press/solve/held_objects.h"

namespace tacipc {
namespace {

/// Reference positions of damping: the start of the step, with gels displaced rigidly with their mounts.
Positions start_beside_mounts(const ContactMesh& mesh, const Step& step) {
  Positions start = step.compared_start().topRows(mesh.num_gel_vertices);
  for (std::size_t g = 0; g < step.goal.mount_motion.size(); ++g) {
    auto rows = start.middleRows(mesh.gels[g].first_vertex, mesh.gels[g].mesh->num_gel_vertices);
    rows += way_of(step.goal.mount_motion[g], Positions(rows));
  }
  return start;
}

void add_gel_terms(const SolverModel& model, const State& state, Step& step) {
  const Eigen::Index n = model.mesh.num_gel_vertices;
  const GelModel& gel = model.gel;
  const StepSettings& settings = model.settings;
  const double h = step.goal.h_s;
  const Positions start = state.x.topRows(n);
  StepTerms& terms = step.terms;
  terms.elasticity = gel.elasticity;
  if (!settings.quasi_static) {
    const Eigen::RowVector3d fall = h * h * settings.gravity_m_s2.transpose();
    terms.inertia = std::make_shared<Inertia>(gel.mass_kg, (start + h * state.velocity_m_s).rowwise() + fall);
  } else if (settings.gravity_m_s2 != Vector3::Zero()) {
    std::vector<int> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), 0);
    terms.gravity = std::make_shared<LinearLoad>(std::move(all), gel.mass_kg * settings.gravity_m_s2.transpose());
  }
  if (settings.stiffness_damping_s > 0.0)
    terms.stiffness_damping = std::make_shared<StiffnessDamping>(gel.elasticity, start_beside_mounts(model.mesh, step));
  if (settings.mass_damping_per_s > 0.0) terms.mass_damping = std::make_shared<Inertia>(gel.mass_kg, start);
}

void add_relaxation(const Viscoelasticity& gel, const State& state, Step& step) {
  step.start_stress_pa = gel.stress(state.x);
  step.terms.viscous_memory = gel.memory(state.viscous_pa, step.start_stress_pa, step.goal.h_s);
  step.weights.elastic_factors = gel.elastic_factors(step.goal.h_s);
}

/// Adds inertia or mount of an object along its free axes.
void add_object_pull(const SolverModel& model, const State& state, Step& step) {
  const StepGoal& goal = step.goal;
  const int n = model.mesh.num_gel_vertices;
  const double h = goal.h_s;
  Vector3 stiffness = Vector3::Constant(goal.object_mass_kg),
          target = goal.object_target.row(0) - goal.mount_shift_m.transpose();
  for (int axis = 0; axis < 3; ++axis) {
    if (const double mount = goal.mount_stiffness_n_m[axis]; mount > 0.0) {
      stiffness[axis] = h * h * mount;
    } else if (goal.object_mass_kg > 0.0) {
      target[axis] = state.x(n, axis) + h * state.object_velocity_m_s[axis] +
                     h * h * model.settings.gravity_m_s2[axis] + h * h / goal.object_mass_kg * goal.load_n[axis];
    }
  }
  step.terms.object_pull = std::make_shared<AxisSprings>(n, stiffness, target);
}

}  // namespace

void add_terms(const SolverModel& model, const State& state, Step& step) {
  add_gel_terms(model, state, step);
  if (model.gel.viscoelasticity) add_relaxation(*model.gel.viscoelasticity, state, step);
  if (!step.goal.free_axes.empty()) add_object_pull(model, state, step);
}

}  // namespace tacipc
