// Numerical interface between the robot (MuJoCo) and the press (finite elements): surrogate contact law and residual.
//
// The two solvers run in turn over a time window until they agree (implicit coupling, docs/robot.md). Until then the
// robot cannot call the press for every force. It evaluates a surrogate contact law instead: the last response of the
// press, plus a linear spring for the displacement since then. This file holds that law, the estimate of its stiffness,
// the solver that lets the robot satisfy it, and the residual that ends the iteration.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "common/base/types.h"
#include "common/base/wrench.h"

namespace tacipc {

/// Response of the press at one pad and one instant: the pose at which it was computed and the wrench it gave.
struct PadAnswer {
  Matrix4 world_from_gel = Matrix4::Identity();
  Wrench wrench{Vector3::Zero(), Vector3::Zero()};  // wrench on the gel, world axes, about the origin of S
  double gap_m = 0.0;  // distance of the nearest surface ahead, along z of S from the front; negative while pressed
  int carried = -1;  // index of the free object that this pad supports: the one that presses on it most, or the nearest
                     // one if none presses. −1: no object, or one that is fixed, held, or touched by anything but gels
  bool may_slide = false;  // the nearest object also touches something that is not a gel, so the contact may slip
};

/// Surrogate contact law of one pad: the wrench on a gel whose origin of S moved from the pose of `answer` to
/// `origin_m`. Notation: n is the gel's z axis, N₀ = −f₀ · n the normal force of the response, K = stiffness_n_m, and
/// d = (x − x₀) · n the displacement towards the object. The normal force (along −n) is
///   max(0, N₀ + K d)     if the gel was pressed (N₀ > 0),
///   max(0, K (d − gap))  if it was not.
/// The tangential force changes by −K/2 times the tangential displacement, and the torque is kept; both only if the gel
/// was pressed and still is. At x = x₀ the law returns the response itself.
Wrench felt_wrench(const PadAnswer& answer, const Vector3& origin_m, double stiffness_n_m);

/// Result of felt_wrenches().
struct FeltWrenches {
  std::vector<Wrench> wrenches;  // one per pad, as in PadAnswer
  std::vector<Vector3> along_m;  // displacement u of each object
};

/// Surrogate contact law of all pads together, with the displacement of the free objects between them. An object of
/// mass m is displaced by u from its pose in the responses:
///   m/h² (u − û) = Σ (f₀ − f)   over the pads that support it,
/// with f the surrogate force of a pad at x − u, f₀ its response, û the displacement without a change of force, and
/// h the frame interval. The system is linear for a given set of contacts; that set is found by iteration.
/// \param inertia_n_m m/h² of each object; 0: its displacement stays û
/// \param expected_m û of each object
FeltWrenches felt_wrenches(std::span<const PadAnswer> answers, std::span<const Vector3> origins_m,
                           std::span<const double> stiffness_n_m, std::span<const double> inertia_n_m,
                           std::span<const Vector3> expected_m);

/// Estimates the gels' stiffness, N/m: normal force over depth (−gap) at the pad and frame that is pressed deepest.
/// \return nothing if no gel is pressed
std::optional<double> learnt_stiffness(std::span<const PadAnswer> answer);
/// Secant stiffness of one gel from two of its responses, N/m: change of normal force over displacement along n,
/// limited to `otherwise` / 5 … 5 `otherwise` (down to `otherwise` / 100 if the object may slide).
/// \return `otherwise` if the gel was not pressed in both responses or hardly moved between them
double secant_stiffness(const PadAnswer& earlier, const PadAnswer& answer, double otherwise);

/// Solves f = law(end(f)) for the pad forces of the next interval, three numbers per pad: with these forces the robot
/// ends where the surrogate law returns them. Uses Newton's method, starting from `force`. The robot's compliance is
/// measured once by finite differences and updated by Broyden's method.
/// \param end maps forces, N, to positions at the end of the interval, m (runs the robot: nearly linear, expensive)
/// \param law maps positions to forces (the surrogate: piecewise linear, cheap)
/// \return the last iterate. It need not be exact: the next response of the press measures the remaining error
Eigen::VectorXd balanced_forces(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& end,
                                const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& law,
                                Eigen::VectorXd force);

/// Disagreement between robot and press over all pads and frames of a time window.
struct Residual {
  double wrench_n = 0.0;  // largest |response − applied|, of the force and of the torque / 10 mm
  double relative = 0.0;  // wrench_n over the largest response, which counts as at least `smallest_n`
};
/// Computes the residual.
/// \param felt wrenches that the robot applied to its pads
/// \param answer wrenches that the press returned for the same pads and frames
/// \param smallest_n least reference force for the relative residual, N
Residual interface_residual(std::span<const Wrench> felt, std::span<const Wrench> answer, double smallest_n);

}  // namespace tacipc
