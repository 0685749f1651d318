#include "stages/gel/press/drive/scene.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/mass_properties.h"
#include "common/sample/placement.h"
#include "stages/gel/press/contact/sharpness.h"
#include "stages/gel/press/contact/surface_pairs.h"
#include "stages/gel/press/drive/checkpoint.h"
#include "stages/gel/press/drive/divided_step.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/solve/step_limit.h"
#include "stages/gel/press/world/gel_frame.h"
#include "stages/gel/press/world/scene_checks.h"
#include "stages/gel/press/world/setup.h"

namespace tacipc {
namespace {

// A pair of hard bodies pushes with this times κ d̂³/h² at half of d̂ (bound by the shape of the barrier, barrier.h); it
// should bear the weight of a body on a few corners there.
constexpr double kForceAtHalf = 4.3, kCorners = 4.0;
constexpr std::size_t kMostBodies = 200;

/// A deformable body as one part of the whole.
struct Part {
  std::size_t body;
  FrontSurface front;  // of a gel
  std::vector<RestTet> rest_tets;
  Eigen::Index first_row;
};

class Stepping {
 public:
  Stepping(const Sensor& sensor, const std::vector<SceneBody>& bodies, const PressConfig& config, const SceneSpec& spec,
           const ProgressObserver& observe, ByteStore* store)
      : bodies_(bodies),
        config_(config),
        spec_(spec),
        observe_(observe),
        store_(store),
        scales_(scales_of(config, sensor, bodies[0].tets)),
        settings_(step_settings(config, scales_)),
        gel_friction_(config.with_friction_of(sensor).coefficient_of_friction()),
        num_gels_(static_cast<std::size_t>(spec.count(BodyKind::gel))),
        num_deformable_(num_gels_ + static_cast<std::size_t>(spec.count(BodyKind::soft))),
        num_rigid_(static_cast<std::size_t>(spec.count(BodyKind::rigid))) {
    require_rigid_mount(sensor);
    if (config.augmented_lagrangian)
      throw UsageError("constraints: augmented_lagrangian holds one gel and one object; a scene needs elimination");
    if (config.gravity_m_s2 != Vector3::Zero())
      throw UsageError("gravity_m_s2 is along the axes of one gel; a scene has it in the sample");
    if (spec.time_step_s && *spec.time_step_s != config.time_step_s)
      throw UsageError(
          fmt::format("time_step_s: the paths of the scene are made for steps of {:g} s, the press file has {:g} s",
                      *spec.time_step_s, config.time_step_s));
    if (config.mass_damping_per_s > 0.0) throw UsageError("damping.mass_per_s would hold back bodies that move");
    if (config.quasi_static && num_deformable_ > num_gels_)
      throw UsageError("dynamics: quasi_static holds only what a mount holds; soft bodies need inertia");
    if (bodies.size() > kMostBodies) throw UsageError(fmt::format("a scene has at most {} bodies", kMostBodies));
    settings_.gravity_m_s2 = spec.gravity_m_s2;
    settings_.wrenches_between_bodies = true;
    int time_steps = 0;
    for (const ScenePhase& phase : spec.motion) {
      num_frames_ += phase.steps;
      time_steps += phase.steps * phase.substeps;
    }
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies[b].path.empty()) check_path(spec.bodies[b].name, bodies[b].path, time_steps);
    }
    place_all();
    set_laws();
  }

  Scene run() {
    std::vector<DeformableBody> materials;
    for (const Part& part : parts_) {
      const SceneBody& body = bodies_[part.body];
      materials.push_back({body.material, element_of(config_, body.material), body.tets});
    }
    model_ = make_gel_model(materials);
    TimeStepper stepper(mesh_, model_, settings_, affine_);
    stepper_ = &stepper;
    for (std::size_t g = 0; g < num_gels_; ++g) {
      Simulation& gel = out_.gels.emplace_back();
      gel.d_hat_m = scales_.d_hat_m;
      gel.gap_horizon_m = scales_.gap_horizon_m;
      gel.barrier_stiffness = scales_.barrier_stiffness;
      gel.newton = settings_.newton;
      gel.element = materials[g].element;
      gel.object_may_be_free = num_rigid_ > 0;
      gel.object_mass_kg = num_rigid_ > 0 ? affine_[0].mass_kg : 0.0;
      gel.front = parts_[g].front;
    }
    for (const AffineBody& body : affine_) out_.mass_kg.push_back(body.mass_kg);
    State& state = progress_.state;
    state.x.resize(mesh_.num_rows(), 3);
    state.x.topRows(mesh_.num_vertices()) = mesh_.rest_positions;
    state.velocity_m_s = Positions::Zero(mesh_.num_gel_vertices, 3);
    state.object_motion.clear();
    for (std::size_t i = 0; i < num_rigid_; ++i) {
      const BodySpec& body = spec_.bodies[num_deformable_ + i];
      mesh_.control_rows(state.x).middleRows<4>(static_cast<Eigen::Index>(4 * i)) = affine_[i].rest_m;
      state.object_motion.push_back(
          make_rigid_motion(affine_[i], affine_[i].rest_m, body.velocity_m_s, body.spin_rad_s));
    }
    progress_.mount_n = Positions::Zero(mesh_.num_gel_vertices, 3);
    progress_.others.assign(bodies_.size(), {Vector3::Zero(), Vector3::Zero()});
    account_ = open_account(model_.mass_kg, instant({}), spec_.gravity_m_s2, model_.elasticity->value(state.x));
    if (!restored()) {
      require_apart(shapes(), [&](std::size_t a, std::size_t b) {
        return scales_.d_hat_m * mesh_.laws[a * bodies_.size() + b].d_hat;
      });
      finish(-1, {}, stepper.no_forces());
    }
    for (std::size_t p = 0; p < spec_.motion.size(); ++p) run_phase(spec_.motion[p], static_cast<int>(p));
    out_.times = stepper.times();
    for (Simulation& gel : out_.gels) gel.times = out_.times;
    return std::move(out_);
  }

 private:
  void place_all() {
    std::vector<PlacedGel> placed;
    Eigen::Index row = 0;
    for (std::size_t b = 0; b < num_deformable_; ++b) {
      const SceneBody& body = bodies_[b];
      placed.push_back({body.tets, start_pose(b)});
      parts_.push_back({b, b < num_gels_ ? make_front_surface(body.tets) : FrontSurface{},
                        make_rest_tets(body.tets.positions, body.tets.tets), row});
      row += body.tets.num_vertices();
    }
    const TetMesh whole = joined(placed);
    glued_ = whole.vertices(BoundaryTag::glued);
    std::vector<TriangleMesh> objects;
    for (std::size_t b = num_deformable_; b < bodies_.size(); ++b) {
      const BodySpec& body = spec_.bodies[b];
      TriangleMesh object = bodies_[b].surface;
      try {
        if (!check_object(object, config_)) throw DataError("the object is not closed");
        require_solid(mass_properties(object.positions, object.triangles).second_moment_m2);
      } catch (const DataError& error) {
        throw DataError("body {}: {}", body.name, error.what());
      }
      object.positions = transformed(start_pose(b), object.positions);
      if (body.kind == BodyKind::rigid) {
        const MassProperties mass = mass_properties(object.positions, object.triangles);
        affine_.push_back(make_affine_body(object.positions, object.triangles, body.mass.density_of(mass.volume_m3)));
      }
      objects.push_back(std::move(object));
    }
    mesh_ = make_contact_mesh(whole.positions, whole.boundary, objects);
    mesh_.num_control_points = static_cast<int>(4 * num_rigid_);
    for (const Part& part : parts_) {
      const TetMesh& tets = bodies_[part.body].tets;
      const std::vector<int> glued = tets.vertices(BoundaryTag::glued);
      mesh_.gels.push_back({static_cast<int>(part.first_row), glued.empty() ? -1 : glued.front(),
                            std::make_shared<const ContactMesh>(
                                make_contact_mesh(tets.positions, tets.boundary, std::vector<TriangleMesh>{}))});
    }
    if (num_deformable_ > num_gels_) {
      mesh_.gel_edge_sharpness = edge_sharpness(mesh_.gel, mesh_.rest_positions);
      // Sensors' gels touch with their faces.
      for (std::size_t e = 0; e < mesh_.gel.edges.size(); ++e) {
        if (mesh_.gel.edges[e][0] < parts_[num_gels_].first_row) mesh_.gel_edge_sharpness[e] = 0.0;
      }
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b) poses_.push_back(start_pose(b));
  }

  void set_laws() {
    const auto count = spec_.bodies.size();
    std::vector<double> friction(count * count, config_.coefficient_of_friction()),
        d_hat(count * count, scales_.d_hat_m);
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = 0; b < count; ++b) {
        if (std::min(a, b) < num_gels_) friction[a * count + b] = gel_friction_;
      }
    }
    for (const ContactSpec& contact : spec_.contact) {
      const auto a = static_cast<std::size_t>(contact.between[0]), b = static_cast<std::size_t>(contact.between[1]);
      for (const std::size_t at : {a * count + b, b * count + a}) {
        if (contact.friction) friction[at] = *contact.friction;
        if (contact.d_hat_m) d_hat[at] = *contact.d_hat_m;
      }
      if (contact.d_hat_m && *contact.d_hat_m > scales_.d_hat_m)
        throw UsageError(fmt::format("contact of {} and {}: d_hat_mm is more than that of the gels, {:.4g} mm",
                                     spec_.bodies[a].name, spec_.bodies[b].name, 1e3 * scales_.d_hat_m));
    }
    const double most = *std::max_element(friction.begin(), friction.end());
    if (most > 0.0 && !config_.friction)
      throw UsageError("the press file has no section friction, which says how friction between bodies is solved");
    if (most > 0.0 && settings_.friction) {
      settings_.friction->coefficient = most;
    } else if (most > 0.0) {
      // The press file's own coefficient is zero.
      PressConfig with = config_;
      with.friction->coefficient = most;
      settings_.friction = step_settings(with, scales_).friction;
    }
    double weight_n = 0.0;
    for (const AffineBody& body : affine_) weight_n += body.mass_kg * spec_.gravity_m_s2.norm();
    double load_n = 0.0;
    for (const ScenePhase& phase : spec_.motion) {
      for (const auto& load : phase.load_n) load_n = std::max(load_n, load.second.norm());
    }
    weight_n += load_n;
    const double own_n = settings_.barrier_stiffness_j_m4 * std::pow(scales_.d_hat_m, 3);
    mesh_.laws.resize(count * count);
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = 0; b < count; ++b) {
        PairLaw& law = mesh_.laws[a * count + b];
        law.friction = most > 0.0 ? friction[a * count + b] / most : 1.0;
        law.d_hat = d_hat[a * count + b] / scales_.d_hat_m;
        const bool hard = a >= num_deformable_ && b >= num_deformable_;
        const double wanted_n = hard ? std::max(own_n, weight_n / (kCorners * kForceAtHalf)) : own_n;
        law.stiffness = wanted_n / own_n / std::pow(law.d_hat, 3);
      }
    }
  }

  auto own_rows(const Part& part, Positions& rows) const {
    return rows.middleRows(part.first_row, bodies_[part.body].tets.num_vertices());
  }

  bool is_gel(const Part& part) const { return part.body < num_gels_; }

  Matrix4 start_pose(std::size_t body) const {
    return bodies_[body].path.empty() ? spec_.bodies[body].world_from_body : bodies_[body].path.front();
  }

  /// Where a phase has its bodies after a part of it.
  std::vector<Matrix4> poses_in(const ScenePhase& phase, const std::vector<Matrix4>& start, double part) const {
    std::vector<Matrix4> poses = poses_;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!bodies_[b].path.empty())
        poses[b] = pose_on_path(bodies_[b].path, steps_before_ + part * phase.steps * phase.substeps);
    }
    for (const WaySpec& way : phase.move) {
      const auto body = static_cast<std::size_t>(way.body);
      poses[body] = moved(start[body], way.way * (way.smooth ? smooth_part(part) : part));
    }
    return poses;
  }

  /// One time step of a phase, between two parts of it; divided where it does not converge.
  void step(const ScenePhase& phase, const std::vector<Matrix4>& start, double from, double to, int halvings,
            StepReport& report) {
    const double h = (to - from) * phase.steps * phase.substeps * config_.time_step_s;
    const std::vector<Matrix4> poses = poses_in(phase, start, to);
    StepGoal goal{.h_s = h, .object_target = mesh_.object_rows(progress_.state.x)};
    Positions target = progress_.state.x.topRows(mesh_.num_gel_vertices);
    Vector3 shift = Vector3::Zero();
    int moving = 0;
    goal.gel_motion = Positions::Zero(mesh_.num_gel_vertices, 3);
    for (const Part& part : parts_) {
      const Matrix4 &before = poses_[part.body], &after = poses[part.body];
      goal.world_from_gel.push_back(after.topLeftCorner<3, 3>());
      goal.mount_motion.push_back(is_gel(part) ? Matrix4(after * before.inverse()) : Matrix4(Matrix4::Identity()));
      if (!is_gel(part)) continue;
      const Positions& rest = bodies_[part.body].tets.positions;
      target.middleRows(part.first_row, rest.rows()) = transformed(after, rest);
      if (before == after) continue;
      goal.gel_motion.middleRows(part.first_row, rest.rows()) = transformed(after, rest) - transformed(before, rest);
      shift += (after - before).topRightCorner<3, 1>();
      ++moving;
    }
    if (moving == 0) {
      goal.gel_motion.resize(0, 3);
    } else {
      for (const Part& part : parts_) {
        if (!is_gel(part))
          own_rows(part, goal.gel_motion).rowwise() += way_of_soft(part, poses, shift / moving, h).transpose();
      }
    }
    goal.glued_target = target(glued_, Eigen::all);
    goal.control_target = mesh_.control_rows(progress_.state.x);
    for (std::size_t i = 0; i < num_rigid_; ++i) {
      const std::size_t body = num_deformable_ + i;
      const bool moves = !bodies_[body].path.empty() ||
                         std::any_of(phase.move.begin(), phase.move.end(),
                                     [&](const WaySpec& way) { return way.body == static_cast<int>(body); });
      const bool held =
          moves || std::find(phase.hold.begin(), phase.hold.end(), static_cast<int>(body)) != phase.hold.end();
      goal.body_load_n.push_back(load_in(phase, body, to));
      if (!held) continue;
      goal.held_bodies.push_back(static_cast<int>(i));
      const Matrix4 from_start = poses[body] * start_pose(body).inverse();
      const ObjectPart& object = mesh_.objects[i];
      goal.object_target.middleRows(object.first_vertex - mesh_.num_gel_vertices, object.num_vertices) =
          transformed(poses[body], bodies_[body].surface.positions);
      goal.control_target.middleRows<4>(static_cast<Eigen::Index>(4 * i)) = transformed(from_start, affine_[i].rest_m);
    }
    goal.free_object = goal.held_bodies.size() < num_rigid_;
    require_free_way(goal);
    const WholeInstant at_start = instant(goal.held_bodies);
    const std::vector<Matrix4> poses_before = poses_;
    const auto advance = [&] {
      StepReport done = stepper_->advance(progress_.state, goal, [&](int iteration, double residual) {
        observe_(static_cast<int>(out_.frames.size()), num_frames_, iteration, residual);
      });
      poses_ = poses;
      for (std::size_t i = 0; i < num_rigid_; ++i) {
        const std::size_t body = num_deformable_ + i;
        if (!std::binary_search(goal.held_bodies.begin(), goal.held_bodies.end(), static_cast<int>(i)))
          poses_[body] = pose_of(affine_[i], points(i)) * start_pose(body);
      }
      if (goal.held_bodies != progress_.held_bodies) regroup(account_, model_.mass_kg, at_start, spec_.gravity_m_s2);
      note_step(goal, at_start, poses_before);
      return done;
    };
    advance_or_divide(out_.frames.size(), halvings, config_.max_halvings, report, advance, [&](int deeper) {
      const double middle = 0.5 * (from + to);
      step(phase, start, from, middle, deeper, report);
      step(phase, start, middle, to, deeper, report);
    });
  }

  WholeInstant instant(const std::vector<int>& held) const {
    const State& state = progress_.state;
    WholeInstant now{state.x.topRows(mesh_.num_gel_vertices), state.velocity_m_s, {}};
    for (std::size_t i = 0; i < num_rigid_; ++i)
      now.bodies.push_back({&affine_[i], points(i), state.object_motion[i],
                            std::binary_search(held.begin(), held.end(), static_cast<int>(i))});
    return now;
  }

  /// Energy and momentum of a time step that succeeded.
  void note_step(const StepGoal& goal, const WholeInstant& before, const std::vector<Matrix4>& poses_before) {
    const StepForces& forces = stepper_->forces();
    StepExchange exchange =
        exchange_of(goal.h_s, forces, progress_.mount_n, model_.elasticity->value(progress_.state.x));
    const std::size_t count = bodies_.size();
    std::vector<bool> outside(count, false);
    for (std::size_t b = num_deformable_ + num_rigid_; b < count; ++b) outside[b] = true;
    for (const int i : goal.held_bodies) outside[num_deformable_ + static_cast<std::size_t>(i)] = true;
    for (std::size_t b = 0; b < count; ++b) {
      Wrench now{Vector3::Zero(), Vector3::Zero()};
      for (std::size_t a = 0; outside[b] && a < count; ++a) {
        if (outside[a]) continue;
        now.force_n += forces.between[a * count + b].force_n;
        now.torque_n_m += forces.between[a * count + b].torque_n_m;
      }
      exchange.others.force_n += now.force_n;
      exchange.others.torque_n_m += now.torque_n_m;
      if (!outside[b]) {
        progress_.others[b] = now;
        continue;
      }
      // Whoever only now begins to hold it had no force on it before.
      const bool before_too = b >= num_deformable_ + num_rigid_ ||
                              std::binary_search(progress_.held_bodies.begin(), progress_.held_bodies.end(),
                                                 static_cast<int>(b - num_deformable_));
      const Wrench& earlier = before_too ? progress_.others[b] : now;
      // x ↦ R x + t: about the world's origin the body turns by the vector of R and shifts by t, to first order.
      const Matrix4 way = poses_[b] * poses_before[b].inverse();
      const Eigen::AngleAxisd turn(Matrix3(way.topLeftCorner<3, 3>()));
      exchange.others_work_j += 0.5 * ((now.force_n + earlier.force_n).dot(Vector3(way.topRightCorner<3, 1>())) +
                                       (now.torque_n_m + earlier.torque_n_m).dot(turn.angle() * turn.axis()));
      progress_.others[b] = now;
    }
    const WholeInstant after = instant(goal.held_bodies);
    for (std::size_t i = 0; i < num_rigid_; ++i) {
      const Vector3 at = center_of(after.bodies[i].control), way = at - center_of(before.bodies[i].control);
      if (after.bodies[i].held) {
        // Its height counts, so whoever lifts it does that work, too.
        exchange.others_work_j -= affine_[i].mass_kg * spec_.gravity_m_s2.dot(way);
        continue;
      }
      const Vector3& load = goal.body_load_n[i];
      exchange.others.force_n += load;
      exchange.others.torque_n_m += at.cross(load);
      exchange.others_work_j += load.dot(way);
    }
    add_step(account_, model_.mass_kg, before, after, spec_.gravity_m_s2, exchange);
    progress_.mount_n = forces.mount;
    progress_.held_bodies = goal.held_bodies;
  }

  /// Where a soft body's step starts from while mounts move: along with them if it touches one that does, else where it
  /// would fly to.
  Vector3 way_of_soft(const Part& part, const std::vector<Matrix4>& poses, const Vector3& shift, double h) {
    const std::vector<Wrench>& between = stepper_->forces().between;
    for (std::size_t gel = 0; gel < num_gels_ && !between.empty(); ++gel) {
      if (poses[gel] != poses_[gel] && between[part.body * bodies_.size() + gel].force_n != Vector3::Zero())
        return shift;
    }
    return h * own_rows(part, progress_.state.velocity_m_s).colwise().mean().transpose();
  }

  Vector3 load_in(const ScenePhase& phase, std::size_t body, double part) const {
    const Vector3& before = loads_n_[body - num_deformable_];
    for (const auto& [of, load] : phase.load_n) {
      if (of == static_cast<int>(body)) return before + part * (load - before);
    }
    return before;
  }

  ControlPoints points(std::size_t rigid) const {
    return progress_.state.x.middleRows<4>(mesh_.control_row(static_cast<int>(rigid)));
  }

  void run_phase(const ScenePhase& phase, int index) {
    const std::vector<Matrix4> start = poses_;
    const double start_s = time_s_;
    const int steps = phase.steps * phase.substeps;
    for (int f = 1; f <= phase.steps; ++f) {
      if (restored()) continue;
      StepReport report;
      try {
        for (int k = 0; k < phase.substeps; ++k) {
          const int i = (f - 1) * phase.substeps + k;
          step(phase, start, static_cast<double>(i) / steps, (i + 1.0) / steps, 0, report);
        }
      } catch (const SolverError& error) {
        throw SolverError("frame {}: {}", out_.frames.size(), error.what());
      }
      time_s_ = start_s + f * phase.substeps * config_.time_step_s;
      finish(index, report, stepper_->forces());
    }
    steps_before_ += steps;
    for (std::size_t i = 0; i < num_rigid_; ++i) loads_n_[i] = load_in(phase, num_deformable_ + i, 1.0);
  }

  bool restored() {
    if (!store_ || !restoring_) return false;
    const std::optional<std::string> bytes = store_->load();
    restoring_ = bytes.has_value();
    if (!restoring_) return false;
    SceneFrame frame;
    std::vector<Frame> of_gels(num_gels_);
    unpack_frame(*bytes, frame, of_gels, progress_);
    for (std::size_t g = 0; g < num_gels_; ++g) out_.gels[g].frames.push_back(std::move(of_gels[g]));
    time_s_ = frame.time_s;
    poses_ = frame.world_from_body;
    account_ = frame.whole;
    account_.momentum_residual_n = account_.angular_residual_n_m = 0.0;
    require_on_path();
    log_info("frame {}/{} resumed from an interrupted run", out_.frames.size(), num_frames_);
    out_.frames.push_back(std::move(frame));
    return true;
  }

  /// Frames that were solved before may be of other paths.
  void require_on_path() const {
    constexpr double kApart_m = 1e-4;
    int at = 0;
    for (std::size_t p = 0, left = out_.frames.size(); p < spec_.motion.size() && left > 0; ++p) {
      const auto frames = std::min(left, static_cast<std::size_t>(spec_.motion[p].steps));
      at += static_cast<int>(frames) * spec_.motion[p].substeps;
      left -= frames;
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b].path.empty()) continue;
      const Matrix4 apart = poses_[b] - bodies_[b].path[static_cast<std::size_t>(at)];
      if (apart.topRightCorner<3, 1>().norm() > kApart_m)
        throw DataError("frame {}: body {} was solved {:.3g} mm from where its path has it: of another motion",
                        out_.frames.size(), name(b), 1e3 * apart.topRightCorner<3, 1>().norm());
    }
  }

  const std::string& name(std::size_t body) const { return spec_.bodies[body].name; }
  std::vector<BodyShape> shapes() const {
    const Positions& x = progress_.state.x;
    std::vector<BodyShape> all;
    for (const Part& part : parts_) {
      const TetMesh& tets = bodies_[part.body].tets;
      all.push_back({.name = name(part.body),
                     .positions = x.middleRows(part.first_row, tets.num_vertices()),
                     .triangles = tets.boundary,
                     .deformable = true});
    }
    for (std::size_t i = 0; i < mesh_.objects.size(); ++i) {
      const std::size_t body = num_deformable_ + i;
      all.push_back({.name = name(body),
                     .positions = mesh_.objects[i].rows(x),
                     .triangles = bodies_[body].surface.triangles,
                     .fixed = i >= num_rigid_});
    }
    return all;
  }

  /// Bodies that go where they are told do not feel each other: none may run into another.
  void require_free_way(const StepGoal& goal) const {
    const Positions& x = progress_.state.x;
    Positions p = Positions::Zero(x.rows(), 3);
    for (const int i : goal.held_bodies) {
      const ObjectPart& object = mesh_.objects[static_cast<std::size_t>(i)];
      object.rows(p) =
          goal.object_target.middleRows(object.first_vertex - mesh_.num_gel_vertices, object.num_vertices) -
          object.rows(x);
    }
    for (const int i : goal.held_bodies) {
      const auto a = static_cast<std::size_t>(i);
      for (std::size_t b = 0; b < mesh_.objects.size(); ++b) {
        const bool told = b >= num_rigid_ ||
                          std::binary_search(goal.held_bodies.begin(), goal.held_bodies.end(), static_cast<int>(b));
        if (!told || (b < num_rigid_ && b <= a)) continue;
        std::vector<ContactPair> pairs;
        pairs_between(mesh_.objects[a].surface, mesh_.objects[b].surface, x, p, 0.0, pairs);
        if (contact_step_limit(pairs, x, p, {.slack = 0.01}) < 1.0)
          throw DataError("frame {}: {} runs into {}: both go where the scene says", out_.frames.size(),
                          name(num_deformable_ + a), name(num_deformable_ + b));
      }
    }
  }

  void finish(int phase_index, const StepReport& report, const StepForces& forces) {
    const Positions& x = progress_.state.x;
    SceneFrame frame{
        .time_s = time_s_, .phase_index = phase_index, .world_from_body = poses_, .whole = account_, .solver = report};
    account_.momentum_residual_n = account_.angular_residual_n_m = 0.0;
    for (std::size_t i = 0; i < num_rigid_; ++i) {
      const RigidMotion& motion = progress_.state.object_motion[i];
      frame.velocity_m_s.push_back(motion.velocity_m_s);
      frame.spin_rad_s.push_back(angular_velocity(affine_[i], points(i), motion));
      frame.strain.push_back(strain_of(affine_[i], points(i)));
    }
    frame.between = forces.between;
    if (frame.between.empty())
      frame.between.assign(bodies_.size() * bodies_.size(), {Vector3::Zero(), Vector3::Zero()});
    frame.min_gap_m = stepper_->smallest_gap(x, scales_.gap_horizon_m);
    frame.intersections = judge_bodies(static_cast<int>(out_.frames.size()), shapes());
    std::vector<Frame> of_gels;
    for (const Part& part : parts_) {
      const SolvedGel gel{bodies_[part.body].tets, part.front, part.rest_tets, part.first_row};
      const Matrix4& pose = poses_[part.body];
      const bool at_rest = phase_index < 0 && is_gel(part);
      Frame own = gel_frame(gel, pose, at_rest ? gel.gel.positions : positions_in_gel(gel, pose, x), forces);
      if (!is_gel(part)) {
        // Those that squeeze it cancel in their sum.
        double most = kSmallestContactN;
        for (std::size_t b = 0; b < bodies_.size(); ++b)
          most = std::max(most, frame.between[part.body * bodies_.size() + b].force_n.norm());
        own.balance.relative = own.balance.force_n / most;
      }
      own.time_s = time_s_;
      own.phase = phase_index < 0 ? PhaseKind::reference : PhaseKind::path;
      own.phase_index = phase_index;
      own.solver = report;
      if (num_rigid_ > 0) {
        add_object(own, pose, poses_[num_deformable_], frame.velocity_m_s[0], frame.spin_rad_s[0]);
        own.body_strain = *std::max_element(frame.strain.begin(), frame.strain.end());
      } else {
        own.gel_from_object = pose.inverse();
      }
      own.min_gap_m = frame.min_gap_m;
      own.intersections = frame.intersections;
      try {
        judge_frame(static_cast<int>(out_.frames.size()), numbers_of(own),
                    limits_of(config_, settings_.newton, report.contact_force_n));
      } catch (const VerdictError& error) {
        throw VerdictError(error.miss(), fmt::format("body {}: {}", name(part.body), error.what()));
      }
      if (is_gel(part)) {
        of_gels.push_back(own);
        out_.gels[part.body].frames.push_back(std::move(own));
      } else {
        frame.soft_m.emplace_back(x.middleRows(part.first_row, gel.gel.num_vertices()));
      }
    }
    log_info("frame {}/{}: {} Newton iterations in {} steps, smallest gap {:.3g} um", out_.frames.size(), num_frames_,
             report.newton_iterations, report.time_steps, 1e6 * frame.min_gap_m);
    out_.frames.push_back(std::move(frame));
    if (store_) store_->save(pack_frame(out_.frames.back(), of_gels, progress_));
  }

  const std::vector<SceneBody>& bodies_;
  const PressConfig& config_;
  const SceneSpec& spec_;
  const ProgressObserver& observe_;
  ByteStore* store_;
  const Scales scales_;
  StepSettings settings_;
  const double gel_friction_;  // coefficient, of gels with whatever they touch
  const std::size_t num_gels_, num_deformable_, num_rigid_;
  Scene out_;
  std::vector<Part> parts_;
  std::vector<AffineBody> affine_;  // rigid bodies, at rest where they start
  ContactMesh mesh_;
  GelModel model_;
  std::vector<int> glued_;
  TimeStepper* stepper_ = nullptr;
  SceneProgress progress_;
  WholeAccount account_;
  std::vector<Matrix4> poses_;                                                        // world_from_body
  std::vector<Vector3> loads_n_ = std::vector<Vector3>(num_rigid_, Vector3::Zero());  // at the start of the phase
  double time_s_ = 0.0;
  int num_frames_ = 0;
  int steps_before_ = 0;  // time steps of the phases before this one
  bool restoring_ = true;
};

}  // namespace

Scene run_scene(const Sensor& sensor, const std::vector<SceneBody>& bodies, const PressConfig& config,
                const SceneSpec& spec, const ProgressObserver& observe, ByteStore* store) {
  return Stepping(sensor, bodies, config, spec, observe, store).run();
}

}  // namespace tacipc
