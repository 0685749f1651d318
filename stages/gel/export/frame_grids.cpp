#include "stages/gel/export/frame_grids.h"

#include <algorithm>
#include <array>

namespace tacipc {
namespace {

std::vector<double> numbers(const Positions& rows) { return {rows.data(), rows.data() + rows.size()}; }

Positions moved(const Positions& points, const Matrix4& pose) {
  Positions there = points * pose.topLeftCorner<3, 3>().transpose();
  there.rowwise() += pose.topRightCorner<3, 1>().transpose();
  return there;
}

/// Displacement and forces of every gel vertex.
std::vector<VtuArray> gel_data(const TetMesh& gel, const PressFolder& press, std::size_t frame, const Positions& x) {
  const ContactParts forces = press.contact_forces(frame);
  const std::vector<int> front = press.front_vertices();
  const auto of_all = [&](const Positions& of_front) {
    Positions all = Positions::Zero(x.rows(), 3);
    all(front, Eigen::all) = of_front;
    return numbers(all);
  };
  return {{"displacement", 3, numbers(x - gel.positions)},
          {"normal_force", 3, of_all(forces.normal)},
          {"friction_force", 3, of_all(forces.friction)}};
}

/// Adds pressure and shear of the contact, if the press has them.
void add_traction(VtuGrid& grid, const PressFolder& press, std::size_t frame, const std::vector<int>& front) {
  if (!press.has(PressArray::front_pressure)) return;
  const FrontTraction traction = press.front_by_contact(frame);
  Eigen::VectorXd pressure = Eigen::VectorXd::Zero(grid.points.rows());
  Positions shear = Positions::Zero(grid.points.rows(), 3);
  pressure(front) = traction.pressure;
  shear(front, Eigen::all) = traction.shear;
  grid.point_data.push_back({"pressure", 1, std::vector<double>(pressure.begin(), pressure.end())});
  grid.point_data.push_back({"shear", 3, numbers(shear)});
}

/// Keeps only the points that cells use, in their order, with their data.
void drop_unused_points(VtuGrid& grid) {
  const std::vector<int> used = drop_unused({grid.cells.data(), static_cast<std::size_t>(grid.cells.size())});
  grid.points = Positions(grid.points(used, Eigen::all));
  for (VtuArray& array : grid.point_data) {
    std::visit(
        [&](auto& values) {
          auto to = values.begin();
          for (const int vertex : used)
            to = std::copy_n(values.begin() + std::ptrdiff_t{vertex} * array.components, array.components, to);
          values.erase(to, values.end());
        },
        array.values);
  }
}

double tet_volume(const Positions& x, const Tetrahedra& tets, Eigen::Index t) {
  Matrix3 edges;
  for (int c = 0; c < 3; ++c) edges.col(c) = (x.row(tets(t, c + 1)) - x.row(tets(t, 0))).transpose();
  return edges.determinant() / 6.0;
}

VtuArray volume_ratios(const TetMesh& mesh, const Positions& x) {
  std::vector<double> ratios(static_cast<std::size_t>(mesh.num_tets()));
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t)
    ratios[static_cast<std::size_t>(t)] = tet_volume(x, mesh.tets, t) / tet_volume(mesh.positions, mesh.tets, t);
  return {"volume_ratio", 1, std::move(ratios)};
}

/// Index here (xx yy zz yz xz xy) of each component of a symmetric tensor in VTK (xx yy zz xy yz xz).
constexpr std::array<int, 6> kOfVtk{0, 1, 2, 5, 3, 4};

VtuArray stress_array(const SymmetricRows& stress_pa) {
  std::vector<double> values;
  for (Eigen::Index t = 0; t < stress_pa.rows(); ++t)
    for (const int ours : kOfVtk) values.push_back(stress_pa(t, ours));
  return {"stress", 6, std::move(values)};
}

/// Computes R σ Rᵀ with VTK's six components.
void turn_tensors(std::vector<double>& values, const Matrix3& R) {
  for (std::size_t at = 0; at < values.size(); at += 6) {
    double* v = &values[at];
    const Matrix3 turned = R * Matrix3{{v[0], v[3], v[5]}, {v[3], v[1], v[4]}, {v[5], v[4], v[2]}} * R.transpose();
    v[0] = turned(0, 0), v[1] = turned(1, 1), v[2] = turned(2, 2);
    v[3] = turned(0, 1), v[4] = turned(1, 2), v[5] = turned(0, 2);
  }
}

}  // namespace

std::vector<int> drop_unused(std::span<int> indices) {
  std::vector<int> used(indices.begin(), indices.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (int& vertex : indices)
    vertex = static_cast<int>(std::lower_bound(used.begin(), used.end(), vertex) - used.begin());
  return used;
}

VtuGrid surface_grid(const TetMesh& gel, const PressFolder& press, std::size_t frame) {
  VtuGrid grid{.points = press.positions(frame), .cells = gel.boundary};
  grid.point_data = gel_data(gel, press, frame, grid.points);
  std::vector<std::uint8_t> states(static_cast<std::size_t>(gel.num_vertices()), 0);
  const std::vector<int> front = press.front_vertices();
  const std::vector<ContactState> of_front = press.contact_states(frame);
  for (std::size_t v = 0; v < front.size(); ++v)
    states[static_cast<std::size_t>(front[v])] = static_cast<std::uint8_t>(of_front[v]);
  grid.point_data.push_back({"contact_state", 1, std::move(states)});
  add_traction(grid, press, frame, front);
  std::vector<std::uint8_t> tags;
  for (const BoundaryTag tag : gel.tags) tags.push_back(static_cast<std::uint8_t>(tag));
  grid.cell_data.push_back({"boundary", 1, std::move(tags)});
  drop_unused_points(grid);
  return grid;
}

VtuGrid volume_grid(const TetMesh& gel, const PressFolder& press, std::size_t frame) {
  VtuGrid grid{.points = press.positions(frame), .cells = gel.tets};
  grid.point_data = gel_data(gel, press, frame, grid.points);
  grid.cell_data.push_back(volume_ratios(gel, grid.points));
  if (press.has(PressArray::stress)) grid.cell_data.push_back(stress_array(press.stresses(frame)));
  return grid;
}

VtuGrid soft_grid(const TetMesh& soft, const Positions& first, const Positions& x) {
  VtuGrid grid{.points = x, .cells = soft.tets};
  grid.point_data.push_back({"displacement", 3, numbers(x - first)});
  grid.cell_data.push_back(volume_ratios(soft, x));
  return grid;
}

VtuGrid object_grid(const TriangleMesh& object, const Matrix4& world_from_object) {
  return {.points = moved(object.positions, world_from_object), .cells = object.triangles};
}

VtuGrid in_world(VtuGrid grid, const Matrix4& world_from_gel) {
  grid.points = moved(grid.points, world_from_gel);
  Matrix4 turn = world_from_gel;
  turn.topRightCorner<3, 1>().setZero();
  for (auto* arrays : {&grid.point_data, &grid.cell_data}) {
    for (VtuArray& array : *arrays) {
      auto* values = std::get_if<std::vector<double>>(&array.values);
      if (values && array.components == 6) turn_tensors(*values, turn.topLeftCorner<3, 3>());
      if (values && array.components == 3) {
        const auto rows = static_cast<Eigen::Index>(values->size() / 3);
        *values = numbers(moved(Eigen::Map<const Positions>(values->data(), rows, 3), turn));
      }
    }
  }
  return grid;
}

}  // namespace tacipc
