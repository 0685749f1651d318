#include "stages/press/solve/conjugate_gradient.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "common/simd.h"

namespace tacipc {
namespace {

// Vectors are padded: four numbers per vertex.
double total(const Quad& sum) { return (sum[0] + sum[1]) + (sum[2] + sum[3]); }

/// z = M⁻¹ r; returns rᵀz.
TACIPC_CLONES double precondition(const double* inverse, const double* r, double* z, int n) {
  Quad sum = {};
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double* block = inverse + static_cast<std::ptrdiff_t>(BlockMatrix::kStride) * i;
    const Quad ri = load_quad(r + 4 * i);
    const Quad zi = load_quad(block) * ri[0] + load_quad(block + 4) * ri[1] + load_quad(block + 8) * ri[2];
    store_quad(z + 4 * i, zi);
    sum += ri * zi;
  }
  return total(sum);
}

TACIPC_CLONES double dot_product(const double* a, const double* b, int n) {
  Quad sum = {};
  for (std::ptrdiff_t i = 0; i < n; ++i) sum += load_quad(a + 4 * i) * load_quad(b + 4 * i);
  return total(sum);
}

/// x += α p, r −= α q.
TACIPC_CLONES void advance(double alpha, const double* p, const double* q, double* x, double* r, int n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    store_quad(x + 4 * i, load_quad(x + 4 * i) + alpha * load_quad(p + 4 * i));
    store_quad(r + 4 * i, load_quad(r + 4 * i) - alpha * load_quad(q + 4 * i));
  }
}

/// p = z + β p.
TACIPC_CLONES void turn(double beta, const double* z, double* p, int n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) store_quad(p + 4 * i, load_quad(z + 4 * i) + beta * load_quad(p + 4 * i));
}

}  // namespace

std::unique_ptr<LinearSolver> make_linear_solver(LinearSolverKind kind) {
  if (kind == LinearSolverKind::direct) return std::make_unique<CholmodSolver>();
  return std::make_unique<ConjugateGradient>();
}

bool ConjugateGradient::prepare(const BlockMatrix& matrix) {
  matrix_ = &matrix;
  const BlockPattern& pattern = *matrix.pattern;
  inverse_diagonal_.assign(BlockMatrix::kStride * static_cast<std::size_t>(pattern.size()), 0.0);
  for (int c = 0; c < pattern.size(); ++c) {
    const Eigen::LLT<Matrix3> factor(Matrix3(matrix.block(pattern.column_start[c])));
    if (factor.info() != Eigen::Success) return false;
    BlockMatrix::Block(inverse_diagonal_.data() + BlockMatrix::kStride * static_cast<std::size_t>(c)) =
        factor.solve(Matrix3::Identity());
  }
  return true;
}

std::optional<Eigen::VectorXd> ConjugateGradient::factorize(const Eigen::VectorXd& b) {
  ++factorized_;
  if (!direct_.prepare(*matrix_)) return std::nullopt;
  return direct_.solve(b);
}

std::optional<Eigen::VectorXd> ConjugateGradient::solve(const Eigen::VectorXd& b) {
  const int n = matrix_->pattern->size();
  std::vector<double> r = padded(b), x(r.size(), 0.0), z(r.size()), q(r.size());
  double rz = precondition(inverse_diagonal_.data(), r.data(), z.data(), n);
  std::vector<double> p = z;
  const double enough = tolerance_ * tolerance_ * rz;
  for (int i = 0; rz > enough; ++i) {
    if (i == max_products_) return factorize(b);
    matrix_->multiply_padded(p.data(), q.data());
    ++products_;
    const double curvature = dot_product(p.data(), q.data(), n);
    if (!(curvature > 0.0)) return std::nullopt;
    advance(rz / curvature, p.data(), q.data(), x.data(), r.data(), n);
    const double last = rz;
    rz = precondition(inverse_diagonal_.data(), r.data(), z.data(), n);
    turn(rz / last, z.data(), p.data(), n);
  }
  return unpadded(x);
}

}  // namespace tacipc
