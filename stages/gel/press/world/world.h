// The bodies of a simulation, the solver that moves them, and what is measured and judged after each frame.
//
// A drive (drive/) says where bodies go and when a frame is over. It calls advance() once per time step, then measure()
// and judge() for the frame. WorldState holds everything that the next time step starts from, so a drive can save it,
// restore it, or go back to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/measure/conservation.h"
#include "stages/gel/press/solve/time_step.h"
#include "stages/gel/press/world/body_checks.h"
#include "stages/gel/press/world/frame.h"
#include "stages/gel/press/world/gel_frame.h"
#include "stages/gel/press/world/pair_laws.h"
#include "stages/gel/press/world/setup.h"

namespace tacipc {

/// A body. Deformable bodies come first, gels before soft bodies; then those that may move freely, then all others.
struct Body {
  std::string name;
  TetMesh tets = {};                      // deformable: undeformed, in the body's own frame; glued faces have a mount
  Material material = {};                 // deformable
  TriangleMesh surface = {};              // of an object, in its own frame
  bool closed = true;                     // the surface of an object encloses a volume
  Matrix4 start = Matrix4::Identity();    // world_from_body in frame 0
  std::optional<AffineBody> affine = {};  // an object that may move freely
  Matrix4 affine_pose = Matrix4::Identity();  // world_from_body for which `affine` is at rest
  Vector3 velocity_m_s = Vector3::Zero(), spin_rad_s = Vector3::Zero();  // of such an object in frame 0

  bool deformable() const { return tets.num_vertices() > 0; }
};

struct WorldOptions {
  Vector3 gravity_m_s2 = Vector3::Zero();
  /// Mounts move, and energy and momentum are accounted for. If false there is one gel, whose frame S is the world.
  bool mounts_move = true;
  std::optional<PairContact> pairs = {};  // contact that differs from pair to pair; absent: all bodies touch alike
};

/// Everything that the next time step starts from.
struct WorldState {
  State motion;
  std::vector<Matrix4> world_from_body;  // of gels their mounts, of soft bodies where they began
  Positions mount_n;                     // force of the mounts on each vertex of deformable bodies
  std::vector<int> held;                 // objects that may move freely but were held in the last step, ascending
  std::vector<Wrench> on_others;         // by each held or fixed body on all others, about the world's origin
  /// Contact wrenches after the last step, about the world's origin: on body a by body b at a × number of bodies + b.
  std::vector<Wrench> between;
  WholeAccount account;
  double time_s = 0.0;
};

/// A world at one instant, with the solver that takes it to the next.
class World {
 public:
  /// \throw UsageError or DataError if the bodies cannot be simulated together
  World(const Sensor& sensor, const PressConfig& config, std::vector<Body> bodies, const WorldOptions& options);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  std::size_t num_gels() const { return num_gels_; }
  std::size_t num_free() const { return affine_.size(); }  // objects that may move freely
  const Body& body(std::size_t b) const { return bodies_[b]; }
  const AffineBody& affine(std::size_t i) const { return affine_[i]; }
  const Scales& scales() const { return scales_; }
  const ContactMesh& mesh() const { return mesh_; }
  SolvedGel deformable(std::size_t b) const;

  WorldState& state() { return state_; }
  const WorldState& state() const { return state_; }
  const TimeStepper& stepper() const { return stepper_; }
  const StepForces& forces() const { return stepper_.forces(); }

  /// Friction and reach of contact between any two bodies.
  const ContactLaws& laws() const { return settings_.laws; }
  /// A simulation of one gel without frames; friction, d̂ and κ are those with the first object, or, if there is none,
  /// with the first other body.
  Simulation simulation_of(std::size_t gel) const;

  /// Number of the i-th object among all bodies; objects that may move freely come first.
  std::size_t object(std::size_t i) const { return parts_.size() + i; }
  /// Control points of the i-th object that may move freely: now, and for a pose of the body.
  ControlPoints points(std::size_t i) const;
  ControlPoints points_at(std::size_t i, const Matrix4& world_from_body) const;
  Vector3 spin_rad_s(std::size_t i) const;

  /// A goal in which mounts rest and all objects that may move freely do so.
  StepGoal goal(double h_s) const;
  /// Lets the mounts of a goal go to these poses (one per body; only those of gels matter).
  void move_mounts(StepGoal& goal, const std::vector<Matrix4>& world_from_body) const;
  /// Holds the i-th object that may move freely at a pose at the end of the step. \pre called in ascending order
  void hold(StepGoal& goal, std::size_t i, const Matrix4& world_from_body) const;
  static bool is_held(const StepGoal& goal, std::size_t i);

  /// One time step. \param world_from_body poses of all bodies at its end, those of the goal; poses of free bodies are
  /// replaced \throw SolverError if it does not converge; the state is then as before but for the barrier's factor
  StepReport advance(const StepGoal& goal, const std::vector<Matrix4>& world_from_body,
                     const IterationObserver& observe);

  double smallest_gap(double none) { return stepper_.smallest_gap(state_.motion.x, none); }

  /// The frames of all deformable bodies, each in its own frame S. \param phase_index −1 in frame 0
  std::vector<Frame> measure(PhaseKind phase, int phase_index, const StepReport& report);
  /// Notes the number of intersections in the frames of measure().
  /// \throw VerdictError naming the body if a frame misses a limit, or two bodies intersect
  void judge(int number, std::vector<Frame>& frames) const;
  /// \throw DataError naming two bodies that touch in frame 0
  void require_apart() const;
  /// Energy and momentum at the end of a frame; the account's residuals begin anew with the next frame.
  WholeAccount take_account();

 private:
  struct Part {
    FrontSurface front;
    std::vector<RestTet> rest_tets;
    Eigen::Index first_row = 0;
  };

  std::vector<Part> make_parts() const;
  StepSettings make_settings() const;
  ContactMesh make_mesh() const;
  void add_gels(ContactMesh& mesh) const;
  std::vector<DeformableBody> materials() const;
  std::vector<TetStress> make_stresses() const;
  /// Cauchy stress of a gel's tetrahedra. \param x its vertices in its own frame
  SymmetricRows stress(std::size_t gel, const Positions& x) const;
  void start();

  void take_poses(const StepGoal& goal, const std::vector<Matrix4>& world_from_body);
  WholeInstant instant(const StepGoal& goal) const;
  /// Adds forces and work of held and fixed bodies to the exchange of a step, and remembers them for the next one.
  void add_held_and_fixed(const std::vector<int>& held, const std::vector<Matrix4>& poses_before,
                          StepExchange& exchange);
  void add_weights_and_loads(const StepGoal& goal, const WholeInstant& before, const WholeInstant& after,
                             StepExchange& exchange) const;
  /// Displacement from which the solver starts a soft body while mounts move: theirs if it touches one that does, else
  /// that of its flight.
  Vector3 start_of_soft_body(std::size_t b, const std::vector<Matrix4>& world_from_body, const Vector3& shift_m,
                             double h_s) const;
  double most_force_on(std::size_t b) const;
  std::vector<BodyShape> shapes() const;
  auto own_rows(std::size_t b, auto& rows) const {
    return rows.middleRows(parts_[b].first_row, bodies_[b].tets.num_vertices());
  }

  const PressConfig config_;
  const std::vector<Body> bodies_;
  const WorldOptions options_;
  const std::size_t num_gels_;
  const Scales scales_;
  const std::vector<AffineBody> affine_;
  const std::vector<Part> parts_;
  const StepSettings settings_;
  const ContactMesh mesh_;
  const std::vector<TetStress> stresses_;  // of the gels, where the configuration wants them
  GelModel model_;
  TimeStepper stepper_;
  WorldState state_;
};

}  // namespace tacipc
