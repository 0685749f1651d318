#include "stages/gel/press/measure/front_traction.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>

namespace tacipc {
namespace {

using Side = std::array<int, 3>;

Side sorted(Side side) {
  std::sort(side.begin(), side.end());
  return side;
}

/// Outward normal of a triangle, with its area as length.
Vector3 area_vector(const FrontSurface& front, const Positions& front_positions, Eigen::Index triangle) {
  const auto corner = [&](int c) -> Vector3 { return front_positions.row(front.triangles(triangle, c)); };
  return 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0));
}

/// Traction of forces over lumped areas.
/// \param force_n force on each vertex, or its share of the forces on the triangles around
FrontTraction over_areas(const FrontSurface& front, const Positions& front_positions, const Positions& force_n) {
  const std::vector<double> areas = lumped_areas(front, front_positions);
  Positions normals = Positions::Zero(front_positions.rows(), 3);
  for (Eigen::Index f = 0; f < front.triangles.rows(); ++f) {
    const Vector3 area = area_vector(front, front_positions, f);
    for (int c = 0; c < 3; ++c) normals.row(front.triangles(f, c)) += area.transpose();
  }
  FrontTraction out{Eigen::VectorXd::Zero(front_positions.rows()), Positions::Zero(front_positions.rows(), 3)};
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    if (!(areas[v] > 0.0)) continue;
    const Vector3 t = force_n.row(row).transpose() / areas[v], n = normals.row(row).transpose().normalized();
    out.pressure[row] = 0.0 - t.dot(n);
    out.shear.row(row) = (t + out.pressure[row] * n).transpose();
  }
  return out;
}

}  // namespace

std::vector<int> tets_behind(const FrontSurface& front, const Tetrahedra& tets) {
  std::map<Side, std::size_t> triangle_of;
  for (Eigen::Index f = 0; f < front.triangles.rows(); ++f) {
    Side side;
    for (int c = 0; c < 3; ++c)
      side[static_cast<std::size_t>(c)] = front.vertices[static_cast<std::size_t>(front.triangles(f, c))];
    triangle_of.emplace(sorted(side), static_cast<std::size_t>(f));
  }
  std::vector<int> behind(static_cast<std::size_t>(front.triangles.rows()), -1);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (int opposite = 0; opposite < 4; ++opposite) {
      Side side;
      for (int k = 0; k < 3; ++k) side[static_cast<std::size_t>(k)] = tets(t, (opposite + 1 + k) % 4);
      const auto found = triangle_of.find(sorted(side));
      if (found != triangle_of.end()) behind[found->second] = static_cast<int>(t);
    }
  }
  assert(std::find(behind.begin(), behind.end(), -1) == behind.end());
  return behind;
}

FrontTraction traction_of_forces(const FrontSurface& front, const Positions& front_positions,
                                 const Positions& force_n) {
  return over_areas(front, front_positions, force_n);
}

FrontTraction traction_of_stress(const FrontSurface& front, const Positions& front_positions,
                                 const SymmetricRows& stress_pa, const std::vector<int>& behind) {
  Positions force_n = Positions::Zero(front_positions.rows(), 3);
  for (Eigen::Index f = 0; f < front.triangles.rows(); ++f) {
    const Matrix3 stress = symmetric(stress_pa, behind[static_cast<std::size_t>(f)]);
    const Vector3 third = stress * area_vector(front, front_positions, f) / 3.0;
    for (int c = 0; c < 3; ++c) force_n.row(front.triangles(f, c)) += third.transpose();
  }
  return over_areas(front, front_positions, force_n);
}

}  // namespace tacipc
