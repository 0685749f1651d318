#include "stages/dataset/report/view/scene_pictures.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

namespace tacipc {
namespace {

using Box = Eigen::AlignedBox3d;

Vector3 moved(const Matrix4& pose, const Vector3& p) {
  return pose.topLeftCorner<3, 3>() * p + pose.topRightCorner<3, 1>();
}

Box box_of(const Positions& x) {
  Box box;
  for (Eigen::Index v = 0; v < x.rows(); ++v) box.extend(Vector3(x.row(v).transpose()));
  return box;
}

void add_corners(std::vector<Vector3>& points, const Box& box, const Matrix4& pose) {
  for (int i = 0; i < 8; ++i) points.push_back(moved(pose, box.corner(static_cast<Box::CornerType>(i))));
}

Box box_of(const std::vector<Vector3>& points) {
  Box box;
  for (const Vector3& p : points) box.extend(p);
  return box;
}

std::vector<Vector3> corners_of(const ViewedObject& object) {
  std::vector<Vector3> points;
  const Box box = box_of(object.mesh.positions);
  for (const Matrix4& pose : object.world_from_object) add_corners(points, box, pose);
  for (const Positions& x : object.deformed) add_corners(points, box_of(x), Matrix4::Identity());
  return points;
}

/// Points that the pictures must contain: gels, freely moving bodies, and other bodies that are near them and not
/// large.
std::vector<Vector3> points_of_interest(const SceneView& view) {
  std::vector<Vector3> points;
  for (const ViewedGel& gel : view.gels) {
    for (const ViewedFront& front : gel.frames) {
      Box box = box_of(front.positions);
      box.extend(Vector3(box.center().x(), box.center().y(), gel.bottom_m));
      add_corners(points, box, front.world_from_gel);
    }
  }
  for (const ViewedObject& object : view.objects) {
    if (object.fixed || object.robot) continue;
    const std::vector<Vector3> more = corners_of(object);
    points.insert(points.end(), more.begin(), more.end());
  }
  const auto grow = [&](double largest) {
    Box close = box_of(points);
    const Vector3 touching = Vector3::Constant(0.05 * close.sizes().maxCoeff());
    close = Box(close.min() - touching, close.max() + touching);
    for (const ViewedObject& object : view.objects) {
      if (!object.robot && !object.fixed) continue;
      const std::vector<Vector3> more = corners_of(object);
      if (!close.intersects(box_of(more)) || box_of(object.mesh.positions).sizes().maxCoeff() > largest) continue;
      points.insert(points.end(), more.begin(), more.end());
    }
  };
  // First the supports of the gels and of the bodies, then the bodies attached to these.
  constexpr double kLargest = 2.0;
  const double size = box_of(points).sizes().maxCoeff();
  grow(kLargest * size);
  grow(kLargest * size);
  return points;
}

/// Edges that belong to a single triangle, in its direction.
std::vector<std::pair<int, int>> rim_of(const Triangles& triangles) {
  std::map<std::pair<int, int>, std::pair<int, int>> open;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
      const auto edge = std::minmax(a, b);
      if (open.erase(edge) == 0) open.emplace(edge, std::pair(a, b));
    }
  }
  std::vector<std::pair<int, int>> rim;
  for (const auto& [edge, ends] : open) rim.push_back(ends);
  return rim;
}

/// Surface of a gel: its front in a frame, sides from the rim down to the mount, and the back there.
TriangleMesh gel_surface(const ViewedGel& gel, std::size_t frame, const std::vector<std::pair<int, int>>& rim) {
  const Positions &now = gel.frames[frame].positions, &rest = gel.frames.front().positions;
  const Eigen::Index front = now.rows(), sides = static_cast<Eigen::Index>(rim.size());
  TriangleMesh mesh{Positions(2 * front, 3), Triangles(2 * gel.front.rows() + 2 * sides, 3)};
  mesh.positions << now, rest;
  mesh.positions.col(2).tail(front).setConstant(gel.bottom_m);
  mesh.triangles.topRows(gel.front.rows()) = gel.front;
  mesh.triangles.bottomRows(gel.front.rows()) = gel.front.array() + static_cast<int>(front);
  Eigen::Index row = gel.front.rows();
  for (const auto& [a, b] : rim) {
    const int under_a = a + static_cast<int>(front), under_b = b + static_cast<int>(front);
    mesh.triangles.row(row++) << a, under_a, under_b;
    mesh.triangles.row(row++) << a, under_b, b;
  }
  return mesh;
}

ByteImage picture_of(const SceneView& view, std::size_t shown, const Viewpoint& from, int width, int height) {
  Raster raster(width, height, from);
  int body = 0;
  for (const ViewedGel& gel : view.gels)
    raster.draw(gel_surface(gel, shown, rim_of(gel.front)), gel.frames[shown].world_from_gel, picture_colors::kGel,
                body++);
  for (const ViewedObject& object : view.objects) {
    const bool soft = !object.deformed.empty();
    const Color& color = object.robot   ? picture_colors::kRobot
                         : object.fixed ? picture_colors::kFixed
                         : soft         ? picture_colors::kSoft
                                        : picture_colors::kObject;
    const TriangleMesh mesh{soft ? object.deformed[shown] : object.mesh.positions, object.mesh.triangles};
    raster.draw(mesh, object.world_from_object[shown], color, body++);
  }
  return raster.picture();
}

}  // namespace

std::vector<PicturedInstant> pictured_instants(const SceneView& view, std::optional<int> first_contact) {
  constexpr std::size_t kMost = 5;
  const std::size_t last = view.frames.size() - 1;
  std::vector<PicturedInstant> instants{{0, "start"}};
  if (first_contact) {
    const auto at = std::lower_bound(view.frames.begin(), view.frames.end(), *first_contact);
    const auto shown = static_cast<std::size_t>(at - view.frames.begin());
    if (shown > 0 && shown < last) instants.push_back({shown, "first contact"});
  }
  const std::size_t from = instants.back().shown, parts = kMost - instants.size();
  for (std::size_t i = 1; i < parts; ++i) {
    const std::size_t shown = from + i * (last - from) / parts;
    if (shown > instants.back().shown && shown < last) instants.push_back({shown, ""});
  }
  if (last > 0) instants.push_back({last, "end"});
  return instants;
}

Viewpoint scene_viewpoint(const SceneView& view, double aspect) {
  // Tangents of the angles away from the perpendicular direction and above the horizontal. A gel that looks down is
  // seen from the side.
  constexpr double kAside = 0.3, kAbove = 0.3, kLow = 0.12, kDown = -0.5;
  const Vector3 front = view.gels.front().frames.front().world_from_gel.block<3, 1>(0, 2);
  Vector3 along(front.x(), front.y(), 0.0);
  along = along.norm() > 0.3 ? along.normalized()
                             : Vector3(Vector3::UnitX());  // a gel that looks down has no horizontal direction
  Vector3 across = Vector3::UnitZ().cross(along);
  if (across.y() > 0.0) across = -across;
  const Vector3 right = Vector3::UnitZ().cross(across);
  return viewpoint_of(points_of_interest(view),
                      across + kAside * right + (front.z() < kDown ? kLow : kAbove) * Vector3::UnitZ(), aspect);
}

ByteImage scene_pictures(const SceneView& view, const std::vector<PicturedInstant>& instants,
                         const std::vector<Instant>& frames, int width, int height) {
  constexpr int kGap = 8, kLetters = 13, kHead = 54;
  constexpr Color kInk{27, 35, 48}, kQuiet{93, 104, 120};
  const int columns = static_cast<int>(instants.size());
  const Viewpoint from = scene_viewpoint(view, static_cast<double>(width) / height);
  ByteImage sheet(columns * (width + kGap) - kGap, kHead + height, 3, 255);
  for (int column = 0; column < columns; ++column) {
    const PicturedInstant& instant = instants[static_cast<std::size_t>(column)];
    const Instant& now = frames.at(static_cast<std::size_t>(view.frames[instant.shown]));
    const int x = column * (width + kGap);
    const std::string time = fmt::format("{:.2f} s", now.time_s);
    draw_text(sheet, fitted({instant.what.empty() ? time : time + ", " + instant.what, kLetters, kInk, true}, width),
              x + kGap, kLetters + 5);
    draw_text(sheet, fitted({now.phase, kLetters - 1, kQuiet}, width), x + kGap, 2 * kLetters + 14);
    paste(sheet, picture_of(view, instant.shown, from, width, height), x, kHead);
  }
  return sheet;
}

}  // namespace tacipc
