// Blocks of tetrahedra and their static equilibrium under prescribed displacements, for tests of elements.
#pragma once

#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "stages/gel/press/energy/incremental_potential.h"
#include "stages/gel/press/solve/cholmod_solver.h"

namespace tacipc {

struct Block {
  Positions rest;
  Tetrahedra tets;
};

/// A box from the origin to `size` of cells[k] cells along each axis, six tetrahedra each; inner vertices are moved at
/// random by up to `jitter` of a cell so that no two tetrahedra are alike.
inline Block make_block(const Vector3& size, const std::array<int, 3>& cells, double jitter) {
  const std::array<int, 3> n{cells[0] + 1, cells[1] + 1, cells[2] + 1};
  const auto index = [&](int i, int j, int k) { return (k * n[1] + j) * n[0] + i; };
  Block block{Positions(n[0] * n[1] * n[2], 3), Tetrahedra(6 * cells[0] * cells[1] * cells[2], 4)};
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(-jitter, jitter);
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const std::array<int, 3> at{i, j, k};
        bool inner = true;
        for (int axis = 0; axis < 3; ++axis) inner = inner && at[axis] > 0 && at[axis] < cells[axis];
        for (int axis = 0; axis < 3; ++axis) {
          block.rest(index(i, j, k), axis) = size[axis] * (at[axis] + (inner ? uniform(random) : 0.0)) / cells[axis];
        }
      }
    }
  }
  constexpr int kPaths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
  int t = 0;
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        for (int path = 0; path < 6; ++path) {
          std::array<int, 3> at{i, j, k};
          std::array<int, 4> corners{index(at[0], at[1], at[2])};
          for (int step = 0; step < 3; ++step) {
            ++at[kPaths[path][step]];
            corners[step + 1] = index(at[0], at[1], at[2]);
          }
          if (path >= 3) std::swap(corners[2], corners[3]);  // odd permutations turn the other way
          for (int c = 0; c < 4; ++c) block.tets(t, c) = corners[c];
          ++t;
        }
      }
    }
  }
  return block;
}

/// Prescribed displacement of a vertex by axis; nothing where it is free.
using Prescribed = std::function<std::array<std::optional<double>, 3>(const Vector3& rest)>;

struct Equilibrium {
  Positions x;
  double energy = 0.0;
  Positions force;  // of the body on each vertex's support, negative gradient
  int iterations = 0;
  bool converged = false;
};

/// Gradient over all vertices and Hessian of the term at x.
inline double assemble_all(const EnergyTerm& term, const Positions& x, Order order, Eigen::VectorXd& gradient,
                           BlockMatrix& hessian) {
  double value = 0.0;
  gradient.setZero(3 * x.rows());
  std::fill(hessian.values.begin(), hessian.values.end(), 0.0);
  Local local;
  Eigen::VectorXd local_x;
  for (int s = 0; s < term.num_stencils(); ++s) {
    const auto stencil = term.stencil(s);
    gather(x, stencil, local_x);
    term.evaluate(s, local_x, order, local);
    value += local.value;
    if (order == Order::value || !std::isfinite(value)) continue;
    for (int a = 0; a < static_cast<int>(stencil.size()); ++a) {
      gradient.segment<3>(3 * stencil[a]) += local.gradient.segment<3>(3 * a);
      if (order == Order::gradient) continue;
      for (int b = 0; b < static_cast<int>(stencil.size()); ++b) {
        if (stencil[a] < stencil[b]) continue;
        hessian.block(hessian.pattern->find(stencil[a], stencil[b])) += local.hessian.block<3, 3>(3 * a, 3 * b);
      }
    }
  }
  return value;
}

inline BlockMatrix block_matrix_of(const EnergyTerm& term, Eigen::Index num_vertices) {
  std::vector<std::array<int, 2>> pairs;
  for (int s = 0; s < term.num_stencils(); ++s) {
    for (const int a : term.stencil(s)) {
      for (const int b : term.stencil(s)) pairs.push_back({a, b});
    }
  }
  return BlockMatrix(std::make_shared<BlockPattern>(make_block_pattern(static_cast<int>(num_vertices), pairs)));
}

/// Newton from rest, the prescribed displacements first and in as many parts as inversion asks for, until the largest
/// step falls below `tolerance` metres.
inline Equilibrium equilibrium(const Positions& rest, const EnergyTerm& term, const Prescribed& prescribed,
                               double tolerance) {
  const Eigen::Index n = 3 * rest.rows();
  Eigen::VectorXd target = Eigen::VectorXd::Zero(n), gradient;
  std::vector<bool> fixed(static_cast<std::size_t>(n), false);
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    const auto given = prescribed(rest.row(v));
    for (int axis = 0; axis < 3; ++axis) {
      fixed[3 * v + axis] = given[axis].has_value();
      target[3 * v + axis] = rest(v, axis) + given[axis].value_or(0.0);
    }
  }
  Equilibrium out;
  out.x = rest;
  BlockMatrix hessian = block_matrix_of(term, rest.rows());
  const BlockPattern& pattern = *hessian.pattern;
  CholmodSolver solver;
  bool arrived = false;
  while (out.iterations < 200) {
    ++out.iterations;
    Order order = Order::hessian;
    Eigen::VectorXd step;
    while (true) {
      assemble_all(term, out.x, order, gradient, hessian);
      const Eigen::VectorXd flat = out.x.reshaped<Eigen::RowMajor>();
      Eigen::VectorXd given = Eigen::VectorXd::Zero(n);
      for (Eigen::Index d = 0; d < n; ++d) given[d] = fixed[d] ? target[d] - flat[d] : 0.0;
      Eigen::VectorXd right = -gradient - hessian.multiply(given);
      for (Eigen::Index d = 0; d < n; ++d) right[d] = fixed[d] ? given[d] : right[d];
      for (int c = 0; c < pattern.size(); ++c) {
        for (int k = pattern.column_start[c]; k < pattern.column_start[c + 1]; ++k) {
          auto block = hessian.block(k);
          for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
              const int row = 3 * pattern.row[k] + i, column = 3 * c + j;
              if (fixed[row] || fixed[column]) block(i, j) = row == column ? 1.0 : 0.0;
            }
          }
        }
      }
      if (solver.prepare(hessian)) {
        step = solver.solve(right).value();
        break;
      }
      if (order == Order::psd) return out;
      order = Order::psd;
    }
    BlockMatrix none = hessian;
    const double before = assemble_all(term, out.x, Order::value, gradient, none);
    double alpha = 1.0;
    const Positions p = step.reshaped<Eigen::RowMajor>(rest.rows(), 3);
    while (alpha > 1e-6) {
      out.energy = assemble_all(term, out.x + alpha * p, Order::value, gradient, none);
      if (std::isfinite(out.energy) && (!arrived || out.energy <= before + 1e-7 * std::abs(before))) break;
      alpha *= 0.5;
    }
    out.x += alpha * p;
    arrived = arrived || alpha == 1.0;
    if (arrived && p.rowwise().norm().maxCoeff() < tolerance) {
      out.converged = true;
      break;
    }
  }
  assemble_all(term, out.x, Order::gradient, gradient, hessian);
  out.force = -gradient.reshaped<Eigen::RowMajor>(rest.rows(), 3);
  return out;
}

}  // namespace tacipc
