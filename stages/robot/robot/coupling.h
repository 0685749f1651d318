// What a robot feels of its gels while press and robot do not yet agree, and how far they are from agreeing.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "common/base/types.h"
#include "common/base/wrench.h"

namespace tacipc {

/// What is known of a pad at one instant: where it was, what the gel answered there, how far in front of it the nearest
/// thing was.
struct PadAnswer {
  Matrix4 world_from_gel = Matrix4::Identity();
  Wrench wrench{Vector3::Zero(), Vector3::Zero()};  // on the gel, world axes, about the origin of S
  double gap_m = 0.0;                               // along z of S from its front; counts where the gel is not pressed
  int carried = -1;  // the free object that presses on it the most or, of one that is not pressed, is nearest, by a
                     // number; −1: none, or what does not give way, or is held by something else, too
  bool may_slide = false;  // it is held by something else
};

/// The wrench on a gel that is not where it was when it answered: what it answered, and a spring in between. Along the
/// gel's z, n, with x the origin of S and d = (x − x₀) · n, the way further in:
///   f·(−n) = max(0, f₀·(−n) + K d)   where it was pressed (f₀·(−n) > 0), else   max(0, K (d − gap));
/// across, half as stiff, while it is pressed before and after. Where it is again, x = x₀, this is what it answered.
Wrench felt_wrench(const PadAnswer& answer, const Vector3& origin_m, double stiffness_n_m);

struct FeltWrenches {
  std::vector<Wrench> wrenches;  // of each pad
  std::vector<Vector3> along_m;  // of each object: u below
};

/// Answers of all pads with their origins elsewhere. A free object of mass m that gels press on gives way: it is by u
/// elsewhere, with
///   m/h² (u − û) = Σ (f₀ − f),   f the force of the spring above on a pad at x − u, f₀ what it answered,
/// h the time since, û where it would be with these answers alone. Linear while no contact begins or ends; which do is
/// found by taking those of the last u. \param inertia_n_m m/h² of each object \param expected_m û of each
FeltWrenches felt_wrenches(std::span<const PadAnswer> answers, std::span<const Vector3> origins_m,
                           std::span<const double> stiffness_n_m, std::span<const double> inertia_n_m,
                           std::span<const Vector3> expected_m);

/// Stiffness of the gels from an answer: of the pad and frame that is deepest in, force over depth (−gap). Nothing
/// where no gel is pressed.
std::optional<double> learnt_stiffness(std::span<const PadAnswer> answer);
/// Of one gel from two of its answers, Δforce over way along n, within a factor of five of `otherwise`, or down to a
/// hundredth of it where the object may slide; `otherwise`, where it was not pressed in both or has hardly moved.
double secant_stiffness(const PadAnswer& earlier, const PadAnswer& answer, double otherwise);

/// Forces on pads for the next interval, which is to end where the gels would answer with them: f = law(end(f)), both
/// maps from 3 numbers a pad. `end` (a robot) is nearly linear and dear, `law` (springs that only push) cheap and
/// piecewise linear: Newton's method on both, from `force`. \return what was found last; the law and the ends need not
/// agree exactly, as the next answer tells by how much they do not
Eigen::VectorXd balanced_forces(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& end,
                                const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& law,
                                Eigen::VectorXd force);

struct Residual {
  double wrench_n = 0.0;  // largest |answer − felt| of a pad and frame: of force, and of torque / 10 mm
  double relative = 0.0;  // to the largest answer of all pads and frames, or `smallest_n`
};
Residual interface_residual(std::span<const Wrench> felt, std::span<const Wrench> answer, double smallest_n);

}  // namespace tacipc
