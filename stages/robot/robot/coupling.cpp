#include "stages/robot/robot/coupling.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

constexpr double kTorqueArm_m = 0.01;
constexpr double kTangentialShare = 0.5;
// Shorter displacements are rounding, compared with the accuracy of a press's forces.
constexpr double kShortestWay_m = 1e-7;
constexpr double kMostSecant = 5.0, kMostSliding = 100.0;
// balanced_forces(): finite-difference steps for the robot's compliance and the law's slope, and tolerances.
constexpr double kProbe_n = 0.1, kProbe_m = 1e-8, kNear_n = 1e-9, kNearRobot = 1e-6;
constexpr int kMostRounds = 15, kMostNewton = 40;

Vector3 inwards(const Matrix4& pose) { return pose.block<3, 1>(0, 2); }
double pressing(const PadAnswer& answer) { return -answer.wrench.force_n.dot(inwards(answer.world_from_gel)); }
double size_of(const Wrench& wrench) {
  return std::max(wrench.force_n.norm(), wrench.torque_n_m.norm() / kTorqueArm_m);
}

}  // namespace

Wrench felt_wrench(const PadAnswer& answer, const Vector3& origin_m, double stiffness_n_m) {
  const Vector3 n = inwards(answer.world_from_gel);
  const Vector3 way = origin_m - answer.world_from_gel.topRightCorner<3, 1>();
  const double pressed = pressing(answer), d = way.dot(n);
  const double now =
      pressed > 0.0 ? std::max(0.0, pressed + stiffness_n_m * d) : stiffness_n_m * std::max(0.0, d - answer.gap_m);
  if (now == 0.0) return {Vector3::Zero(), Vector3::Zero()};
  if (pressed <= 0.0) return {-now * n, Vector3::Zero()};
  const Vector3 across = answer.wrench.force_n + pressed * n;
  return {-now * n + across - kTangentialShare * stiffness_n_m * (way - d * n), answer.wrench.torque_n_m};
}

FeltWrenches felt_wrenches(std::span<const PadAnswer> answers, std::span<const Vector3> origins_m,
                           std::span<const double> stiffness_n_m, std::span<const double> inertia_n_m,
                           std::span<const Vector3> expected_m) {
  const auto felt = [&](std::size_t p, const Vector3& along) {
    return felt_wrench(answers[p], origins_m[p] - along, stiffness_n_m[p]);
  };
  FeltWrenches all{.wrenches = {}, .along_m = std::vector<Vector3>(expected_m.begin(), expected_m.end())};
  for (std::size_t o = 0; o < inertia_n_m.size(); ++o) {
    if (inertia_n_m[o] == 0.0) continue;
    Vector3& u = all.along_m[o];
    std::vector<bool> touching, before;
    for (const PadAnswer& answer : answers) touching.push_back(pressing(answer) > 0.0);
    for (int round = 0; round < kMostRounds && touching != before; ++round) {
      Matrix3 sum = inertia_n_m[o] * Matrix3::Identity();
      Vector3 pulled = inertia_n_m[o] * expected_m[o];
      for (std::size_t p = 0; p < answers.size(); ++p) {
        if (answers[p].carried != static_cast<int>(o)) continue;
        const Vector3 n = inwards(answers[p].world_from_gel);
        const bool was = pressing(answers[p]) > 0.0;
        if (!touching[p]) {
          if (was) pulled += answers[p].wrench.force_n;
          continue;
        }
        Matrix3 K = stiffness_n_m[p] * n * n.transpose();
        if (was) K += kTangentialShare * stiffness_n_m[p] * (Matrix3::Identity() - n * n.transpose());
        sum += K;
        pulled += K * (origins_m[p] - answers[p].world_from_gel.topRightCorner<3, 1>());
        if (!was) pulled -= stiffness_n_m[p] * answers[p].gap_m * n;
      }
      u = sum.ldlt().solve(pulled);
      before = touching;
      for (std::size_t p = 0; p < answers.size(); ++p) {
        if (answers[p].carried == static_cast<int>(o)) touching[p] = felt(p, u).force_n != Vector3::Zero();
      }
    }
  }
  for (std::size_t p = 0; p < answers.size(); ++p)
    all.wrenches.push_back(felt(p, answers[p].carried < 0 ? Vector3(Vector3::Zero())
                                                          : all.along_m[static_cast<std::size_t>(answers[p].carried)]));
  return all;
}

std::optional<double> learnt_stiffness(std::span<const PadAnswer> answer) {
  double deepest = kShortestWay_m;
  std::optional<double> stiffness;
  for (const PadAnswer& pad : answer) {
    if (pressing(pad) <= 0.0 || -pad.gap_m <= deepest) continue;
    deepest = -pad.gap_m;
    stiffness = pressing(pad) / deepest;
  }
  return stiffness;
}

double secant_stiffness(const PadAnswer& earlier, const PadAnswer& answer, double otherwise) {
  if (pressing(earlier) <= 0.0 || pressing(answer) <= 0.0) return otherwise;
  const double way =
      (answer.world_from_gel - earlier.world_from_gel).topRightCorner<3, 1>().dot(inwards(earlier.world_from_gel));
  if (std::abs(way) < kShortestWay_m) return otherwise;
  const double softest = otherwise / (answer.may_slide ? kMostSliding : kMostSecant);
  return std::clamp((pressing(answer) - pressing(earlier)) / way, softest, otherwise * kMostSecant);
}

Eigen::VectorXd balanced_forces(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& end,
                                const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& law,
                                Eigen::VectorXd force) {
  const Eigen::Index n = force.size();
  Eigen::VectorXd at = end(force);
  Eigen::MatrixXd compliance(n, n);  // m/N
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::VectorXd more = force;
    more[i] += kProbe_n;
    compliance.col(i) = (end(more) - at) / kProbe_n;
  }
  for (int round = 0; round < kMostRounds; ++round) {
    // Solve the law on the linear model of the robot.
    Eigen::VectorXd change = Eigen::VectorXd::Zero(n);
    for (int i = 0; i < kMostNewton; ++i) {
      const Eigen::VectorXd x = at + compliance * change, wanted = law(x), miss = wanted - force - change;
      if (miss.norm() <= kNear_n) break;
      Eigen::MatrixXd slope(n, n);
      for (Eigen::Index k = 0; k < n; ++k) {
        Eigen::VectorXd moved = x;
        moved[k] += kProbe_m;
        slope.col(k) = (law(moved) - wanted) / kProbe_m;
      }
      const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n) - slope * compliance;
      // Full steps may alternate between pressed and not pressed, because springs only push.
      change += (i < kMostNewton / 2 ? 1.0 : 0.5) * system.partialPivLu().solve(miss);
    }
    force += change;
    const Eigen::VectorXd before = at;
    at = end(force);
    if ((law(at) - force).norm() <= kNearRobot * (kNear_n + force.norm())) break;
    // Where a drive reaches its limit or a joint its stop, the robot's compliance changes (Broyden).
    if (const double squared = change.squaredNorm(); squared > 0.0)
      compliance += (at - before - compliance * change) * change.transpose() / squared;
  }
  return force;
}

Residual interface_residual(std::span<const Wrench> felt, std::span<const Wrench> answer, double smallest_n) {
  Residual residual;
  double largest = smallest_n;
  for (std::size_t i = 0; i < felt.size(); ++i) {
    residual.wrench_n = std::max(
        residual.wrench_n, size_of({answer[i].force_n - felt[i].force_n, answer[i].torque_n_m - felt[i].torque_n_m}));
    largest = std::max(largest, size_of(answer[i]));
  }
  residual.relative = residual.wrench_n / largest;
  return residual;
}

}  // namespace tacipc
