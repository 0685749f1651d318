// A world: the bodies of a simulation, the solver that moves them, and the measurement and verdict of each frame.
//
// A driver (drive/) determines the motion of bodies and the end of each frame. It calls advance() once per time step,
// then measure() and judge() for the frame. WorldState holds everything that the next time step starts from, so a
// driver can save it, restore it, or return to it.
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

/// A body. Order: gels, soft bodies, objects that may be free, all other objects.
struct Body {
  std::string name;
  TetMesh tets = {};          // deformable: undeformed, in the body's own frame; a body with a glued face has a mount
  Material material = {};     // deformable: material
  TriangleMesh surface = {};  // object: surface in its own frame
  bool closed = true;         // the surface of an object encloses a volume
  Matrix4 start = Matrix4::Identity();                                   // world_from_body in frame 0
  std::optional<AffineBody> affine = {};                                 // object that may be free
  Matrix4 affine_pose = Matrix4::Identity();                             // world_from_body in which `affine` is at rest
  Vector3 velocity_m_s = Vector3::Zero(), spin_rad_s = Vector3::Zero();  // velocity of such an object in frame 0

  bool deformable() const { return tets.num_vertices() > 0; }
};

/// Options of a world.
struct WorldOptions {
  Vector3 gravity_m_s2 = Vector3::Zero();
  /// Mounts move, and energy and momentum are recorded. False: there is one gel, whose frame S is the world.
  bool mounts_move = true;
  std::optional<PairContact> pairs = {};  // contact that differs from pair to pair; absent: one law for all
};

/// State that the next time step starts from.
struct WorldState {
  State motion;
  std::vector<Matrix4> world_from_body;  // mounts of gels; initial poses of soft bodies; poses of objects
  Positions mount_n;                     // mount force on each vertex of deformable bodies
  std::vector<int> held;                 // objects that may be free but were held in the last step, ascending
  std::vector<Wrench> on_others;         // wrench of each held or fixed body on all others, about the world's origin
  /// Contact wrenches after the last step, about the world's origin: on body a by body b, at a × number of bodies + b.
  std::vector<Wrench> between;
  WholeAccount account;
  double time_s = 0.0;
};

/// A world at one instant, with the solver that advances it.
class World {
 public:
  /// \throw UsageError or DataError if the bodies cannot be simulated together
  World(const Sensor& sensor, const PressConfig& config, std::vector<Body> bodies, const WorldOptions& options);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  std::size_t num_gels() const { return num_gels_; }
  std::size_t num_free() const { return affine_.size(); }  // objects that may be free
  const Body& body(std::size_t b) const { return bodies_[b]; }
  const AffineBody& affine(std::size_t i) const { return affine_[i]; }
  const Scales& scales() const { return scales_; }
  const ContactMesh& mesh() const { return mesh_; }
  /// Constant data of deformable body b.
  SolvedGel deformable(std::size_t b) const;

  WorldState& state() { return state_; }
  const WorldState& state() const { return state_; }
  const TimeStepper& stepper() const { return stepper_; }
  const StepForces& forces() const { return stepper_.forces(); }

  /// Friction and range of contact between any two bodies.
  const ContactLaws& laws() const { return settings_.laws; }
  /// A Simulation of one gel without frames. Friction, d̂ and κ are those with the first object, or with the first
  /// other body if there is no object.
  Simulation simulation_of(std::size_t gel) const;

  /// Index of the i-th object among all bodies; objects that may be free come first.
  std::size_t object(std::size_t i) const { return parts_.size() + i; }
  /// Control points of the i-th object that may be free: now, and for a pose of the body.
  ControlPoints points(std::size_t i) const;
  ControlPoints points_at(std::size_t i, const Matrix4& world_from_body) const;
  /// Angular velocity of the i-th object that may be free, in the world.
  Vector3 spin_rad_s(std::size_t i) const;

  /// Goal of a step in which mounts rest and all objects that may be free are free.
  StepGoal goal(double h_s) const;
  /// Sets the poses of the mounts at the end of the step.
  /// \param world_from_body one per body; only those of gels matter
  void move_mounts(StepGoal& goal, const std::vector<Matrix4>& world_from_body) const;
  /// Holds the i-th object that may be free at a pose at the end of the step. \pre called in ascending order
  void hold(StepGoal& goal, std::size_t i, const Matrix4& world_from_body) const;
  /// Whether a goal holds the i-th object that may be free.
  static bool is_held(const StepGoal& goal, std::size_t i);

  /// Takes one time step.
  /// \param world_from_body poses of all bodies at its end, as in the goal; those of free bodies are replaced by the
  /// solved ones
  /// \throw SolverError if it does not converge; only the barrier's factor may then have changed
  StepReport advance(const StepGoal& goal, const std::vector<Matrix4>& world_from_body,
                     const IterationObserver& observe);

  /// Smallest gap as TimeStepper::smallest_gap(), at the present positions.
  double smallest_gap(double none) { return stepper_.smallest_gap(state_.motion.x, none); }

  /// Frames of all deformable bodies, each in its own frame S. \param phase_index −1 in frame 0
  std::vector<Frame> measure(PhaseKind phase, int phase_index, const StepReport& report);
  /// Writes the number of intersections into the frames of measure().
  /// \throw VerdictError that names the body if a frame misses a limit, or two bodies intersect
  void judge(int number, std::vector<Frame>& frames) const;
  /// Checks the start. \throw DataError that names two bodies that touch in frame 0
  void require_apart() const;
  /// Energy and momentum at the end of a frame; the account's residuals restart with the next frame.
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
  /// Adds forces and work of held and fixed bodies to the exchange of a step, and stores them for the next one.
  void add_held_and_fixed(const std::vector<int>& held, const std::vector<Matrix4>& poses_before,
                          StepExchange& exchange);
  void add_weights_and_loads(const StepGoal& goal, const WholeInstant& before, const WholeInstant& after,
                             StepExchange& exchange) const;
  /// Initial displacement of a soft body while mounts move: that of a moving gel that it touches, else its free flight.
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
  const std::vector<TetStress> stresses_;  // stress of each gel, if the configuration asks for it
  GelModel model_;
  TimeStepper stepper_;
  WorldState state_;
};

}  // namespace tacipc
