#include "verification/lattice.h"

#include <algorithm>
#include <vector>

namespace tacipc::verify {
namespace {

// Kuhn's subdivision: one tetrahedron for each order in which the three axes are walked through a cell. A cell is
// walked upwards or downwards along an axis by the parity of its index, so that neighbours mirror each other.
constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

}  // namespace

TetMesh fill_lattice(const Lattice& lattice) {
  const auto& [nx, ny, nz] = lattice.cells;
  const auto index = [&](const LatticePoint& p) { return (p[2] * (ny + 1) + p[1]) * (nx + 1) + p[0]; };
  std::vector<std::array<int, 4>> tets;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const LatticePoint up{(i + lattice.shift[0]) % 2 == 0, (j + lattice.shift[1]) % 2 == 0,
                              (k + lattice.shift[2]) % 2 == 0};
        for (const auto& order : kOrders) {
          LatticePoint at{i + !up[0], j + !up[1], k + !up[2]};
          std::array<int, 4> tet{};
          bool whole = true;
          for (int s = 0; s < 4; ++s) {
            if (s > 0) at[order[s - 1]] += up[order[s - 1]] ? 1 : -1;
            const auto point = lattice.representative(at);
            tet[s] = point ? index(*point) : -1;
            whole = whole && point && std::find(tet.begin(), tet.begin() + s, tet[s]) == tet.begin() + s;
          }
          if (whole) tets.push_back(tet);
        }
      }
    }
  }
  std::vector<int> number((nx + 1) * (ny + 1) * (nz + 1), -1);
  for (const auto& tet : tets)
    for (const int v : tet) number[v] = 0;
  TetMesh gel;
  gel.positions.resize(std::ranges::count(number, 0), 3);
  int used = 0;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        int& n = number[index({i, j, k})];
        if (n < 0) continue;
        n = used++;
        gel.positions.row(n) = lattice.position({i, j, k});
      }
    }
  }
  gel.tets.resize(tets.size(), 4);
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const auto row = static_cast<Eigen::Index>(t);
    for (int c = 0; c < 4; ++c) gel.tets(row, c) = number[tets[t][c]];
    Matrix3 edges;
    for (int c = 0; c < 3; ++c)
      edges.col(c) = gel.positions.row(gel.tets(row, c + 1)) - gel.positions.row(gel.tets(row, 0));
    if (edges.determinant() < 0.0) std::swap(gel.tets(row, 1), gel.tets(row, 2));
  }
  return gel;
}

}  // namespace tacipc::verify
