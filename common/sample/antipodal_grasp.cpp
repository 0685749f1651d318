#include "common/sample/antipodal_grasp.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "common/base/error.h"
#include "common/base/rng.h"

namespace tacipc {
namespace {

constexpr int kTries = 4000;  // points drawn before the object counts as not graspable
constexpr int kRim = 8;       // points on the rim of a patch
constexpr int kHalvings = 3;  // halvings of the patch before it is ignored
constexpr int kCorners = 16;  // corners of the polygon around a round front
constexpr double kRounding = 1e-9;
constexpr double kUnit = 1e-6;  // tolerance of a quaternion's length

/// Conditions that rule out a point, in the order of their test.
enum class Ruled { narrow, wide, cone, patch, blocked, count };

/// A half-plane n · (y, z) ≤ offset; a front is an intersection of them, seen along the grasp line. Both fronts have
/// their width along y and their height along z. They are mirrored to each other, which makes no difference, because a
/// front is symmetric about its middle.
struct HalfPlane {
  Eigen::Vector2d normal;
  double offset = 0.0;
};

std::vector<HalfPlane> outline_of(const GelShape& front) {
  if (front.outline == GelShape::Outline::rectangle)
    return {{{1, 0}, 0.5 * front.width_m},
            {{-1, 0}, 0.5 * front.width_m},
            {{0, 1}, 0.5 * front.height_m},
            {{0, -1}, 0.5 * front.height_m}};
  std::vector<HalfPlane> outline;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kCorners;
    outline.push_back({{std::cos(angle), std::sin(angle)}, front.radius_m});
  }
  return outline;
}

using Polygon = std::vector<Vector3>;

/// Clips a convex polygon to value(x) ≤ 0, a linear function. [Sutherland and Hodgman 1974]
template <typename Value>
void clip(Polygon& polygon, Polygon& scratch, const Value& value) {
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = value(a), at_b = value(b);
    if (at_a <= 0.0) scratch.push_back(a);
    if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0)) scratch.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  std::swap(polygon, scratch);
}

/// The object in the hand's frame: p at the origin, the grasp line along x.
class SeenObject {
 public:
  SeenObject(const TriangleMesh& object, const Vector3& p, const Matrix3& hand_from_object)
      : triangles_(object.triangles),
        at_((object.positions.rowwise() - p.transpose()) * hand_from_object.transpose()) {}

  /// First and last intersection along x of the object with the line through (y, z), and the face of the last.
  struct Crossing {
    double first = std::numeric_limits<double>::infinity(), last = -std::numeric_limits<double>::infinity();
    Eigen::Index last_face = -1;
  };
  Crossing crossing(const Eigen::Vector2d& at) const {
    Crossing found;
    for (Eigen::Index t = 0; t < triangles_.rows(); ++t) {
      std::array<Eigen::Vector2d, 3> corner;
      for (int k = 0; k < 3; ++k) corner[k] = at_.row(triangles_(t, k)).tail<2>().transpose() - at;
      if ((corner[0].x() > 0 && corner[1].x() > 0 && corner[2].x() > 0) ||
          (corner[0].x() < 0 && corner[1].x() < 0 && corner[2].x() < 0))
        continue;
      // Twice the areas of the three parts into which the point divides the triangle. Edges belong to both sides.
      std::array<double, 3> part;
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector2d &b = corner[(k + 1) % 3], &c = corner[(k + 2) % 3];
        part[k] = b.x() * c.y() - b.y() * c.x();
      }
      const double all = part[0] + part[1] + part[2];
      if (all == 0.0 || (part[0] * all < 0.0) || (part[1] * all < 0.0) || (part[2] * all < 0.0)) continue;
      double x = 0.0;
      for (int k = 0; k < 3; ++k) x += part[k] / all * at_(triangles_(t, k), 0);
      found.first = std::min(found.first, x);
      if (x > found.last) found.last = x, found.last_face = t;
    }
    return found;
  }

  /// Returns whether the object extends beyond x (towards −x for `side` −1, towards +x for +1) within the outline.
  bool reaches(int side, double x, const std::vector<HalfPlane>& outline) const {
    Polygon polygon, scratch;
    for (Eigen::Index t = 0; t < triangles_.rows(); ++t) {
      double most = -std::numeric_limits<double>::infinity();
      for (int k = 0; k < 3; ++k) most = std::max(most, side * at_(triangles_(t, k), 0));
      if (most <= side * x) continue;
      polygon.clear();
      for (int k = 0; k < 3; ++k) polygon.emplace_back(at_.row(triangles_(t, k)));
      clip(polygon, scratch, [&](const Vector3& v) { return side * (x - v.x()); });
      for (const HalfPlane& edge : outline) {
        if (polygon.empty()) break;
        clip(polygon, scratch, [&](const Vector3& v) { return edge.normal.dot(v.tail<2>()) - edge.offset; });
      }
      if (!polygon.empty()) return true;
    }
    return false;
  }

  double cosine_to_line(Eigen::Index face) const {
    const Vector3 a = at_.row(triangles_(face, 0)), b = at_.row(triangles_(face, 1)), c = at_.row(triangles_(face, 2));
    return (b - a).cross(c - a).normalized().x();
  }

 private:
  const Triangles& triangles_;
  Positions at_;
};

/// Returns the axes of the hand, as rows in the object's axes: x along `line`, z upwards or rotated from there about x.
Matrix3 hand_from_object(const Vector3& line, double roll_rad) {
  Vector3 up = Vector3::UnitZ() - line.z() * line;
  // If the line is z itself, every direction across it is equivalent.
  if (up.norm() < 1e-6) up = Vector3::UnitY() - line.y() * line;
  up.normalize();
  const Vector3 z = std::cos(roll_rad) * up + std::sin(roll_rad) * line.cross(up);
  Matrix3 axes;
  axes << line.transpose(), z.cross(line).transpose(), z.transpose();
  return axes;
}

std::string why_none(const std::array<int, static_cast<std::size_t>(Ruled::count)>& ruled, double friction,
                     const GraspDraw& draw) {
  const std::array<std::string, static_cast<std::size_t>(Ruled::count)> reasons{
      fmt::format("narrower than {:.4g} mm (width_mm)", 1e3 * draw.least_width_m),
      fmt::format("wider than {:.4g} mm (width_mm)", 1e3 * draw.most_width_m),
      fmt::format("with the other side's normal outside the friction cone of {:.3g}°",
                  std::atan(friction) * 180.0 / std::numbers::pi),
      fmt::format("without a patch of {:.4g} mm within a depth of {:.4g} mm (patch_mm, depth_mm)", 1e3 * draw.patch_m,
                  1e3 * draw.depth_m),
      fmt::format("where the rest of the object stands before a front by more than {:.4g} mm (depth_mm)",
                  1e3 * draw.depth_m)};
  std::string text;
  for (std::size_t r = 0; r < reasons.size(); ++r)
    if (ruled[r] > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", ruled[r], reasons[r]);
  return fmt::format("no grasp was found at {} places of the object's surface: {}; see fingers.draw", kTries, text);
}

}  // namespace

Eigen::Quaterniond read_rotation(ConfigReader& in) {
  const auto xyzw = in.numbers_or("rotation_xyzw", {0.0, 0.0, 0.0, 1.0});
  const Eigen::Quaterniond rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  if (std::abs(rotation.norm() - 1.0) > kUnit) in.fault("rotation_xyzw", "is no unit quaternion");
  return rotation.normalized();
}

double GraspPose::lever_m() const { return (world_from_object * grip_m).tail<2>().norm(); }

GraspDraw GraspDraw::read(ConfigReader& in) {
  GraspDraw draw = read_limits(in);
  draw.seed = static_cast<std::uint64_t>(in.number_or("seed", 1.0, Range::between(0.0, 0x1p53)));
  return draw;
}

GraspDraw GraspDraw::read_limits(ConfigReader& in) {
  GraspDraw draw;
  draw.best_of = in.integer_or("best_of", draw.best_of, 1, kTries);
  draw.upright = in.flag_or("upright", draw.upright);
  const auto width = in.numbers_or("width_mm", {1e3 * draw.least_width_m, 1e3 * draw.most_width_m}, Range::positive());
  if (width[0] >= width[1]) in.fault("width_mm", "a hand opens from the lower to the higher number");
  draw.least_width_m = 1e-3 * width[0];
  draw.most_width_m = 1e-3 * width[1];
  draw.patch_m = 1e-3 * in.number_or("patch_mm", 1e3 * draw.patch_m, Range::non_negative());
  draw.depth_m = 1e-3 * in.number_or("depth_mm", 1e3 * draw.depth_m, Range::positive());
  return draw;
}

namespace {

/// Draws a grasp with a patch of fixed width.
/// \throw DataError if no point has a patch as wide as `draw` requires
GraspPose draw_with_patch(const TriangleMesh& object, const Vector3& center_of_mass_m, const GelShape& front,
                          double friction, const GraspDraw& draw) {
  std::vector<double> area_up_to;
  std::vector<Vector3> normals;
  for (Eigen::Index t = 0; t < object.num_triangles(); ++t) {
    const Vector3 a = object.positions.row(object.triangles(t, 0)), b = object.positions.row(object.triangles(t, 1)),
                  c = object.positions.row(object.triangles(t, 2));
    const Vector3 normal = (b - a).cross(c - a);
    area_up_to.push_back((area_up_to.empty() ? 0.0 : area_up_to.back()) + normal.norm());
    normals.push_back(normal.stableNormalized());
  }
  const std::vector<HalfPlane> outline = outline_of(front);
  const double least_cosine = std::cos(std::atan(friction)) - kRounding;
  std::array<int, static_cast<std::size_t>(Ruled::count)> ruled{};
  std::optional<GraspPose> best;
  int found = 0;
  for (std::uint64_t i = 0; i < kTries && found < draw.best_of; ++i) {
    const auto u = [&](std::uint64_t d) { return random_uniform(draw.seed, hash_of("grasp"), 4 * i + d); };
    const auto at = std::upper_bound(area_up_to.begin(), area_up_to.end(), u(0) * area_up_to.back());
    const auto face = std::min<std::ptrdiff_t>(at - area_up_to.begin(), object.num_triangles() - 1);
    // Uniform in a triangle: [Osada et al. 2002].
    const double root = std::sqrt(u(1));
    const Eigen::RowVector3d weights(1.0 - root, root * (1.0 - u(2)), root * u(2));
    Vector3 p = Vector3::Zero();
    for (int k = 0; k < 3; ++k) p += weights[k] * object.positions.row(object.triangles(face, k)).transpose();

    GraspPose pose;
    const Vector3 line = -normals[static_cast<std::size_t>(face)];
    pose.world_from_object = hand_from_object(line, draw.upright ? 0.0 : 2.0 * std::numbers::pi * u(3));
    const SeenObject seen(object, p, pose.world_from_object);
    const SeenObject::Crossing across = seen.crossing(Eigen::Vector2d::Zero());
    const double width = across.last;
    const auto rule_out = [&]() -> std::optional<Ruled> {
      if (!(width >= draw.least_width_m)) return Ruled::narrow;
      if (width > draw.most_width_m) return Ruled::wide;
      if (seen.cosine_to_line(across.last_face) < least_cosine) return Ruled::cone;
      for (int k = 0; k < kRim; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kRim;
        const auto rim = seen.crossing(0.5 * draw.patch_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
        if (!(rim.first <= draw.depth_m && rim.last >= width - draw.depth_m)) return Ruled::patch;
      }
      if (seen.reaches(-1, -draw.depth_m, outline) || seen.reaches(1, width + draw.depth_m, outline))
        return Ruled::blocked;
      return std::nullopt;
    };
    if (const std::optional<Ruled> reason = rule_out()) {
      ++ruled[static_cast<std::size_t>(*reason)];
      continue;
    }
    ++found;
    pose.width_m = width;
    pose.patch_m = draw.patch_m;
    pose.grip_m = p + 0.5 * width * line - center_of_mass_m;
    if (!best || pose.lever_m() < best->lever_m()) best = pose;
  }
  if (!best) throw DataError("{}", why_none(ruled, friction, draw));
  return *best;
}

}  // namespace

GraspPose draw_grasp(const TriangleMesh& object, const Vector3& center_of_mass_m, const GelShape& front,
                     double friction, const GraspDraw& draw) {
  GraspDraw narrower = draw;
  for (int halvings = 0;; ++halvings) {
    try {
      return draw_with_patch(object, center_of_mass_m, front, friction, narrower);
    } catch (const DataError&) {
      if (narrower.patch_m == 0.0) throw;
    }
    narrower.patch_m = halvings < kHalvings ? 0.5 * narrower.patch_m : 0.0;
  }
}

}  // namespace tacipc
