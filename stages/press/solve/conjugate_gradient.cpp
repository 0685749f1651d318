#include "stages/press/solve/conjugate_gradient.h"

#include <algorithm>
#include <cmath>

#include "common/simd.h"

namespace tacipc {
namespace {

// Vectors are padded: four numbers per vertex, the last of them zero. Blocks of L lie nine numbers apart, so a column
// loaded as four has a foreign number at its end.
constexpr std::ptrdiff_t kBlock = 9;
constexpr double kMuch = 0.1;  // of the most negative part of a curvature

double total(const Quad& sum) { return (sum[0] + sum[1]) + (sum[2] + sum[3]); }

/// C⁻¹ of A = C Cᵀ, lower triangle by columns; false if A is not positive definite.
bool invert_cholesky(const BlockMatrix::ConstBlock& A, BlockMatrix::Block out) {
  if (!(A(0, 0) > 0.0)) return false;
  const double i0 = 1.0 / std::sqrt(A(0, 0)), c10 = A(1, 0) * i0, c20 = A(2, 0) * i0;
  const double pivot1 = A(1, 1) - c10 * c10;
  if (!(pivot1 > 0.0)) return false;
  const double i1 = 1.0 / std::sqrt(pivot1), c21 = (A(2, 1) - c20 * c10) * i1;
  const double pivot2 = A(2, 2) - c20 * c20 - c21 * c21;
  if (!(pivot2 > 0.0)) return false;
  const double i2 = 1.0 / std::sqrt(pivot2);
  out(0, 0) = i0;
  out(1, 1) = i1;
  out(2, 2) = i2;
  out(1, 0) = -c10 * i0 * i1;
  out(2, 1) = -c21 * i1 * i2;
  out(2, 0) = -(c20 * i0 + c21 * out(1, 0)) * i2;
  return true;
}

TACIPC_INLINE Quad three_of(const Quad& v) { return Quad{v[0], v[1], v[2], 0.0}; }

/// Column by column: C_r⁻¹ B C_c⁻ᵀ of the blocks below the diagonal.
TACIPC_CLONES void scale(const int* column_start, const int* row, int size, const double* values,
                         const double* inverse_cholesky, double* lower) {
  constexpr auto kStride = static_cast<std::ptrdiff_t>(BlockMatrix::kStride);
  for (std::ptrdiff_t c = 0; c < size; ++c) {
    const double* right = inverse_cholesky + kStride * c;  // columns of C_c⁻¹, zero above the diagonal
    for (std::ptrdiff_t k = column_start[c] + 1; k < column_start[c + 1]; ++k) {
      const double *left = inverse_cholesky + kStride * row[k], *block = values + kStride * k;
      const Quad l0 = load_quad(left), l1 = load_quad(left + 4), l2 = load_quad(left + 8);
      Quad t[3];
      for (int j = 0; j < 3; ++j) t[j] = l0 * block[4 * j] + l1 * block[4 * j + 1] + l2 * block[4 * j + 2];
      double* out = lower + kBlock * (k - c - 1);
      // The fourth number of a column is the first of the next, which comes after it.
      store_quad(out, t[0] * right[0]);
      store_quad(out + 3, t[0] * right[1] + t[1] * right[5]);
      store_quad(out + 6, t[0] * right[2] + t[1] * right[6] + t[2] * right[10]);
    }
  }
}

/// t = (I + Lᵀ)⁻¹ p.
TACIPC_CLONES void sweep_up(const int* column_start, const int* row, int size, const double* lower, const double* p,
                            double* t) {
  for (std::ptrdiff_t c = size - 1; c >= 0; --c) {
    Quad s0 = {}, s1 = {}, s2 = {};
    // Near rows last: they have only just been found.
    for (std::ptrdiff_t k = column_start[c + 1] - 1; k > column_start[c]; --k) {
      const double* block = lower + kBlock * (k - c - 1);
      const Quad tr = load_quad(t + 4 * static_cast<std::ptrdiff_t>(row[k]));
      s0 += load_quad(block) * tr;
      s1 += load_quad(block + 3) * tr;
      s2 += load_quad(block + 6) * tr;
    }
    store_quad(t + 4 * c, load_quad(p + 4 * c) -
                              Quad{(s0[0] + s0[1]) + s0[2], (s1[0] + s1[1]) + s1[2], (s2[0] + s2[1]) + s2[2], 0.0});
  }
}

/// y = (I + L)⁻¹ y.
TACIPC_CLONES void sweep_down(const int* column_start, const int* row, int size, const double* lower, double* y) {
  for (std::ptrdiff_t c = 0; c < size; ++c) {
    const Quad yc = three_of(load_quad(y + 4 * c));
    store_quad(y + 4 * c, yc);
    const double y0 = yc[0], y1 = yc[1], y2 = yc[2];
    for (std::ptrdiff_t k = column_start[c] + 1; k < column_start[c + 1]; ++k) {
      const double* block = lower + kBlock * (k - c - 1);
      double* yr = y + 4 * static_cast<std::ptrdiff_t>(row[k]);
      store_quad(yr, load_quad(yr) - (load_quad(block) * y0 + load_quad(block + 3) * y1 + load_quad(block + 6) * y2));
    }
  }
}

TACIPC_CLONES double dot_product(const double* a, const double* b, int n) {
  Quad sum = {};
  for (std::ptrdiff_t i = 0; i < n; ++i) sum += load_quad(a + 4 * i) * load_quad(b + 4 * i);
  return total(sum);
}

/// out = a − b.
TACIPC_CLONES void subtract(const double* a, const double* b, double* out, int n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) store_quad(out + 4 * i, load_quad(a + 4 * i) - load_quad(b + 4 * i));
}

/// q += t; returns pᵀq.
TACIPC_CLONES double add_and_dot(const double* t, const double* p, double* q, int n) {
  Quad sum = {};
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const Quad qi = load_quad(q + 4 * i) + load_quad(t + 4 * i);
    store_quad(q + 4 * i, qi);
    sum += load_quad(p + 4 * i) * qi;
  }
  return total(sum);
}

/// x += α t, r −= α q; returns rᵀr.
TACIPC_CLONES double advance(double alpha, const double* t, const double* q, double* x, double* r, int n) {
  Quad sum = {};
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    store_quad(x + 4 * i, load_quad(x + 4 * i) + alpha * load_quad(t + 4 * i));
    const Quad ri = load_quad(r + 4 * i) - alpha * load_quad(q + 4 * i);
    store_quad(r + 4 * i, ri);
    sum += ri * ri;
  }
  return total(sum);
}

/// p = r + β p.
TACIPC_CLONES void turn(double beta, const double* r, double* p, int n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) store_quad(p + 4 * i, load_quad(r + 4 * i) + beta * load_quad(p + 4 * i));
}

/// x = C⁻¹ x, or C⁻ᵀ x.
TACIPC_CLONES void unscale(const double* inverse_cholesky, bool transposed, double* x, int n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double* block = inverse_cholesky + static_cast<std::ptrdiff_t>(BlockMatrix::kStride) * i;
    const Quad c0 = load_quad(block), c1 = load_quad(block + 4), c2 = load_quad(block + 8), xi = load_quad(x + 4 * i);
    if (transposed) {
      const Quad d0 = c0 * xi, d1 = c1 * xi, d2 = c2 * xi;
      store_quad(x + 4 * i, Quad{(d0[0] + d0[1]) + d0[2], d1[1] + d1[2], d2[2], 0.0});
    } else {
      store_quad(x + 4 * i, c0 * xi[0] + c1 * xi[1] + c2 * xi[2]);
    }
  }
}

}  // namespace

std::unique_ptr<LinearSolver> make_linear_solver(LinearSolverKind kind) {
  if (kind == LinearSolverKind::direct) return std::make_unique<CholmodSolver>();
  return std::make_unique<ConjugateGradient>();
}

bool ConjugateGradient::prepare(const BlockMatrix& matrix) {
  matrix_ = &matrix;
  const BlockPattern& pattern = *matrix.pattern;
  const int n = pattern.size();
  inverse_cholesky_.assign(BlockMatrix::kStride * static_cast<std::size_t>(n), 0.0);
  indefinite_rows_.clear();
  for (int c = 0; c < n; ++c) {
    if (!invert_cholesky(
            matrix.block(pattern.column_start[c]),
            BlockMatrix::Block(inverse_cholesky_.data() + BlockMatrix::kStride * static_cast<std::size_t>(c))))
      indefinite_rows_.push_back(c);
  }
  if (!indefinite_rows_.empty()) return false;
  // One number more: the last column is loaded as four, too.
  lower_.resize(static_cast<std::size_t>(kBlock) * static_cast<std::size_t>(pattern.num_blocks() - n) + 1);
  lower_.back() = 0.0;
  scale(pattern.column_start.data(), pattern.row.data(), n, matrix.values.data(), inverse_cholesky_.data(),
        lower_.data());
  return true;
}

/// The scaled matrix takes t to (I + L) q: row by row, tᵀ(I + L) q is what each row gives to pᵀÂp.
void ConjugateGradient::find_indefinite_rows() {
  indefinite_rows_.clear();
  const BlockPattern& pattern = *matrix_->pattern;
  std::vector<double> product = q_;
  for (int c = 0; c < pattern.size(); ++c) {
    for (int k = pattern.column_start[c] + 1; k < pattern.column_start[c + 1]; ++k) {
      const Eigen::Map<const Matrix3> block(lower_.data() + kBlock * (k - c - 1));
      Eigen::Map<Vector3>(product.data() + 4 * static_cast<std::ptrdiff_t>(pattern.row[k])) +=
          block * Eigen::Map<const Vector3>(q_.data() + 4 * static_cast<std::ptrdiff_t>(c));
    }
  }
  std::vector<double> part(static_cast<std::size_t>(pattern.size()));
  for (std::size_t i = 0; i < part.size(); ++i)
    part[i] = Eigen::Map<const Vector3>(t_.data() + 4 * i).dot(Eigen::Map<const Vector3>(product.data() + 4 * i));
  const double least = *std::min_element(part.begin(), part.end());
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (part[i] < 0.0 && part[i] <= kMuch * least) indefinite_rows_.push_back(static_cast<int>(i));
  }
}

std::optional<Eigen::VectorXd> ConjugateGradient::factorize(const Eigen::VectorXd& b) {
  ++factorized_;
  if (!direct_) direct_.emplace();
  if (!direct_->prepare(*matrix_)) return std::nullopt;
  return direct_->solve(b);
}

std::optional<Eigen::VectorXd> ConjugateGradient::solve(const Eigen::VectorXd& b) {
  const BlockPattern& pattern = *matrix_->pattern;
  const int n = pattern.size();
  const int *start = pattern.column_start.data(), *row = pattern.row.data();
  pad(b, r_);
  for (std::vector<double>* v : {&t_, &q_}) v->resize(r_.size());
  x_.assign(r_.size(), 0.0);
  unscale(inverse_cholesky_.data(), false, r_.data(), n);
  sweep_down(start, row, n, lower_.data(), r_.data());
  p_ = r_;
  double rr = dot_product(r_.data(), r_.data(), n);
  const double enough = tolerance_ * tolerance_ * rr;
  for (int i = 0; rr > enough; ++i) {
    if (i == max_products_) return factorize(b);
    sweep_up(start, row, n, lower_.data(), p_.data(), t_.data());
    subtract(p_.data(), t_.data(), q_.data(), n);
    sweep_down(start, row, n, lower_.data(), q_.data());
    ++products_;
    const double curvature = add_and_dot(t_.data(), p_.data(), q_.data(), n);
    if (!(curvature > 0.0)) {
      find_indefinite_rows();
      return std::nullopt;
    }
    const double last = rr;
    rr = advance(rr / curvature, t_.data(), q_.data(), x_.data(), r_.data(), n);
    turn(rr / last, r_.data(), p_.data(), n);
  }
  unscale(inverse_cholesky_.data(), true, x_.data(), n);
  return unpadded(x_);
}

}  // namespace tacipc
