#include "stages/calibrate/ball_press.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.h"
#include "common/front_frames.h"
#include "common/npy.h"

namespace tacipc {

Positions BallPress::at_depth(double depth) const {
  if (depth > depth_m.back())
    throw DataError("a ball is {:.3f} mm deep, the press ends at {:.3f} mm", 1e3 * depth, 1e3 * depth_m.back());
  const auto above = std::lower_bound(depth_m.begin(), depth_m.end(), depth);
  const auto k = static_cast<std::size_t>(above - depth_m.begin());
  if (k == 0) return frames.front();
  const double t = (depth - depth_m[k - 1]) / (depth_m[k] - depth_m[k - 1]);
  return (1.0 - t) * frames[k - 1] + t * frames[k];
}

double BallPress::depth_of_contact(double radius_m, const std::string& what) const {
  for (std::size_t k = 1; k < contact_m.size(); ++k) {
    if (contact_m[k] < radius_m || contact_m[k] <= contact_m[k - 1]) continue;
    const double t = std::max(0.0, (radius_m - contact_m[k - 1]) / (contact_m[k] - contact_m[k - 1]));
    return depth_m[k - 1] + t * (depth_m[k] - depth_m[k - 1]);
  }
  throw DataError("{}: its contact radius of {:.3f} mm is more than the press reaches, {:.3f} mm", what, 1e3 * radius_m,
                  1e3 * contact_m.back());
}

double contact_radius(const Positions& front, double depth_m, double ball_radius_m, double gap_m) {
  constexpr double kRing = 1e-4;
  const auto rings = static_cast<std::size_t>(0.95 * ball_radius_m / kRing);
  std::vector<double> sum(rings, 0.0), count(rings, 0.0);
  for (Eigen::Index i = 0; i < front.rows(); ++i) {
    const double r = std::hypot(front(i, 0), front(i, 1));
    const auto ring = static_cast<std::size_t>(r / kRing);
    if (ring >= rings) continue;
    const double ball = -depth_m + ball_radius_m - std::sqrt(ball_radius_m * ball_radius_m - r * r);
    sum[ring] += ball - front(i, 2);
    count[ring] += 1.0;
  }
  double before_r = 0.0, before_gap = 0.0;
  for (std::size_t ring = 0; ring < rings; ++ring) {
    if (count[ring] == 0.0) continue;
    const double r = (static_cast<double>(ring) + 0.5) * kRing, gap = sum[ring] / count[ring];
    if (gap > gap_m) {
      if (before_r == 0.0) return 0.0;
      return before_r + (r - before_r) * (gap_m - before_gap) / (gap - before_gap);
    }
    before_r = r;
    before_gap = gap;
  }
  return before_r;
}

BallPress read_ball_press(const std::filesystem::path& press, const std::filesystem::path& gel, double ball_radius_m,
                          double gap_m) {
  const FrontFrames read = read_front_frames(press, gel);
  BallPress out{.front = read.triangles, .depth_m = {}, .frames = read.frames, .contact_m = {}};
  for (std::size_t k = 0; k < read.gel_from_object.size(); ++k) {
    const Vector3 center = read.gel_from_object[k].topRightCorner<3, 1>();
    if (center.head<2>().norm() > 1e-6) throw DataError("{}: the ball is not over the origin", press.string());
    const double depth = k == 0 ? 0.0 : ball_radius_m - center.z();
    if (k > 0 && !(depth > out.depth_m.back()))
      throw DataError("{}: frame {} is no deeper than the one before", press.string(), k);
    out.depth_m.push_back(depth);
    const double contact = k == 0 ? 0.0 : contact_radius(out.frames[k], depth, ball_radius_m, gap_m);
    out.contact_m.push_back(k == 0 ? 0.0 : std::max(contact, out.contact_m.back()));
  }
  if (out.frames.size() < 2) throw DataError("{}: has no frame after the reference", press.string());
  return out;
}

}  // namespace tacipc
