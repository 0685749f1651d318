#include "stages/gel/press/world/world.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>

#include "common/base/error.h"
#include "common/sample/placement.h"
#include "stages/gel/press/contact/sharpness.h"

namespace tacipc {
namespace {

Matrix4 rest_from(const Body& body) { return body.affine_pose.inverse(); }

std::vector<AffineBody> affine_bodies(const std::vector<Body>& bodies) {
  std::vector<AffineBody> all;
  for (const Body& body : bodies) {
    if (body.affine) all.push_back(*body.affine);
  }
  return all;
}

bool has_mount(const Body& body) { return !body.tets.vertices(BoundaryTag::glued).empty(); }

}  // namespace

World::World(const Sensor& sensor, const PressConfig& config, std::vector<Body> bodies, const WorldOptions& options)
    : config_(config),
      bodies_(std::move(bodies)),
      options_(options),
      num_gels_(static_cast<std::size_t>(std::count_if(bodies_.begin(), bodies_.end(), has_mount))),
      scales_(scales_of(config, sensor, bodies_[0].tets)),
      affine_(affine_bodies(bodies_)),
      parts_(make_parts()),
      settings_(make_settings()),
      mesh_(make_mesh()),
      stresses_(make_stresses()),
      model_(make_gel_model(materials())),
      stepper_(mesh_, model_, settings_, affine_) {
  start();
}

std::vector<World::Part> World::make_parts() const {
  std::vector<Part> parts;
  Eigen::Index row = 0;
  for (const Body& body : bodies_) {
    if (!body.deformable()) break;
    parts.push_back({parts.size() < num_gels_ ? make_front_surface(body.tets) : FrontSurface{},
                     make_rest_tets(body.tets.positions, body.tets.tets), row});
    row += body.tets.num_vertices();
  }
  return parts;
}

StepSettings World::make_settings() const {
  StepSettings settings = step_settings(config_, scales_);
  settings.gravity_m_s2 = options_.gravity_m_s2;
  settings.wrenches_between_bodies = options_.mounts_move;
  if (!options_.pairs) return settings;
  std::vector<std::string> names;
  for (const Body& body : bodies_) names.push_back(body.name);
  double weight_n = 0.0;
  for (const AffineBody& body : affine_) weight_n += body.mass_kg * options_.gravity_m_s2.norm();
  set_pair_laws(*options_.pairs, config_, scales_, names, static_cast<int>(num_gels_), static_cast<int>(parts_.size()),
                weight_n, settings);
  return settings;
}

ContactMesh World::make_mesh() const {
  assert(options_.mounts_move || (parts_.size() == 1 && bodies_[0].start == Matrix4::Identity()));
  std::vector<TetMesh> placed;
  std::vector<TriangleMesh> objects;
  for (const Body& body : bodies_) {
    if (body.deformable()) {
      placed.push_back(body.tets);
      placed.back().positions = transformed(body.start, body.tets.positions);
    } else {
      objects.push_back({transformed(body.start, body.surface.positions), body.surface.triangles});
    }
  }
  const TetMesh whole = options_.mounts_move ? joined(placed) : bodies_[0].tets;
  ContactMesh mesh = make_contact_mesh(whole.positions, whole.boundary, objects);
  mesh.num_control_points = static_cast<int>(4 * affine_.size());
  if (options_.mounts_move) add_gels(mesh);
  return mesh;
}

void World::add_gels(ContactMesh& mesh) const {
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const TetMesh& tets = bodies_[b].tets;
    const std::vector<int> glued = tets.vertices(BoundaryTag::glued);
    mesh.gels.push_back({static_cast<int>(parts_[b].first_row), glued.empty() ? -1 : glued.front(),
                         std::make_shared<const ContactMesh>(
                             make_contact_mesh(tets.positions, tets.boundary, std::vector<TriangleMesh>{}))});
  }
  if (parts_.size() == num_gels_) return;
  mesh.gel_edge_sharpness = edge_sharpness(mesh.gel, mesh.rest_positions);
  // Gels of sensors touch with their smooth fronts, so their edges have no sharpness.
  for (std::size_t e = 0; e < mesh.gel.edges.size(); ++e) {
    if (mesh.gel.edges[e][0] < parts_[num_gels_].first_row) mesh.gel_edge_sharpness[e] = 0.0;
  }
}

std::vector<DeformableBody> World::materials() const {
  std::vector<DeformableBody> all;
  for (std::size_t b = 0; b < parts_.size(); ++b)
    all.push_back({bodies_[b].material, element_of(config_, bodies_[b].material), bodies_[b].tets});
  return all;
}

std::vector<TetStress> World::make_stresses() const {
  std::vector<TetStress> all;
  const std::vector<DeformableBody> bodies = materials();
  for (std::size_t b = 0; config_.stress && b < num_gels_; ++b) all.push_back(tet_stress_of(bodies[b]));
  return all;
}

SymmetricRows World::stress(std::size_t gel, const Positions& x) const {
  const TetStress& elastic = stresses_[gel];
  SymmetricRows second_pa = elastic(x);
  if (model_.viscoelasticity) {
    const SymmetricRows memory = model_.viscoelasticity->remembered(state_.motion.viscous_pa, gel);
    if (memory.rows() > 0) second_pa += memory;
  }
  return cauchy_stress(*elastic.body(), x, second_pa);
}

void World::start() {
  State& motion = state_.motion;
  motion.x.resize(mesh_.num_rows(), 3);
  motion.x.topRows(mesh_.num_vertices()) = mesh_.rest_positions;
  motion.velocity_m_s = Positions::Zero(mesh_.num_gel_vertices, 3);
  motion.object_motion.assign(affine_.size(), {});
  for (std::size_t i = 0; i < affine_.size(); ++i) {
    const Body& body = bodies_[object(i)];
    const ControlPoints at = points_at(i, body.start);
    mesh_.control_rows(motion.x).middleRows<4>(static_cast<Eigen::Index>(4 * i)) = at;
    if (body.velocity_m_s != Vector3::Zero() || body.spin_rad_s != Vector3::Zero())
      motion.object_motion[i] = make_rigid_motion(affine_[i], at, body.velocity_m_s, body.spin_rad_s);
  }
  for (const Body& body : bodies_) state_.world_from_body.push_back(body.start);
  if (!options_.mounts_move) return;
  state_.mount_n = Positions::Zero(mesh_.num_gel_vertices, 3);
  state_.on_others.assign(bodies_.size(), {Vector3::Zero(), Vector3::Zero()});
  state_.between.assign(bodies_.size() * bodies_.size(), {Vector3::Zero(), Vector3::Zero()});
  state_.account =
      open_account(model_.mass_kg, instant(goal(0.0)), options_.gravity_m_s2, model_.elasticity->value(motion.x));
}

SolvedGel World::deformable(std::size_t b) const {
  return {bodies_[b].tets, parts_[b].front, parts_[b].rest_tets, parts_[b].first_row};
}

Simulation World::simulation_of(std::size_t gel) const {
  Simulation simulation;
  const std::size_t other = gel == 0 && bodies_.size() > 1 ? 1 : 0;  // another deformable body, if there are no objects
  const ContactLaw& law =
      laws().of(static_cast<int>(gel), static_cast<int>(object(0) < bodies_.size() ? object(0) : other));
  simulation.friction = law.friction;
  simulation.d_hat_m = law.d_hat_m;
  simulation.barrier_stiffness = law.stiffness * scales_.barrier_stiffness;
  simulation.object_mass_kg = affine_.empty() ? 0.0 : affine_[0].mass_kg;
  simulation.object_may_be_free = !affine_.empty();
  simulation.front = parts_[gel].front;
  simulation.element = element_of(config_, bodies_[gel].material);
  simulation.newton = settings_.newton;
  return simulation;
}

ControlPoints World::points(std::size_t i) const {
  return state_.motion.x.middleRows<4>(mesh_.control_row(static_cast<int>(i)));
}

ControlPoints World::points_at(std::size_t i, const Matrix4& world_from_body) const {
  const Body& body = bodies_[object(i)];
  if (world_from_body == body.affine_pose) return affine_[i].rest_m;
  return transformed(world_from_body * rest_from(body), affine_[i].rest_m);
}

Vector3 World::spin_rad_s(std::size_t i) const {
  return angular_velocity(affine_[i], points(i), state_.motion.object_motion[i]);
}

bool World::is_held(const StepGoal& goal, std::size_t i) {
  return !goal.free_object || std::binary_search(goal.held_bodies.begin(), goal.held_bodies.end(), static_cast<int>(i));
}

StepGoal World::goal(double h_s) const {
  const State& motion = state_.motion;
  return {.h_s = h_s,
          .object_target = mesh_.object_rows(motion.x),
          .free_object = !affine_.empty(),
          .control_target = mesh_.control_rows(motion.x)};
}

void World::hold(StepGoal& goal, std::size_t i, const Matrix4& world_from_body) const {
  const ObjectPart& part = mesh_.objects[i];
  goal.object_target.middleRows(part.first_vertex - mesh_.num_gel_vertices, part.num_vertices) =
      transformed(world_from_body, bodies_[object(i)].surface.positions);
  goal.control_target.middleRows<4>(static_cast<Eigen::Index>(4 * i)) = points_at(i, world_from_body);
  goal.held_bodies.push_back(static_cast<int>(i));
  goal.free_object = goal.held_bodies.size() < affine_.size();
}

void World::move_mounts(StepGoal& goal, const std::vector<Matrix4>& world_from_body) const {
  Positions target = state_.motion.x.topRows(mesh_.num_gel_vertices);
  Vector3 shift = Vector3::Zero();
  int moving = 0;
  goal.gel_motion = Positions::Zero(mesh_.num_gel_vertices, 3);
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const Matrix4 &before = state_.world_from_body[b], &after = world_from_body[b];
    goal.world_from_gel.push_back(after.topLeftCorner<3, 3>());
    goal.mount_motion.push_back(b < num_gels_ ? Matrix4(after * before.inverse()) : Matrix4(Matrix4::Identity()));
    if (b >= num_gels_) continue;
    const Positions at_end = transformed(after, bodies_[b].tets.positions);
    own_rows(b, target) = at_end;
    if (before == after) continue;
    own_rows(b, goal.gel_motion) = at_end - transformed(before, bodies_[b].tets.positions);
    shift += (after - before).topRightCorner<3, 1>();
    ++moving;
  }
  goal.glued_target = target(model_.glued, Eigen::all);
  if (moving == 0) {
    goal.gel_motion.resize(0, 3);
    return;
  }
  for (std::size_t b = num_gels_; b < parts_.size(); ++b)
    own_rows(b, goal.gel_motion).rowwise() +=
        start_of_soft_body(b, world_from_body, shift / moving, goal.h_s).transpose();
}

Vector3 World::start_of_soft_body(std::size_t b, const std::vector<Matrix4>& world_from_body, const Vector3& shift_m,
                                  double h_s) const {
  for (std::size_t gel = 0; gel < num_gels_; ++gel) {
    if (world_from_body[gel] != state_.world_from_body[gel] &&
        state_.between[b * bodies_.size() + gel].force_n != Vector3::Zero())
      return shift_m;
  }
  return h_s * own_rows(b, state_.motion.velocity_m_s).colwise().mean().transpose();
}

StepReport World::advance(const StepGoal& goal, const std::vector<Matrix4>& world_from_body,
                          const IterationObserver& observe) {
  if (!options_.mounts_move) {
    StepReport done = stepper_.advance(state_.motion, goal, observe);
    take_poses(goal, world_from_body);
    return done;
  }
  const WholeInstant before = instant(goal);
  StepReport done = stepper_.advance(state_.motion, goal, observe);
  const std::vector<Matrix4> poses_before = state_.world_from_body;
  take_poses(goal, world_from_body);
  std::vector<int> held;
  for (std::size_t i = 0; i < affine_.size(); ++i) {
    if (is_held(goal, i)) held.push_back(static_cast<int>(i));
  }
  if (held != state_.held) regroup(state_.account, model_.mass_kg, before, options_.gravity_m_s2);
  const StepForces& forces = stepper_.forces();
  state_.between = forces.between;
  StepExchange exchange = exchange_of(goal.h_s, forces, state_.mount_n, model_.elasticity->value(state_.motion.x));
  add_held_and_fixed(held, poses_before, exchange);
  const WholeInstant after = instant(goal);
  add_weights_and_loads(goal, before, after, exchange);
  add_step(state_.account, model_.mass_kg, before, after, options_.gravity_m_s2, exchange);
  state_.mount_n = forces.mount;
  state_.held = std::move(held);
  return done;
}

void World::take_poses(const StepGoal& goal, const std::vector<Matrix4>& world_from_body) {
  state_.world_from_body = world_from_body;
  for (std::size_t i = 0; i < affine_.size(); ++i) {
    const std::size_t b = object(i);
    if (!is_held(goal, i)) state_.world_from_body[b] = pose_of(affine_[i], points(i)) * bodies_[b].affine_pose;
  }
}

WholeInstant World::instant(const StepGoal& goal) const {
  const State& motion = state_.motion;
  WholeInstant now{motion.x.topRows(mesh_.num_gel_vertices), motion.velocity_m_s, {}};
  for (std::size_t i = 0; i < affine_.size(); ++i)
    now.bodies.push_back({&affine_[i], points(i), motion.object_motion[i], is_held(goal, i)});
  return now;
}

void World::add_held_and_fixed(const std::vector<int>& held, const std::vector<Matrix4>& poses_before,
                               StepExchange& exchange) {
  const std::size_t count = bodies_.size();
  const auto in = [&](const std::vector<int>& list, std::size_t b) {
    return b >= object(affine_.size()) ||
           (b >= object(0) && std::binary_search(list.begin(), list.end(), static_cast<int>(b - object(0))));
  };
  for (std::size_t b = 0; b < count; ++b) {
    Wrench now{Vector3::Zero(), Vector3::Zero()};
    const bool outside = in(held, b);
    for (std::size_t a = 0; outside && a < count; ++a) {
      if (in(held, a)) continue;
      now.force_n += state_.between[a * count + b].force_n;
      now.torque_n_m += state_.between[a * count + b].torque_n_m;
    }
    exchange.others.force_n += now.force_n;
    exchange.others.torque_n_m += now.torque_n_m;
    if (outside) {
      // A body that is held from this step on had no holding force before.
      const Wrench& earlier = in(state_.held, b) ? state_.on_others[b] : now;
      // x ↦ R x + t: to first order the body rotates about the world's origin by the vector of R and shifts by t.
      const Matrix4 motion = state_.world_from_body[b] * poses_before[b].inverse();
      const Eigen::AngleAxisd turn(Matrix3(motion.topLeftCorner<3, 3>()));
      exchange.others_work_j += 0.5 * ((now.force_n + earlier.force_n).dot(Vector3(motion.topRightCorner<3, 1>())) +
                                       (now.torque_n_m + earlier.torque_n_m).dot(turn.angle() * turn.axis()));
    }
    state_.on_others[b] = now;
  }
}

void World::add_weights_and_loads(const StepGoal& goal, const WholeInstant& before, const WholeInstant& after,
                                  StepExchange& exchange) const {
  for (std::size_t i = 0; i < affine_.size(); ++i) {
    const Vector3 at = center_of(after.bodies[i].control), shift = at - center_of(before.bodies[i].control);
    if (after.bodies[i].held) {
      // The height of a held body counts, so lifting it is external work.
      exchange.others_work_j -= affine_[i].mass_kg * options_.gravity_m_s2.dot(shift);
      continue;
    }
    if (goal.body_load_n.empty()) continue;
    const Vector3& load = goal.body_load_n[i];
    exchange.others.force_n += load;
    exchange.others.torque_n_m += at.cross(load);
    exchange.others_work_j += load.dot(shift);
  }
}

std::vector<Frame> World::measure(PhaseKind phase, int phase_index, const StepReport& report) {
  const Positions& x = state_.motion.x;
  const bool at_rest = phase_index < 0;
  const StepForces forces = at_rest ? no_forces(mesh_.num_gel_vertices) : stepper_.forces();
  const double gap_m = smallest_gap(scales_.gap_horizon_m);
  double strain = 0.0;
  for (std::size_t i = 0; i < affine_.size(); ++i) strain = std::max(strain, strain_of(affine_[i], points(i)));
  std::vector<Frame> frames;
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const SolvedGel part = deformable(b);
    const auto pose = options_.mounts_move ? std::optional(state_.world_from_body[b]) : std::nullopt;
    Frame frame =
        gel_frame(part, pose, at_rest && b < num_gels_ ? part.gel.positions : positions_in_gel(part, pose, x), forces);
    if (b < stresses_.size()) frame.stress_pa = stress(b, frame.positions);
    if (b >= num_gels_) frame.balance.relative = frame.balance.force_n / most_force_on(b);
    frame.time_s = state_.time_s;
    frame.phase = phase;
    frame.phase_index = phase_index;
    frame.solver = report;
    if (!affine_.empty()) {
      add_object(frame, pose, state_.world_from_body[object(0)], state_.motion.object_motion[0].velocity_m_s,
                 spin_rad_s(0));
    } else {
      frame.gel_from_object = pose ? Matrix4(pose->inverse()) : state_.world_from_body[object(0)];
    }
    frame.body_strain = strain;
    if (gap_m < scales_.gap_horizon_m) frame.min_gap_m = gap_m;
    frames.push_back(std::move(frame));
  }
  return frames;
}

double World::most_force_on(std::size_t b) const {
  // Forces that squeeze a soft body cancel in their sum.
  double most = kSmallestContactN;
  for (std::size_t other = 0; other < bodies_.size(); ++other)
    most = std::max(most, state_.between[b * bodies_.size() + other].force_n.norm());
  return most;
}

void World::judge(int number, std::vector<Frame>& frames) const {
  const int intersections = judge_bodies(number, shapes());
  for (std::size_t b = 0; b < frames.size(); ++b) {
    frames[b].intersections = intersections;
    try {
      judge_frame(number, numbers_of(frames[b]),
                  limits_of(config_, settings_.newton, frames[b].solver.contact_force_n));
    } catch (const VerdictError& error) {
      if (frames.size() == 1) throw;
      throw VerdictError(error.miss(), fmt::format("body {}: {}", bodies_[b].name, error.what()));
    }
  }
}

void World::require_apart() const { tacipc::require_apart(shapes(), laws()); }

WholeAccount World::take_account() {
  WholeAccount account = state_.account;
  state_.account.momentum_residual_n = state_.account.angular_residual_n_m = 0.0;
  return account;
}

std::vector<BodyShape> World::shapes() const {
  const Positions& x = state_.motion.x;
  std::vector<BodyShape> all;
  for (std::size_t b = 0; b < parts_.size(); ++b)
    all.push_back({.name = bodies_[b].name,
                   .positions = own_rows(b, x),
                   .triangles = bodies_[b].tets.boundary,
                   .deformable = true});
  for (std::size_t i = 0; i < mesh_.objects.size(); ++i) {
    const Body& body = bodies_[object(i)];
    all.push_back({.name = body.name,
                   .positions = body.affine ? Positions(mesh_.objects[i].rows(x))
                                            : transformed(state_.world_from_body[object(i)], body.surface.positions),
                   .triangles = body.surface.triangles,
                   .fixed = !body.affine,
                   .closed = body.closed});
  }
  return all;
}

}  // namespace tacipc
