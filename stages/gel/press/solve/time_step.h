// One time step: brings objects to their prescribed poses and all else to the minimum of the incremental potential.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "common/sample/contact_state.h"
#include "stages/gel/press/contact/pair_counting.h"
#include "stages/gel/press/energy/affine_body.h"
#include "stages/gel/press/energy/friction.h"
#include "stages/gel/press/energy/viscoelasticity.h"
#include "stages/gel/press/solve/local_patch.h"
#include "stages/gel/press/solve/newton_step.h"
#include "stages/gel/press/solve/rigid_motion.h"
#include "stages/gel/press/solve/step_limit.h"

namespace tacipc {

/// When a step counts as solved, and what it may cost.
struct NewtonSettings {
  double velocity_tolerance_m_s = 0.0;     // max |p| / h of the Newton step p, below which it has converged …
  double relative_force_tolerance = 5e-4;  // … if residual forces also sum to less than this part of the contact force
  double force_tolerance_n = 1e-5;         // … or to less than this
  int max_iterations = 200;                // of a time step, renewals of friction included; reaching it is a failure
  bool adaptive_contact_hessian = true;    // blend of the exact one and its PSD approximation, else the latter alone
  bool patches = true;                     // solves for the last few moving vertices alone in between

  /// What residual forces may sum to beside this contact force.
  double force_limit_n(double contact_force_n) const {
    return std::max(force_tolerance_n, relative_force_tolerance * contact_force_n);
  }
};

struct FrictionSettings {
  double speed_threshold_m_s = 0.0;     // ε_v
  int max_lag_iterations = 1;           // 1: normal forces and tangent planes of the start of the step
  bool renewed_only_at_minima = false;  // else before each iteration of Newton's method, too
  double relative_lag_tolerance = 0.0;
};

/// What holds during a whole simulation.
struct StepSettings {
  ContactLaws laws = ContactLaws();     // of each two bodies
  double front_edge_m = 0.0;            // median edge of the gel's front
  double barrier_stiffness_j_m4 = 0.0;  // κ/h² of the nominal time step, which a divided step keeps
  bool adaptive_barrier = false;        // State::barrier_factor grows where gaps get small
  PairCounting pair_counting = {};
  std::optional<FrictionSettings> friction = std::nullopt;
  bool quasi_static = false;
  bool augmented_lagrangian = false;  // glued and object vertices by multipliers, else eliminated
  Vector3 gravity_m_s2 = Vector3::Zero();
  double mass_damping_per_s = 0.0;
  double stiffness_damping_s = 0.0;
  bool wrenches_between_bodies = false;  // StepForces::between, without bodies that may be free, too
  LinearSolverKind linear_solver = LinearSolverKind::direct;
  NewtonSettings newton;
};

/// The gel as the solver sees it; constant during a simulation.
struct GelModel {
  std::shared_ptr<const EnergyTerm> elasticity;  // over all tetrahedra; of several bodies JoinedTerm
  Tetrahedra tets;
  Eigen::VectorXd mass_kg;
  std::vector<int> glued;
  std::shared_ptr<const Viscoelasticity> viscoelasticity = nullptr;  // over the same; null: elastic
};

/// Where objects go in one step.
struct StepGoal {
  double h_s = 0.0;
  Positions object_target;           // of their vertices; along free axes, where they would be without any shift
  std::vector<int> free_axes = {};   // of S, along which the object moves as loads, its mount and contact have it
  Vector3 load_n = Vector3::Zero();  // on the object, along those without a mount
  double object_mass_kg = 0.0;       // its inertia along these; > 0 if there are any
  /// Of a mount that gives way, along free axes, 0 along others: a spring without mass pulls the object to where it
  /// would be on a rigid one, and object_target is already `mount_shift_m` past that.
  Vector3 mount_stiffness_n_m = Vector3::Zero(), mount_shift_m = Vector3::Zero();
  /// Bodies move and turn as their weight, the load at their centre of mass, and contact have it: nothing of them is
  /// prescribed. \pre there are bodies
  bool free_object = false;
  std::vector<int> held_bodies = {};      // but for these, ascending
  std::vector<Vector3> body_load_n = {};  // on each body, held or not; empty: load_n on the only one
  /// How gels go that are carried by their mounts: for each of their vertices the way it would go if the gel moved
  /// rigidly with its mount, and where glued vertices end, in the order of GelModel::glued. Empty: no mount moves.
  Positions gel_motion = {}, glued_target = {};
  /// What all mounts have in common, a rigid motion of the world: a free object that they hold starts from there, and
  /// where it turns, friction and damping count what is left of each motion beside it.
  Matrix4 hand_motion = Matrix4::Identity();
  std::vector<Matrix3> world_from_gel = {};  // how several gels are turned at its end; empty for one
  /// Rigid motion of each of several gels with its mount, the identity of a body without one; empty: hand_motion.
  std::vector<Matrix4> mount_motion = {};
  /// Of the bodies' points, as object_target is of their vertices; rows of those that are free do not matter.
  Positions control_target = {};
};

/// What moves; rows of gel, object, and the points that carry an object that may be free.
struct State {
  Positions x;
  Positions velocity_m_s;                                                // gel rows
  Vector3 object_velocity_m_s = Vector3::Zero();                         // along axes of a load
  std::vector<RigidMotion> object_motion = std::vector<RigidMotion>(1);  // of each object that may be free
  double barrier_factor = 1.0;                                           // on the barrier's stiffness in the next step
  Viscoelasticity::History viscous_pa = {};                              // of a gel whose stress relaxes
};

/// What a step took and where it ended.
struct StepReport {
  int time_steps = 0;           // more than asked for where a step had to be divided
  int newton_iterations = 0;    // linear systems solved, those that moved the object included
  int moving_iterations = 0;    // those that moved the object
  int patches = 0;              // times that a few vertices were solved for alone,
  int patch_iterations = 0;     // and Newton iterations of those
  int lag_iterations = 0;       // how often friction was renewed, before iterations and at minima
  int exact_hessian_waits = 0;  // iterations that were within the tolerances and went on for want of the exact Hessian
  double approximated_share = 0.0;  // largest share of the contact Hessian's PSD approximation in the last direction
  double velocity_residual_m_s = 0.0;
  /// Σ over free vertices of |residual force|; of several gels the one where it is the largest part of what it may be
  /// there, times what it may be at contact_force_n.
  double force_residual_n = 0.0;
  double barrier_factor = 1.0;       // on the barrier's stiffness
  double friction_residual_n = 0.0;  // residual force if normal forces and tangent planes were renewed now
  /// |Σ contact forces on the gel|, with or without friction: the less; of several gels on the one touched least, where
  /// none is touched on a body.
  double contact_force_n = 0.0;
  Vector3 object_shift_m = Vector3::Zero();  // displacement of the object along its free axes
  /// Of a free object, |change of momentum / h − the forces on it| and the same of angular momentum about its centre;
  /// of several, of the one where the former is the largest part of the load.
  double body_residual_n = 0.0, body_residual_n_m = 0.0;
  double body_load_n = 0.0;  // its weight or the load on it, whichever is larger

  /// Makes it that of this step and of those `before` it: what they took together, and where the last one ended.
  void add_earlier(const StepReport& before);
};

/// Forces on the gel's vertices at the end of a step, N, one row per gel vertex.
struct StepForces {
  Positions normal;    // by contact
  Positions friction;  // by friction
  Positions mount;     // on the glued vertices, by the mount; zero elsewhere
  Positions body;      // inertia (−m a), gravity and damping
  /// Per gel vertex; slip where most of its normal force belongs to pairs that slide faster than ε_v.
  std::vector<ContactState> contact_state;
  /// Σ λ d / Σ λ over the pairs of gel and object, λ the force and d the distance between the two sides of each: the
  /// mean gap between the surfaces where they press on each other. Zero where nothing touches.
  double stand_off_m = 0.0;
  /// By the contact of one body with another (ContactMesh::body_of()), about the world's origin: on body a by body b at
  /// a × number of bodies + b. Where any object may be free, or asked for; else empty.
  std::vector<Wrench> between = {};
  double contact_j = 0.0;                              // energy of the barrier
  double friction_loss_j = 0.0, damping_loss_j = 0.0;  // what friction and stiffness damping took in the step
};

/// Called after each Newton iteration, for progress lines.
using IterationObserver = std::function<void(int iteration, double velocity_residual_m_s)>;

class TimeStepper {
 public:
  /// \param bodies the first objects, those that may be free: the mesh then has rows for their points
  TimeStepper(const ContactMesh& mesh, GelModel gel, const StepSettings& settings, std::vector<AffineBody> bodies = {});

  /// Advances the state by one step. But for free axes, objects that are not free end bit-equal to the target.
  /// \throw SolverError with the numbers if the step does not converge; the state is then as before but for the
  /// barrier's factor.
  StepReport advance(State& state, const StepGoal& goal, const IterationObserver& observe);

  /// Forces at the end of the last step that succeeded.
  const StepForces& forces() const { return forces_; }
  /// Those of a gel that nothing touches.
  StepForces no_forces() const;
  /// Smallest gap between two bodies, one of which can move by itself (not counting a gel with itself), at most `none`.
  double smallest_gap(const Positions& x, double none);
  /// Of all steps so far.
  SolverTimes times() const;
  int num_analyses() const;

 private:
  struct Step;
  struct Minimisation;

  /// The step before its first iteration: terms, weights, friction.
  Step start_step(const State& state, const StepGoal& goal, const IterationObserver& observe);
  void add_gel_terms(Step& step, const State& state) const;
  /// Shares of 1 for all vertices that need some.
  Blend full_blend() const;
  /// The start of the step as seen by damping: of gels, as their mounts have moved them since.
  Positions start_beside_mounts(const Step& step) const;
  /// What a gel whose stress relaxes has besides.
  void add_relaxation(Step& step, const State& state) const;
  void add_object_pull(Step& step, const State& state) const;
  /// The terms of free objects.
  void add_bodies(Step& step, const State& state);
  /// Lets the step start with gels moved with their mounts and a free object where it would fly to, or as near to that
  /// as contact allows.
  void start_ahead(Step& step, const State& state);
  /// How far gels and object go past each other in a step p, and how far they may at once.
  double relative_way(const Positions& p) const;
  double longest_way() const;
  bool objects_arrived(const Step& step) const;
  /// How objects that are not free go from their rows of x to where the step takes them.
  Positions way_of_held_objects(const Step& step, const Positions& x) const;
  /// Puts objects that are not free where the step takes them.
  void place_held_objects(const Step& step, Positions& x) const;
  /// Calls use(object) for those of ContactMesh::objects that are not free in this step.
  template <typename Use>
  void for_each_held(const Step& step, Use&& use) const;
  /// How a body at these points goes along with the moving gels that it touches, if any: by the mean of their motions.
  std::optional<Positions> way_with_gels(const Step& step, const ObjectPart& object, const Positions& points);
  /// Puts glued vertices where their mounts end.
  void arrive_at_mounts(Step& step) const;
  /// The augmented Lagrangian that holds glued and object vertices.
  void add_constraint(Step& step) const;
  /// Takes a solved step over into the state.
  void finish_step(Step& step, State& state);
  void record_forces(const Step& step);
  /// Momentum of the bodies after the step, and what is missing to their balance.
  void finish_bodies(Step& step, State& state) const;
  /// Smallest gap as part of the d̂ of its two bodies, at most 1.
  double smallest_relative_gap(const Positions& x);
  /// The stepper for a step in which these bodies are free.
  NewtonStepper& stepper(const std::vector<int>& free_bodies);
  /// Makes the barrier of the next steps stiffer if a gap at x is too small; true if it did.
  bool stiffen_barrier(State& state, const Positions& x);

  /// Newton's method to the minimum, the object moving to its target first. \throw SolverError if it does not converge
  void minimise(Step& step);
  NewtonDirection find_direction(Step& step, Minimisation& run, bool moving);
  /// Whether the Newton step and the residual forces are below their tolerances.
  bool within_tolerances(const Step& step, const NewtonDirection& direction) const;
  /// Whether a direction within the tolerances ends the minimisation, or the exact Hessian is waited for.
  bool is_final(Step& step, Minimisation& run, const NewtonDirection& direction) const;
  /// What a step must leave of gaps: this part, but never less than a little.
  GapRule gap_rule(double slack) const {
    return {slack, kGapFloor * settings_.laws.reach_m(), settings_.laws.reach_m()};
  }
  /// Part of the step p that leaves enough of every gap and every volume.
  double step_limit(const std::vector<ContactPair>& pairs, const Step& step, const Positions& p, double slack);
  /// Where single contacts would end a move early: shortens the direction to what a few small corrections allow, and
  /// makes these, by which the contacts keep a part of their gaps. `pairs` become those along the new direction.
  /// \return the part of that direction that may be taken
  double bend_at_contacts(const Step& step, Minimisation& run, NewtonDirection& direction,
                          std::vector<ContactPair>& pairs);
  /// Moves object and gel together by the part `alpha` of the direction.
  void move_object(Step& step, Minimisation& run, const NewtonDirection& direction, double alpha);
  /// Takes the longest of the steps limit, limit/2, … that decreases the energy. \return that step; none, and nothing
  /// moved, if there is none
  std::optional<double> line_search(Step& step, Minimisation& run, const NewtonDirection& direction, double limit);
  /// Lets the next step go farther where those before it crept.
  static void stretch_next(Minimisation& run, const NewtonDirection& direction, double alpha);
  /// minimise(), with an augmented Lagrangian's multipliers renewed until all targets are met.
  void minimise_constrained(Step& step);

  /// Where only a few vertices are not yet at rest: Newton's method for the patch of those and their neighbours, all
  /// others held. Returns how much the energy has changed, nothing if nothing moved. `pairs`, those within d̂ where the
  /// step was, are then those within d̂ where it is, and some more.
  std::optional<double> relax_patch(Step& step, const NewtonDirection& direction, std::vector<ContactPair>& pairs);

  /// Friction of this step with normal forces and tangent planes of `lagged`. \pre there is friction
  std::shared_ptr<const Friction> friction_at(const Positions& lagged, const Step& step);
  /// Σ over free vertices, and bodies that move freely, of |force| by which other friction would differ from that of
  /// the step, at its x.
  double friction_change(const Friction& renewed, const Step& step) const;
  /// What that may be at the end.
  double friction_limit(const Step& step) const;
  /// Friction and the energy with normal forces and tangent planes of where the gel is now.
  void renew_friction(Step& step, Minimisation& run);
  /// The friction that the first minimum is sought with, if there is any.
  void start_friction(Step& step);
  /// From a minimum: renews friction and minimises again until it belongs to its own contact forces.
  /// \throw SolverError if it does not settle
  void settle_friction(Step& step);

  std::shared_ptr<const ContactBarrier> barrier(std::vector<ContactPair> pairs) const;
  std::vector<ContactPair> pairs_at(const Positions& x);                         // within d̂ at x
  std::vector<ContactPair> pairs_along(const Positions& x, const Positions& p);  // or anywhere between x and x + p
  IncrementalPotential potential(const Step& step, std::shared_ptr<const ContactBarrier> barrier) const;

  const ContactMesh& mesh_;
  GelModel gel_;
  TetsOfVertices tets_of_;                                 // of the gel
  std::shared_ptr<const EnergyTerm> elasticity_at_mount_;  // stencils with a glued vertex
  StepSettings settings_;
  ContactSearch search_;
  /// What pairs_at() found last: friction, forces and the gap of a solved step ask at the same place. Of this step
  /// only.
  struct {
    Positions x;
    std::vector<ContactPair> pairs;
  } last_search_;
  std::vector<AffineBody> bodies_;
  std::map<std::vector<int>, std::unique_ptr<NewtonStepper>> steppers_;  // by the bodies that are free
  NewtonStepper* newton_ = nullptr;                                      // that of the step under way
  StepForces forces_;
  SolverTimes times_;
};

}  // namespace tacipc
