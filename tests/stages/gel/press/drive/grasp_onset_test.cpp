// When a grasp begins to fail, against Coulomb's law for the pressures of the pads. The object's faces are larger than
// the gels', so that no edge of it holds it by more than friction.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/stages/gel/press/drive/grasp_scene.h"

namespace tacipc {
namespace grasp_onset_test {

constexpr double kMu = 0.3, kGrip_n = 1.0;
constexpr double kThreshold_m_s = 28.4e-6;  // ε_v: a thousandth of the gel's diagonal in a second

/// Each step of the ramp ends with its grip; then it is held.
Grasp grasp_plate(const Vector3& half_m, double weight_n, double lever_m, int held_steps) {
  GraspSpec spec = grasp_of(weight_n / kG, {close_phase(8, kGrip_n), hold_phase(held_steps)});
  spec.grip_m = Vector3(0, lever_m, 0);
  return run_grasp(centered_box(half_m), grasp_config(kMu), spec);
}

/// Frame 0.1 s before the end.
std::size_t before_end(const Grasp& grasp) { return grasp.frames.size() - 11; }

/// m g against 2 μ N, two parts in a hundred on either side. Below, what sticks creeps at ε_v (1 − √(1 − r)), r = m
/// g/(2 μ N); above, the plate accelerates by (1 − 1/r) g.
TEST(GraspOnset, SlipBeginsWhereTheWeightIsWhatFrictionCanCarry) {
  const auto at = [](double r) { return grasp_plate({4e-3, 14e-3, 40e-3}, r * 2.0 * kMu * kGrip_n, 0.0, 40); };
  for (const double r : {0.9, 0.98}) {
    const Grasp held = at(r);
    const double sank_m =
        (held.frames[before_end(held)].world_from_object - held.frames.back().world_from_object)(2, 3);
    const double creep_m = 0.1 * kThreshold_m_s * (1.0 - std::sqrt(1.0 - r));
    EXPECT_NEAR(sank_m, creep_m, 0.05 * creep_m) << r;
    EXPECT_EQ(held.outcome, GraspOutcome::lifted) << r;
  }
  for (const double r : {1.02, 1.03}) {
    const Grasp lost = at(r);
    const double faster_m_s = lost.frames[before_end(lost)].velocity_m_s.z() - lost.frames.back().velocity_m_s.z();
    const double expected_m_s = 0.1 * (1.0 - 1.0 / r) * kG;
    EXPECT_NEAR(faster_m_s, expected_m_s, 0.05 * expected_m_s) << r;
    EXPECT_EQ(lost.outcome, GraspOutcome::slipped) << r;
  }
}

/// A point of a pad in the plane of the pads, y and z of the world from the grip point, and its normal force.
struct PadPoint {
  double y, z, normal_n;
};

std::vector<PadPoint> pad_points(const Grasp& grasp, std::size_t frame) {
  std::vector<PadPoint> points;
  for (std::size_t side = 0; side < 2; ++side) {
    const Simulation& finger = grasp.fingers[side];
    const Matrix4& pose = grasp.frames[frame].world_from_finger[side];
    for (std::size_t i = 0; i < finger.front.vertices.size(); ++i) {
      const Vector3 at = finger.frames[frame].positions.row(finger.front.vertices[i]);
      const Vector3 in_world = (pose * at.homogeneous()).head<3>();
      points.push_back(
          {in_world.y(), in_world.z(), finger.frames[frame].normal_force_n.row(static_cast<Eigen::Index>(i)).norm()});
    }
  }
  return points;
}

/// What the pads bear at most of a weight that hangs at `lever_m` from the grip point along −y: all points slide about
/// one, (c, 0). Their friction is the weight, its moment about the grip point that times the lever.
double most_weight_n(const std::vector<PadPoint>& pads, double lever_m) {
  const auto borne = [&](double c) {
    double force = 0.0, moment = 0.0;
    for (const PadPoint& p : pads) {
      const double d = std::hypot(p.y - c, p.z);
      if (d == 0.0) continue;
      force += kMu * p.normal_n * (c - p.y) / d;
      moment += kMu * p.normal_n * (p.y * (p.y - c) + p.z * p.z) / d;
    }
    return std::pair(force, moment);
  };
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 200; ++i) {
    const double c = 0.5 * (low + high);
    const auto [force, moment] = borne(c);
    (force <= 0.0 || moment > lever_m * force ? low : high) = c;
  }
  return borne(high).first;
}

/// Moment alone: M = μ Σ λᵢ |xᵢ|, about the grip point.
double most_moment_n_m(const std::vector<PadPoint>& pads) {
  double sum = 0.0;
  for (const PadPoint& p : pads) sum += kMu * p.normal_n * std::hypot(p.y, p.z);
  return sum;
}

/// Two parts in a hundred on either side of what the solved pressures can bear as force and moment together, from where
/// the force decides to where the moment does.
TEST(GraspOnset, ABarTurnsWhereItsWeightIsWhatBothPadsCanBearOffTheirAxis) {
  for (const double lever_m : {5e-3, 18e-3}) {
    const auto at = [&](double weight_n) { return grasp_plate({4e-3, 30e-3, 14e-3}, weight_n, lever_m, 30); };
    const auto turns_rad = [](const Grasp& grasp) {
      return grasp.frames.back().turn_rad - grasp.frames[before_end(grasp)].turn_rad;
    };
    const Grasp light = at(0.2);
    const std::vector<PadPoint> pads = pad_points(light, light.frames.size() - 1);
    const double most_n = most_weight_n(pads, lever_m);
    // Less than an ellipse has between both, which is a little too generous.
    const double force_part = most_n / (2.0 * kMu * kGrip_n), moment_part = most_n * lever_m / most_moment_n_m(pads);
    const double ellipse = force_part * force_part + moment_part * moment_part;
    EXPECT_LT(ellipse, 1.0) << lever_m;
    EXPECT_GT(ellipse, 0.85) << lever_m;
    const Grasp held = at(0.98 * most_n), turning = at(1.02 * most_n);
    // Creep: ε_v over the distance from where it turns about.
    EXPECT_LT(turns_rad(held), 0.1 * kThreshold_m_s / 5e-3) << lever_m;
    EXPECT_EQ(held.outcome, GraspOutcome::lifted) << lever_m;
    EXPECT_GT(turns_rad(turning), 0.05) << lever_m;
    EXPECT_GT(turning.frames.back().turn_rad, 0.2) << lever_m;
  }
}

}  // namespace grasp_onset_test
}  // namespace tacipc
