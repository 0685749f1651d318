#include "common/benchmark/ball_press.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/base/error.h"
#include "common/sample/front_frames.h"

namespace tacipc {

Positions BallPress::at_depth(double depth) const {
  if (depth > depth_m.back())
    throw DataError("a ball is {:.3f} mm deep, the press ends at {:.3f} mm", 1e3 * depth, 1e3 * depth_m.back());
  const auto above = std::ranges::lower_bound(depth_m, depth);
  const auto k = static_cast<std::size_t>(above - depth_m.begin());
  if (k == 0) return frames.front();
  const double t = (depth - depth_m[k - 1]) / (depth_m[k] - depth_m[k - 1]);
  return (1.0 - t) * frames[k - 1] + t * frames[k];
}

double BallPress::depth_of_contact(double rim_m, const std::string& what) const {
  for (std::size_t k = 1; k < contact_m.size(); ++k) {
    if (contact_m[k] < rim_m || contact_m[k] <= contact_m[k - 1]) continue;
    const double t = std::max(0.0, (rim_m - contact_m[k - 1]) / (contact_m[k] - contact_m[k - 1]));
    return depth_m[k - 1] + t * (depth_m[k] - depth_m[k - 1]);
  }
  throw DataError("{}: its contact radius of {:.3f} mm is more than the press reaches, {:.3f} mm", what, 1e3 * rim_m,
                  1e3 * contact_m.back());
}

namespace {

struct Ring {
  double radius_m, gap_m;  // means over the ring's vertices
};

/// Returns rings of front vertices about the axis from the middle outwards, without empty rings.
std::vector<Ring> gap_profile(const Positions& front, double depth_m, double ball_radius_m) {
  constexpr double kRingWidthM = 1e-4;
  const auto rings = static_cast<std::size_t>(0.95 * ball_radius_m / kRingWidthM);
  std::vector<double> sum(rings, 0.0), count(rings, 0.0);
  for (Eigen::Index i = 0; i < front.rows(); ++i) {
    const double r = std::hypot(front(i, 0), front(i, 1));
    const auto ring = static_cast<std::size_t>(r / kRingWidthM);
    if (ring >= rings) continue;
    const double ball = -depth_m + ball_radius_m - std::sqrt(ball_radius_m * ball_radius_m - r * r);
    sum[ring] += ball - front(i, 2);
    count[ring] += 1.0;
  }
  std::vector<Ring> profile;
  for (std::size_t ring = 0; ring < rings; ++ring)
    if (count[ring] > 0.0)
      profile.push_back({(static_cast<double>(ring) + 0.5) * kRingWidthM, sum[ring] / count[ring]});
  return profile;
}

}  // namespace

double contact_radius(const Positions& front, double depth_m, double ball_radius_m, double gap_m) {
  Ring before{0.0, 0.0};
  for (const Ring& ring : gap_profile(front, depth_m, ball_radius_m)) {
    if (ring.gap_m > gap_m) {
      if (before.radius_m == 0.0) return 0.0;
      return before.radius_m + (ring.radius_m - before.radius_m) * (gap_m - before.gap_m) / (ring.gap_m - before.gap_m);
    }
    before = ring;
  }
  return before.radius_m;
}

double gap_at_radius(const Positions& front, double depth_m, double ball_radius_m, double radius_m) {
  const std::vector<Ring> profile = gap_profile(front, depth_m, ball_radius_m);
  if (profile.empty()) throw DataError("no vertex of the front lies below the ball");
  if (radius_m <= profile.front().radius_m) return profile.front().gap_m;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    if (profile[k].radius_m < radius_m) continue;
    const double t = (radius_m - profile[k - 1].radius_m) / (profile[k].radius_m - profile[k - 1].radius_m);
    return profile[k - 1].gap_m + t * (profile[k].gap_m - profile[k - 1].gap_m);
  }
  return profile.back().gap_m;
}

void BallPress::set_rim(double gap_m) {
  contact_m.assign(frames.size(), 0.0);
  for (std::size_t k = 1; k < frames.size(); ++k)
    contact_m[k] = std::max(contact_radius(frames[k], depth_m[k], radius_m, gap_m), contact_m[k - 1]);
}

Matrix4 ball_pose(double x_m, double y_m, double depth_m, double ball_radius_m) {
  Matrix4 pose = Matrix4::Identity();
  pose(1, 1) = pose(2, 2) = -1.0;
  pose.topRightCorner<3, 1>() << x_m, y_m, ball_radius_m - depth_m;
  return pose;
}

BallPress read_ball_press(const std::filesystem::path& press, const std::filesystem::path& gel, double ball_radius_m,
                          double gap_m) {
  const FrontFrames read = read_front_frames(press, gel);
  BallPress out{
      .radius_m = ball_radius_m, .front = read.triangles, .depth_m = {}, .frames = read.frames, .contact_m = {}};
  for (std::size_t k = 0; k < read.gel_from_object.size(); ++k) {
    const Vector3 center = read.gel_from_object[k].topRightCorner<3, 1>();
    if (center.head<2>().norm() > 1e-6) throw DataError("{}: the ball is not over the origin", press.string());
    const double depth = k == 0 ? 0.0 : ball_radius_m - center.z();
    if (k > 0 && !(depth > out.depth_m.back()))
      throw DataError("{}: frame {} is not deeper than the one before", press.string(), k);
    out.depth_m.push_back(depth);
  }
  if (out.frames.size() < 2) throw DataError("{}: has no frame after the reference", press.string());
  out.set_rim(gap_m);
  return out;
}

}  // namespace tacipc
