// Scenes that simulate in well under a second.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "stages/gel/press/drive/simulate.h"

namespace tacipc {

/// A structured block of gel, n × n × 2 cells of six tetrahedra each, with front at z = 0 and glued back.
inline TetMesh block_gel(int n, double width_m, double thickness_m) {
  TetMesh gel;
  const int nz = 2;
  const auto index = [&](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  gel.positions.resize((n + 1) * (n + 1) * (nz + 1), 3);
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        gel.positions.row(index(i, j, k)) << width_m * (1.0 * i / n - 0.5), width_m * (1.0 * j / n - 0.5),
            thickness_m * (1.0 * k / nz - 1.0);
      }
    }
  }
  // Kuhn's subdivision: one tetrahedron for each order in which the three axes are walked; odd orders are mirrored.
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  std::vector<std::array<int, 4>> tets;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        for (int o = 0; o < 6; ++o) {
          int at[3] = {i, j, k};
          std::array<int, 4> tet{index(i, j, k)};
          for (int s = 0; s < 3; ++s) {
            ++at[orders[o][s]];
            tet[s + 1] = index(at[0], at[1], at[2]);
          }
          if (o >= 3) std::swap(tet[1], tet[2]);
          tets.push_back(tet);
        }
      }
    }
  }
  gel.tets.resize(static_cast<Eigen::Index>(tets.size()), 4);
  for (std::size_t t = 0; t < tets.size(); ++t)
    gel.tets.row(static_cast<Eigen::Index>(t)) << tets[t][0], tets[t][1], tets[t][2], tets[t][3];
  gel.boundary = boundary_triangles(gel.tets, gel.num_vertices());
  for (Eigen::Index f = 0; f < gel.boundary.rows(); ++f) {
    double low = 1.0, high = -1.0;
    for (int c = 0; c < 3; ++c) {
      low = std::min(low, gel.positions(gel.boundary(f, c), 2));
      high = std::max(high, gel.positions(gel.boundary(f, c), 2));
    }
    gel.tags.push_back(high < -0.999 * thickness_m ? BoundaryTag::glued
                       : low > -1e-12              ? BoundaryTag::front
                                                   : BoundaryTag::side);
  }
  return gel;
}

/// A square pyramid with its tip on −z.
inline TriangleMesh pyramid(double half_width_m, double height_m) {
  const double w = half_width_m, h = height_m;
  return {Positions{{0, 0, 0}, {w, w, h}, {-w, w, h}, {-w, -w, h}, {w, -w, h}},
          Triangles{{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {1, 2, 3}, {1, 3, 4}}};
}

inline SampleSpec press(double depth_m, int steps) {
  SampleSpec sample;
  sample.motion = {{.kind = PhaseKind::press, .steps = steps, .depth_m = depth_m}};
  return sample;
}

}  // namespace tacipc
