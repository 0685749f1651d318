#include "stages/gel/tetmesh/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tacipc {
namespace {

/// Even permutations of a tetrahedron's corners that bring a given one to the front.
constexpr std::array<std::array<int, 4>, 4> kFrontedBy{{{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}}};

/// Tetrahedra around each vertex, as one list with offsets.
struct Stars {
  std::vector<int> first;
  std::vector<int> tets;
};

Stars stars_of(const TetMesh& mesh) {
  Stars stars;
  stars.first.assign(static_cast<std::size_t>(mesh.num_vertices()) + 1, 0);
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i) ++stars.first[static_cast<std::size_t>(mesh.tets(t, i)) + 1];
  for (std::size_t v = 1; v < stars.first.size(); ++v) stars.first[v] += stars.first[v - 1];
  stars.tets.resize(static_cast<std::size_t>(4 * mesh.num_tets()));
  std::vector<int> next = stars.first;
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i) {
      stars.tets[static_cast<std::size_t>(next[static_cast<std::size_t>(mesh.tets(t, i))]++)] = static_cast<int>(t);
    }
  return stars;
}

/// One vertex and the tetrahedra around it.
class Star {
 public:
  Star(const TetMesh& mesh, int vertex, const int* first, const int* last) : x_(mesh.positions.row(vertex)) {
    for (const int* t = first; t != last; ++t) {
      int place = 0;
      while (mesh.tets(*t, place) != vertex) ++place;
      const auto corner = [&](int i) -> Vector3 { return mesh.positions.row(mesh.tets(*t, kFrontedBy[place][i])); };
      faces_.push_back({corner(1), corner(2), corner(3)});
    }
  }

  /// Worst shape with the vertex at x. Stops early with any value ≤ `enough` once the shape falls to `enough`.
  double worst_at(const Vector3& x, double enough, std::size_t* worst_face = nullptr) const {
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const double shape = smallest_dihedral_sine(x, faces_[f][0], faces_[f][1], faces_[f][2]);
      if (shape >= worst) continue;
      worst = shape;
      if (worst_face != nullptr) *worst_face = f;
      if (worst <= enough) break;
    }
    return worst;
  }

  /// The best of a few positions that improves on the vertex's own.
  Vector3 improved() const {
    constexpr double kNoBound = -std::numeric_limits<double>::infinity();
    std::size_t worst_face = 0;
    double best = worst_at(x_, kNoBound, &worst_face);
    Vector3 place = x_, middle = Vector3::Zero();
    for (const auto& f : faces_) middle += (f[0] + f[1] + f[2]) / (3.0 * static_cast<double>(faces_.size()));
    const auto& [a, b, c] = faces_[worst_face];
    const Vector3 normal = (b - a).cross(c - a);
    const Vector3 away = normal / std::sqrt(normal.norm());  // as long as the face is wide
    for (const Vector3& direction : {Vector3(middle - x_), away, Vector3(-away)})
      for (const double step : {1.0, 0.5, 0.25, 0.1, 0.03}) {
        const Vector3 trial = x_ + step * direction;
        const double shape = worst_at(trial, best);
        if (shape <= best) continue;
        best = shape;
        place = trial;
      }
    return place;
  }

 private:
  Vector3 x_;
  std::vector<std::array<Vector3, 3>> faces_;
};

}  // namespace

double smallest_dihedral_sine(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  // Sine of the dihedral angle at an edge = 3/2 · V · edge / (area · area of its two faces), in terms of 6V and 2·area:
  // 6V · edge / (2A₁ · 2A₂).
  const double six_volumes = (b - a).dot((c - a).cross(d - a));
  const double bcd = (c - b).cross(d - b).norm(), acd = (c - a).cross(d - a).norm(), abd = (b - a).cross(d - a).norm(),
               abc = (b - a).cross(c - a).norm();
  const std::array<double, 6> quotients{(b - a).norm() / (abc * abd), (c - a).norm() / (abc * acd),
                                        (d - a).norm() / (abd * acd), (c - b).norm() / (abc * bcd),
                                        (d - b).norm() / (abd * bcd), (d - c).norm() / (acd * bcd)};
  const auto [low, high] = std::minmax_element(quotients.begin(), quotients.end());
  return six_volumes * (six_volumes > 0.0 ? *low : *high);
}

void smooth(TetMesh& mesh, int sweeps) {
  std::vector<bool> fixed(static_cast<std::size_t>(mesh.num_vertices()), false);
  for (const int v : mesh.boundary.reshaped()) fixed[static_cast<std::size_t>(v)] = true;
  const Stars stars = stars_of(mesh);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (int v = 0; v < mesh.num_vertices(); ++v) {
      const auto i = static_cast<std::size_t>(v);
      if (fixed[i] || stars.first[i] == stars.first[i + 1]) continue;
      mesh.positions.row(v) =
          Star(mesh, v, stars.tets.data() + stars.first[i], stars.tets.data() + stars.first[i + 1]).improved();
    }
}

}  // namespace tacipc
