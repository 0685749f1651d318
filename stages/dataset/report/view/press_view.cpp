#include "stages/dataset/report/view/press_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/mesh/spatial_order.h"
#include "common/mesh/tet_mesh.h"
#include "common/sample/press_folder.h"
#include "common/sample/sample_status.h"
#include "common/stage/record.h"
#include "stages/dataset/report/press_report.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// The same triangles, each from its lowest corner on, in ascending order: similar numbers follow each other.
Triangles sorted_triangles(const Triangles& triangles) {
  std::vector<std::array<int, 3>> rows;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::array<int, 3> corners{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    rows.push_back(corners);
  }
  std::sort(rows.begin(), rows.end());
  Triangles sorted(triangles.rows(), 3);
  for (Eigen::Index t = 0; t < sorted.rows(); ++t) {
    const auto& corners = rows[static_cast<std::size_t>(t)];
    sorted.row(t) << corners[0], corners[1], corners[2];
  }
  return sorted;
}

/// Triangles with every corner replaced by `place[corner]`.
Triangles renumbered(Triangles triangles, const std::vector<int>& place) {
  for (Eigen::Index i = 0; i < triangles.size(); ++i)
    triangles.data()[i] = place[static_cast<std::size_t>(triangles.data()[i])];
  return sorted_triangles(triangles);
}

TriangleMesh ordered(const TriangleMesh& mesh) {
  return {mesh.positions(spatial_order(mesh.positions), Eigen::all),
          renumbered(mesh.triangles, spatial_rank(mesh.positions))};
}

/// The front alone: which rows of the gel its vertices are, and its triangles among these.
struct Front {
  std::vector<int> order;  // rows of front_vertices
  std::vector<int> rows;   // the same as rows of the gel
  Triangles triangles;
};

Front front_of(const TetMesh& gel) {
  const std::vector<int> vertices = gel.vertices(BoundaryTag::front);
  Front front{.order = spatial_order(gel.positions(vertices, Eigen::all)), .rows = {}, .triangles = {}};
  std::vector<int> place(static_cast<std::size_t>(gel.num_vertices()), -1);
  for (const int v : front.order) {
    const int row = vertices[static_cast<std::size_t>(v)];
    place[static_cast<std::size_t>(row)] = static_cast<int>(front.rows.size());
    front.rows.push_back(row);
  }
  front.triangles = renumbered(gel.faces(BoundaryTag::front), place);
  return front;
}

ViewFrame read_frame(const PressFolder& press, const Front& front, int frame, const Matrix4& pose) {
  const auto f = static_cast<std::size_t>(frame);
  ViewFrame view{.frame = frame,
                 .positions = press.positions(f)(front.rows, Eigen::all),
                 .pressure_pa = {},
                 .state = {},
                 .gel_from_object = pose};
  const Positions force = press.contact_forces(f).normal(front.order, Eigen::all);
  view.pressure_pa = vertex_pressures(view.positions, front.triangles, force);
  const std::vector<ContactState> states = press.contact_states(f);
  for (const int v : front.order) view.state.push_back(states[static_cast<std::size_t>(v)]);
  return view;
}

}  // namespace

std::vector<int> viewed_frames(int frames, std::size_t front_vertices) {
  constexpr std::size_t kMostRows = 400'000;  // about 2 MB of data
  const auto most = static_cast<int>(std::max<std::size_t>(2, kMostRows / std::max<std::size_t>(1, front_vertices)));
  const int count = std::min(frames, most);
  std::vector<int> chosen;
  for (int i = 0; i < count; ++i)
    chosen.push_back(count == 1 ? 0 : static_cast<int>(std::lround(double(i) * (frames - 1) / (count - 1))));
  return chosen;
}

Eigen::VectorXd vertex_pressures(const Positions& x, const Triangles& triangles, const Positions& normal_force_n) {
  Positions area = Positions::Zero(x.rows(), 3);  // Σ of a third of each triangle's area vector
  Eigen::VectorXd size = Eigen::VectorXd::Zero(x.rows());
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Vector3 a = x.row(triangles(t, 0)), b = x.row(triangles(t, 1)), c = x.row(triangles(t, 2));
    const Vector3 third = (b - a).cross(c - a) / 6.0;
    for (int k = 0; k < 3; ++k) {
      area.row(triangles(t, k)) += third.transpose();
      size[triangles(t, k)] += third.norm();
    }
  }
  Eigen::VectorXd pressure = Eigen::VectorXd::Zero(x.rows());
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double length = area.row(v).norm();
    if (size[v] > 0.0 && length > 0.0)
      pressure[v] = std::max(0.0, -normal_force_n.row(v).dot(area.row(v)) / (length * size[v]));
  }
  return pressure;
}

std::optional<PressView> read_press_view(const fs::path& folder) {
  if (was_dropped(folder) || !fs::is_regular_file(folder / "press.yaml")) return std::nullopt;
  const Record record = Record::from_file(folder / "press.yaml");
  std::string why;
  const auto gel_path = pressed_input(folder, record, "gel", why);
  const auto object_path = pressed_input(folder, record, "object", why);
  if (!gel_path || !object_path) return std::nullopt;
  const TetMesh gel = read_tet_mesh(*gel_path);
  const PressFolder press = PressFolder::finished(folder, {{kVertices, static_cast<std::size_t>(gel.num_vertices())}});
  using enum PressArray;
  for (const PressArray array : {positions, object_pose, contact_force, contact_state, front_vertices}) {
    if (!press.has(array)) return std::nullopt;
  }
  press.require_front(gel.vertices(BoundaryTag::front));
  const Front front = front_of(gel);
  const std::vector<Matrix4> poses = press.poses();
  PressView view{.front = front.triangles,
                 .bottom_m = gel.positions.col(2).minCoeff(),
                 .frames = {},
                 .object = ordered(read_triangle_mesh(*object_path, 1.0))};
  for (const int frame : viewed_frames(static_cast<int>(poses.size()), front.rows.size()))
    view.frames.push_back(read_frame(press, front, frame, poses[static_cast<std::size_t>(frame)]));
  return view;
}

}  // namespace tacipc
