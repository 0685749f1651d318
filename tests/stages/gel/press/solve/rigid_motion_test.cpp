#include "stages/gel/press/solve/rigid_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "stages/gel/press/energy/orthogonality.h"
#include "tests/make_mesh.h"

namespace tacipc {
namespace rigid_motion_test {

const Vector3 kGravity(0, 0, -9.81);

/// The axes of a box stand askew to those of the world; column i is axis i.
Matrix3 askew() { return Eigen::AngleAxisd(0.9, Vector3(2, -1, 1).normalized()).toRotationMatrix(); }

AffineBody box_body(const Vector3& sides_m) {
  TriangleMesh box = make_box(-0.5 * sides_m, 0.5 * sides_m);
  box.positions = (box.positions * askew().transpose()).rowwise() + Eigen::RowVector3d(0.1, 0.2, 0.3);
  return make_affine_body(box.positions, box.triangles, 1000.0);
}

/// Principal moments of inertia 5 : 4 : 3, because squared sides 1 : 2 : 3 have second moments in that ratio.
AffineBody tumbling_body() { return box_body(0.02 * Vector3(1.0, std::sqrt(2.0), std::sqrt(3.0))); }

struct Flight {
  AffineBody body;
  ControlPoints control;
  RigidMotion motion;

  Flight(const AffineBody& flying, const Vector3& velocity_m_s, const Vector3& angular_velocity_rad_s)
      : body(flying),
        control(flying.rest_m),
        motion(make_rigid_motion(flying, flying.rest_m, velocity_m_s, angular_velocity_rad_s)) {}

  void step(double h_s, const Vector3& gravity_m_s2 = Vector3::Zero()) {
    const ControlPoints next = predicted(body, control, motion, gravity_m_s2, h_s);
    motion = after_step(body, next, next, motion, gravity_m_s2, h_s);
    control = next;
  }
  Vector3 omega() const { return angular_velocity(body, control, motion); }
  /// ω along the body's own axes.
  Vector3 omega_in_body() const { return askew().transpose() * rotation_of(body, control).transpose() * omega(); }
};

TEST(RigidMotion, FreeFallIsBackwardEulers) {
  const double h = 0.01, g = 9.81;
  const Vector3 v0(0.3, -0.2, 1.5);
  Flight flight(box_body({0.03, 0.02, 0.01}), v0, {3, -4, 5});
  const Vector3 start = center_of(flight.control);
  for (int n = 1; n <= 100; ++n) {
    flight.step(h, kGravity);
    const double t = h * n;
    const Vector3 fallen(0, 0, -0.5 * g * t * (t + h));
    EXPECT_LT((center_of(flight.control) - (start + v0 * t + fallen)).norm(), 1e-12) << n;
    EXPECT_LT((flight.motion.velocity_m_s - (v0 + kGravity * t)).norm(), 1e-12) << n;
  }
  EXPECT_LT(strain_of(flight.body, flight.control), 1e-13);
}

TEST(RigidMotion, SpinAboutAPrincipalAxisStays) {
  const double h = 0.01, speed = 10.0;
  for (const int axis : {0, 2}) {  // the greatest and the least moment of inertia; about the middle one it would tumble
    const Vector3 omega = speed * askew().col(axis);
    Flight flight(tumbling_body(), Vector3::Zero(), omega);
    for (int n = 0; n < 1000; ++n) flight.step(h);
    EXPECT_LT((flight.omega() - omega).norm(), 1e-9 * speed) << axis;
    const Matrix3 turned = Eigen::AngleAxisd(speed * 1000 * h, askew().col(axis)).toRotationMatrix();
    EXPECT_LT((rotation_of(flight.body, flight.control) - turned).norm(), 1e-7) << axis;  // after 16 turns
  }
}

/// Seen from the body, ω goes round the axis of symmetry at ω₃ (I₃ − I₁)/I₁.
TEST(RigidMotion, SymmetricBodyPrecesses) {
  const double a = 0.02, b = 0.05, h = 0.01;
  const double I1 = a * a + b * b, I3 = 2 * a * a;  // times m/12
  const Vector3 start(2.0, 0.0, 8.0);
  Flight flight(box_body({a, a, b}), Vector3::Zero(), askew() * start);
  const double rate = start[2] * (I3 - I1) / I1;
  double angle = 0.0, last = 0.0;
  for (int n = 1; n <= 300; ++n) {
    flight.step(h);
    const Vector3 omega = flight.omega_in_body();
    const double now = std::atan2(omega[1], omega[0]);
    angle += std::remainder(now - last, 2.0 * std::numbers::pi);
    last = now;
    EXPECT_NEAR(omega[2], start[2], 1e-7) << n;
  }
  EXPECT_GT(std::abs(angle), 10.0);
  EXPECT_NEAR(angle / (300 * h), rate, 1e-3 * std::abs(rate));
}

/// A body that spins about its middle axis turns over again and again (Dzhanibekov). The first time that ω along the
/// axis changes its sign is 2.189 s, whatever the step.
TEST(RigidMotion, TumblesAboutTheMiddleAxisAtEveryStep) {
  for (const double h : {0.001, 0.005, 0.01}) {
    Flight flight(tumbling_body(), Vector3::Zero(), askew() * Vector3(0.05, 10.0, 0.05));
    const Vector3 momentum = flight.motion.angular_momentum_kg_m2_s;
    const double energy = kinetic_energy(flight.body, flight.control, flight.motion);
    double flipped_s = 0.0, before = 10.0;
    for (int n = 1; n * h < 3.0; ++n) {
      flight.step(h);
      const double now = flight.omega_in_body()[1];
      if (flipped_s == 0.0 && now < 0.0) flipped_s = h * (n - now / (now - before));
      before = now;
      EXPECT_NEAR(kinetic_energy(flight.body, flight.control, flight.motion), energy, 1e-8 * energy) << h << " " << n;
    }
    EXPECT_NEAR(flipped_s, 2.189, 0.01 * 2.189) << h;
    EXPECT_EQ(flight.motion.angular_momentum_kg_m2_s, momentum);
  }
}

TEST(RigidMotion, LargestTurnOfAStepIsIntegratedAsManySmallOnes) {
  const Vector3 omega = askew() * Vector3(5.0, 7.0, -5.0);  // 10 rad/s: 0.2 rad in 20 ms
  Flight one(tumbling_body(), Vector3::Zero(), omega), many = one;
  one.step(0.02);
  for (int n = 0; n < 200; ++n) many.step(1e-4);
  EXPECT_LT((rotation_of(one.body, one.control) - rotation_of(many.body, many.control)).norm(), 1e-9);
}

TEST(RigidMotion, PredictionIsARigidPoseOfARestShapeThatStartsAtThePolarRotation) {
  const AffineBody body = tumbling_body();
  const Matrix3 R = Eigen::AngleAxisd(1.1, Vector3::UnitY()).toRotationMatrix();
  const Matrix3 U = Vector3(1.02, 0.97, 1.01).asDiagonal();
  const ControlPoints strained = (body.rest_m * (R * U).transpose()).rowwise() + Eigen::RowVector3d(1, 0, 0);
  ASSERT_GT(strain_of(body, strained), 0.01);
  const ControlPoints points = predicted(body, strained, RigidMotion{}, Vector3::Zero(), 0.01);
  EXPECT_LT(strain_of(body, points), 1e-13);
  EXPECT_LT((points - rigid_points(body, center_of(strained), R)).norm(), 1e-14);
}

/// Where the step's energy has its minimum under given forces, these give their impulse and its moment.
TEST(RigidMotion, TakesUpForcesAndTorquesOfTheStep) {
  const double h = 0.01;
  Flight flight(tumbling_body(), {0.1, 0.2, 0.3}, {1, -2, 3});
  ControlPoints forces;
  forces << 0.1, 0.2, -0.3, 0.05, -0.4, 0.1, -0.2, 0.1, 0.3, 0.15, -0.1, 0.2;
  const ControlPoints start = predicted(flight.body, flight.control, flight.motion, kGravity, h);
  const ControlPoints end = start + h * h / (0.25 * flight.body.mass_kg) * forces;
  const RigidMotion after = after_step(flight.body, start, end, flight.motion, kGravity, h);
  Vector3 torque = Vector3::Zero();
  for (int k = 0; k < 4; ++k) torque += Vector3(end.row(k).transpose() - center_of(end)).cross(Vector3(forces.row(k)));
  const Vector3 dv = after.velocity_m_s - flight.motion.velocity_m_s;
  const Vector3 expected = h * kGravity + h * forces.colwise().sum().transpose() / flight.body.mass_kg;
  EXPECT_LT((dv - expected).norm(), 1e-12 * expected.norm());
  const Vector3 dL = after.angular_momentum_kg_m2_s - flight.motion.angular_momentum_kg_m2_s;
  ASSERT_GT(torque.norm(), 1e-3);
  EXPECT_LT((dL - h * torque).norm(), 1e-12 * h * torque.norm());
  // The centre moves by the new velocity.
  const Vector3 moved = center_of(end) - center_of(flight.control);
  EXPECT_LT((moved - h * after.velocity_m_s).norm(), 1e-12 * moved.norm());
}

/// What keeps the body rigid has no resultant, so a step that ends strained loses no momentum.
TEST(RigidMotion, KeepsItsMomentumUnderTheBodysOwnForces) {
  const double h = 0.01;
  const Flight flight(tumbling_body(), {0.1, 0.2, 0.3}, {1, -2, 3});
  const Matrix3 U = Vector3(1.0002, 0.9997, 1.0001).asDiagonal();
  const ControlPoints end = flight.body.rest_m * (askew() * U).transpose();
  Local local;
  Orthogonality(0, flight.body).evaluate(0, end.reshaped<Eigen::RowMajor>(), Order::gradient, local);
  const ControlPoints own = -local.gradient.reshaped<Eigen::RowMajor>(4, 3);
  ASSERT_GT(own.norm(), 1.0);
  const ControlPoints start = end - h * h / (0.25 * flight.body.mass_kg) * own;
  const RigidMotion after = after_step(flight.body, start, end, flight.motion, Vector3::Zero(), h);
  const double impulse = h * own.norm(), arm = flight.body.rest_m.norm();
  EXPECT_LT((after.velocity_m_s - flight.motion.velocity_m_s).norm() * flight.body.mass_kg, 1e-14 * impulse);
  EXPECT_LT((after.angular_momentum_kg_m2_s - flight.motion.angular_momentum_kg_m2_s).norm(), 1e-14 * impulse * arm);
}

TEST(RigidMotion, VelocityAndEnergyAreThoseOfTheFourParticles) {
  const AffineBody body = tumbling_body();
  const Matrix3 R = Eigen::AngleAxisd(2.0, Vector3(1, 1, -1).normalized()).toRotationMatrix();
  const ControlPoints control = rigid_points(body, {0.5, 0, 0.1}, R);
  const Vector3 v(0.1, -0.4, 0.2), omega(3, 4, -5);
  ControlPoints rate;
  Vector3 momentum = Vector3::Zero();
  for (int k = 0; k < 4; ++k) {
    const Vector3 arm = control.row(k).transpose() - center_of(control);
    rate.row(k) = v + omega.cross(arm);
    momentum += 0.25 * body.mass_kg * arm.cross(Vector3(rate.row(k)));
  }
  const RigidMotion motion = make_rigid_motion(body, control, v, omega);
  EXPECT_LT((motion.angular_momentum_kg_m2_s - momentum).norm(), 1e-13 * momentum.norm());
  EXPECT_LT((angular_velocity(body, control, motion) - omega).norm(), 1e-13 * omega.norm());
  const double energy = 0.5 * 0.25 * body.mass_kg * rate.squaredNorm();
  EXPECT_NEAR(kinetic_energy(body, control, motion), energy, 1e-13 * energy);
}

}  // namespace rigid_motion_test
}  // namespace tacipc
