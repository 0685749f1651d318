#include "stages/gel/press/world/body_checks.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "common/base/error.h"
#include "common/sample/rigid_way.h"
#include "stages/gel/press/contact/intersection_check.h"
#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/contact/surface_pairs.h"
#include "stages/gel/press/measure/verdict.h"

namespace tacipc {
namespace {

SurfaceView view(const BodyShape& body) { return {body.positions, body.triangles}; }

/// Calls visit(i, j) for any two bodies of which at least one is not fixed.
template <typename Visit>
void for_each_two(const std::vector<BodyShape>& bodies, Visit&& visit) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      if (!bodies[i].fixed || !bodies[j].fixed) visit(i, j);
    }
  }
}

}  // namespace

void check_path(const std::string& name, const std::vector<Matrix4>& path, int time_steps) {
  if (path.size() != static_cast<std::size_t>(time_steps) + 1)
    throw DataError(
        "body {}: its path has {} poses; {} time steps need {}: one for the start and one for the end of each", name,
        path.size(), time_steps, time_steps + 1);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Matrix3 turn = path[i + 1].topLeftCorner<3, 3>() * path[i].topLeftCorner<3, 3>().transpose();
    if (const double angle = Eigen::AngleAxisd(turn).angle(); angle > kLongestTurn_rad)
      throw DataError("body {}: its path turns by {:.3g} rad in time step {}; a body turns by at most {} rad in one",
                      name, angle, i + 1, kLongestTurn_rad);
  }
}

int judge_bodies(int frame, const std::vector<BodyShape>& bodies) {
  std::int64_t sum = 0;
  const auto miss = [&](const char* check, double value, double limit, const std::string& reason) {
    throw VerdictError({.frame = frame, .check = check, .value = value, .limit = limit},
                       fmt::format("frame {}: {}", frame, reason));
  };
  const auto count = [&](std::int64_t found, const std::string& whose) {
    sum += found;
    if (found > kVerdictLimits.intersections)
      miss("intersections", static_cast<double>(found), kVerdictLimits.intersections,
           fmt::format("{} pairs of triangles of {} intersect", found, whose));
  };
  for (const BodyShape& body : bodies) {
    if (body.deformable) count(count_self_intersections(view(body)), body.name);
  }
  for_each_two(bodies, [&](std::size_t i, std::size_t j) {
    count(count_intersections(view(bodies[i]), view(bodies[j])),
          fmt::format("{} and {}", bodies[i].name, bodies[j].name));
    for (const auto& [inner, outer] : {std::pair(i, j), std::pair(j, i)}) {
      if (!bodies[outer].closed) continue;
      const Vector3 point = bodies[inner].positions.row(bodies[inner].triangles(0, 0));
      const double winds = winding_number(point, view(bodies[outer]));
      if (!(std::abs(winds) < kVerdictLimits.gel_in_object))
        miss("containment", winds, kVerdictLimits.gel_in_object,
             fmt::format("{} is inside {}", bodies[inner].name, bodies[outer].name));
    }
  });
  return static_cast<int>(sum);
}

void require_apart(const std::vector<BodyShape>& bodies, const ContactLaws& laws) {
  for_each_two(bodies, [&](std::size_t i, std::size_t j) {
    const BodyShape &a = bodies[i], &b = bodies[j];
    if (count_intersections(view(a), view(b)) > 0)
      throw DataError("bodies {} and {} intersect where they begin", a.name, b.name);
    Positions both(a.positions.rows() + b.positions.rows(), 3);
    both << a.positions, b.positions;
    const double d_hat = laws.of(static_cast<int>(i), static_cast<int>(j)).d_hat_m;
    std::vector<ContactPair> pairs;
    pairs_between(make_surface(a.triangles, 0), make_surface(b.triangles, static_cast<int>(a.positions.rows())), both,
                  Positions::Zero(both.rows(), 3), d_hat, pairs);
    if (const double gap = smallest_distance(pairs, both, 2.0 * d_hat); gap <= d_hat)
      throw DataError("bodies {} and {} are {:.3g} mm apart in frame 0: contact would begin at {:.3g} mm already",
                      a.name, b.name, 1e3 * gap, 1e3 * d_hat);
  });
}

}  // namespace tacipc
