// The hand of a grasp: two fingers on their drives, moved in time steps that leave the drives in balance.
#pragma once

#include <utility>
#include <vector>

#include "common/sample/rigid_way.h"
#include "stages/gel/press/drive/frame_run.h"
#include "stages/gel/press/drive/grasp_frame.h"
#include "stages/gel/press/drive/grip_control.h"
#include "stages/gel/press/drive/way_search.h"
#include "stages/gel/press/world/world.h"

namespace tacipc {

/// Moves the gels of a world (bodies 0 and 1) around the object (body 2). Each function that takes a time step also
/// moves the hand by `motion`, and adds the step's effort to a report.
class Hand {
 public:
  /// \param grasp mass and centre of the object \pre all arguments outlive the hand
  Hand(const GraspSpec& spec, const PressConfig& config, const Grasp& grasp, World& world, const FrameRun& run)
      : spec_(spec), config_(config), grasp_(grasp), world_(world), run_(run) {}

  HandState& state() { return state_; }

  /// Contact force on a finger in the world, N.
  Vector3 force_on(std::size_t side) const { return contact_force_on(world_.deformable(side), world_.forces()); }
  /// Mean force by which the fingers press, N.
  double grip_n() const;
  /// Whether the object is free.
  bool is_free() const { return state_.drives[0].let_go; }
  /// Whether the object is free and neither finger touches it. Fingers then stop closing, except in a release.
  bool lost() const { return state_.drives[0].lost() && state_.drives[1].lost(); }
  /// Whether the drives have reached the prescribed force or displacement.
  bool arrived() const;
  /// Largest imbalance of a drive after a time step, as a fraction of its force, since the last call.
  double take_imbalance() { return std::exchange(imbalance_, 0.0); }
  /// Frees the object. \return forces by which the fingers press, N
  Ways let_go();

  /// Takes a time step in which each finger opens by `way_m`; the remaining grip is kept afterwards.
  void open_by(double way_m, double h_s, const RigidWay& motion, StepReport& report);
  /// Takes a time step in which fingers with a prescribed displacement move towards it.
  void go_on(double h_s, const RigidWay& motion, StepReport& report);
  /// Takes a time step that ends with each drive in balance. It is attempted with several displacements, each from the
  /// same state, and divided if none of them is in balance.
  /// \param enough_n while the object is held, a grip up to this needs no second attempt
  void balance(double h_s, const RigidWay& motion, double enough_n, StepReport& report, int halvings = 0);

 private:
  const Matrix4& object_pose() const { return world_.state().world_from_body[2]; }
  Ways pressing_n() const;
  Ways grips_n() const;
  std::vector<Matrix4> poses(const Matrix4& world_from_hand, const Ways& closed_m) const;
  void step(double h_s, const Ways& closing_m, const RigidWay& motion, int halvings, StepReport& report);
  void measured_step(double h_s, const Ways& closing_m, const RigidWay& motion, StepReport& report);
  PairSearch start_search(double h_s, const Matrix4& motion);
  double along_axis(const Matrix4& from, const Matrix4& to, const Matrix4& motion, const Matrix4& hand) const;

  const GraspSpec& spec_;
  const PressConfig& config_;
  const Grasp& grasp_;
  World& world_;
  const FrameRun& run_;
  HandState state_;
  double imbalance_ = 0.0;
};

}  // namespace tacipc
