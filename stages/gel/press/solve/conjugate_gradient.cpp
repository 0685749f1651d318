#include "stages/gel/press/solve/conjugate_gradient.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/simd.h"

namespace tacipc {
namespace {

// Vectors are padded: four numbers per row, the last of them zero, in the order of the sweeps. Blocks of L have nine
// numbers each, so a column loaded as four ends with a number of the next column.
constexpr std::ptrdiff_t kBlock = 9;
// Distance, in numbers, at which sweeps prefetch blocks: the processor's own prefetching stops at the end of a page.
constexpr std::ptrdiff_t kAhead = 512;
// L is rounded to floats, so iterations stop at this fraction of the right-hand side. For a finer tolerance, the
// residual is computed from the matrix and solved for again.
constexpr double kFloatTolerance = 1e-4;
// Rows count as indefinite if they contribute at least this fraction of the most negative contribution to a curvature.
constexpr double kIndefinitePart = 0.1;
constexpr int kMinRowsForParts = 4000;  // smallest number of rows for which sweeps run in parts

double total(const Quad& sum) { return (sum[0] + sum[1]) + (sum[2] + sum[3]); }

/// Computes C⁻¹ of A = C Cᵀ, lower triangle by columns. \return false if A is not positive definite
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

/// Pointers into a SweepOrder, for the loops.
struct Blocks {
  const int *column_start, *row, *separator_start, *source;
  explicit Blocks(const SweepOrder& order)
      : column_start(order.column_start.data()),
        row(order.row.data()),
        separator_start(order.separator_start.data()),
        source(order.source.data()) {}
};

/// Writes C_r⁻¹ B C_c⁻ᵀ of the blocks below the diagonal in columns first … last − 1 that are in a stale row or column.
TACIPC_CLONES void scale(const Blocks& L, int first, int last, const double* values, const double* inverse_cholesky,
                         const char* stale, float* lower) {
  constexpr auto kStride = static_cast<std::ptrdiff_t>(BlockMatrix::kStride);
  for (std::ptrdiff_t c = first; c < last; ++c) {
    const double* right = inverse_cholesky + kStride * c;  // columns of C_c⁻¹, zero above the diagonal
    for (std::ptrdiff_t k = L.column_start[c]; k < L.column_start[c + 1]; ++k) {
      if (!stale[c] && !stale[L.row[k]]) continue;
      const double* left = inverse_cholesky + kStride * L.row[k];
      const bool transposed = L.source[k] < 0;
      const double* block = values + kStride * (transposed ? -1 - L.source[k] : L.source[k]);
      const std::ptrdiff_t down = transposed ? 4 : 1, across = transposed ? 1 : 4;
      const Quad l0 = load_quad(left), l1 = load_quad(left + 4), l2 = load_quad(left + 8);
      Quad t[3];
      for (int j = 0; j < 3; ++j)
        t[j] = l0 * block[across * j] + l1 * block[across * j + down] + l2 * block[across * j + 2 * down];
      // The fourth number of a column is the first of the next, which is written after it. The last column's fourth
      // number is not written, because it may belong to another part.
      float* out = lower + kBlock * k;
      store_quad(out, t[0] * right[0]);
      store_quad(out + 3, t[0] * right[1] + t[1] * right[5]);
      const Quad third = t[0] * right[2] + t[1] * right[6] + t[2] * right[10];
      for (int r = 0; r < 3; ++r) out[6 + r] = static_cast<float>(third[r]);
    }
  }
}

/// Sets p = r + β p, t = (I + Lᵀ)⁻¹ p and q = p − t in rows first … last − 1, given t in all later rows.
TACIPC_CLONES void sweep_up(const Blocks& L, int first, int last, const float* lower, double beta, const double* r,
                            double* p, double* t, double* q) {
  for (std::ptrdiff_t c = last - 1; c >= first; --c) {
    Quad s0 = {}, s1 = {}, s2 = {};
    // Near rows come last: they have only just been computed.
    for (std::ptrdiff_t k = L.column_start[c + 1] - 1; k >= L.column_start[c]; --k) {
      const float* block = lower + kBlock * k;
      __builtin_prefetch(block - kAhead);
      const Quad tr = load_quad(t + 4 * static_cast<std::ptrdiff_t>(L.row[k]));
      s0 += load_quad(block) * tr;
      s1 += load_quad(block + 3) * tr;
      s2 += load_quad(block + 6) * tr;
    }
    const Quad from_later{(s0[0] + s0[1]) + s0[2], (s1[0] + s1[1]) + s1[2], (s2[0] + s2[1]) + s2[2], 0.0};
    const Quad pc = load_quad(r + 4 * c) + beta * load_quad(p + 4 * c);
    store_quad(p + 4 * c, pc);
    store_quad(t + 4 * c, pc - from_later);
    store_quad(q + 4 * c, from_later);
  }
}

/// Sets y = (I + L)⁻¹ y in rows first … last − 1, plus t if it is given. Contributions to the separator's rows are
/// added to `separator`, which begins with row `separator_row`.
/// \return pᵀy if p is given
TACIPC_CLONES double sweep_down(const Blocks& L, int first, int last, const float* lower, const double* t,
                                const double* p, double* y, double* separator, int separator_row) {
  Quad sum = {};
  for (std::ptrdiff_t c = first; c < last; ++c) {
    const Quad yc = three_of(load_quad(y + 4 * c));
    const Quad whole = t ? load_quad(t + 4 * c) + yc : yc;
    store_quad(y + 4 * c, whole);
    if (p) sum += load_quad(p + 4 * c) * whole;
    const double y0 = yc[0], y1 = yc[1], y2 = yc[2];
    const auto subtract = [&](std::ptrdiff_t k, double* from, int base) __attribute__((always_inline)) {
      const float* block = lower + kBlock * k;
      __builtin_prefetch(block + kAhead);
      double* yr = from + 4 * static_cast<std::ptrdiff_t>(L.row[k] - base);
      store_quad(yr, load_quad(yr) - (load_quad(block) * y0 + load_quad(block + 3) * y1 + load_quad(block + 6) * y2));
    };
    const std::ptrdiff_t end = L.column_start[c + 1], own_end = L.separator_start[c];
    for (std::ptrdiff_t k = L.column_start[c]; k < own_end; ++k) subtract(k, y, 0);
    for (std::ptrdiff_t k = own_end; k < end; ++k) subtract(k, separator, separator_row);
  }
  return total(sum);
}

TACIPC_CLONES double dot_product(const double* a, const double* b, int first, int last) {
  Quad sum = {};
  for (std::ptrdiff_t i = first; i < last; ++i) sum += load_quad(a + 4 * i) * load_quad(b + 4 * i);
  return total(sum);
}

/// Sets x += α t, r −= α q in rows first … last − 1. \return rᵀr
TACIPC_CLONES double advance(double alpha, const double* t, const double* q, double* x, double* r, int first,
                             int last) {
  Quad sum = {};
  for (std::ptrdiff_t i = first; i < last; ++i) {
    store_quad(x + 4 * i, load_quad(x + 4 * i) + alpha * load_quad(t + 4 * i));
    const Quad ri = load_quad(r + 4 * i) - alpha * load_quad(q + 4 * i);
    store_quad(r + 4 * i, ri);
    sum += ri * ri;
  }
  return total(sum);
}

/// Sets x = C⁻¹ x, or C⁻ᵀ x.
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

/// Sums a function over the parts, whose number does not depend on threads.
template <typename Part>
double ConjugateGradient::over_parts(Part&& part) {
  std::array<double, kParts> found{};
  const int n = order_.num_parts();
  if (n == 1) {
    found[0] = part(0, order_.part_start[0], order_.part_start[1]);
  } else {
    tbb::parallel_for(
        0, n, [&](int i) { found[i] = part(i, order_.part_start[i], order_.part_start[i + 1]); },
        tbb::simple_partitioner());
  }
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += found[i];
  return sum;
}

/// Sets y = (I + L)⁻¹ y, plus t if it is given. \return pᵀy if p is given
double ConjugateGradient::forward(const double* t, const double* p, double* y) {
  const Blocks L(order_);
  const int separator = order_.separator(), n = order_.num_rows();
  const std::size_t size = 4 * static_cast<std::size_t>(n - separator);
  std::array<AlignedVector<double>, kParts>& apart = to_separator_;
  double sum = over_parts([&](int i, int first, int last) {
    apart[i].assign(size, 0.0);
    return sweep_down(L, first, last, lower_.data(), t, p, y, apart[i].data(), separator);
  });
  for (int i = 0; i < order_.num_parts(); ++i) {
    for (std::size_t k = 0; k < size; ++k) y[4 * static_cast<std::size_t>(separator) + k] += apart[i][k];
  }
  return sum + sweep_down(L, separator, n, lower_.data(), t, p, y, y, 0);
}

bool ConjugateGradient::prepare(const BlockMatrix& matrix, const std::vector<char>* changed) {
  matrix_ = &matrix;
  const BlockPattern& pattern = *matrix.pattern;
  const int n = pattern.size(), first_body_row = pattern.first_body_row();
  if (pattern_ != matrix.pattern) {
    pattern_ = matrix.pattern;
    order_ = make_sweep_order(pattern, n > kMinRowsForParts ? kParts : 1);
    changed = nullptr;
  }
  // Rows of bodies are coupled to many others.
  if (!changed || first_body_row < n) {
    stale_.assign(static_cast<std::size_t>(n), 1);
  } else {
    for (int r = 0; r < n; ++r) stale_[order_.row_of[r]] |= (*changed)[r];
  }
  inverse_cholesky_.resize(BlockMatrix::kStride * static_cast<std::size_t>(n), 0.0);  // stays zero above diagonals
  // scale() then leaves zeros in the bodies' rows.
  std::fill(inverse_cholesky_.end() - static_cast<std::ptrdiff_t>(BlockMatrix::kStride) * (n - first_body_row),
            inverse_cholesky_.end(), 0.0);
  indefinite_rows_.clear();
  for (int c = 0; c < first_body_row; ++c) {
    if (!stale_[order_.row_of[c]]) continue;
    if (!invert_cholesky(matrix.block(pattern.column_start[c]),
                         BlockMatrix::Block(inverse_cholesky_.data() +
                                            BlockMatrix::kStride * static_cast<std::size_t>(order_.row_of[c]))))
      indefinite_rows_.push_back(c);
  }
  const std::vector<int> of_bodies = bodies_.factorise(matrix);
  indefinite_rows_.insert(indefinite_rows_.end(), of_bodies.begin(), of_bodies.end());
  if (!indefinite_rows_.empty()) return false;
  // One extra number: the last column is also loaded as four.
  lower_.resize(static_cast<std::size_t>(kBlock) * order_.row.size() + 1);
  lower_.back() = 0.0F;
  const auto scale_columns = [&](int /*part*/, int first, int last) {
    scale(Blocks(order_), first, last, matrix.values.data(), inverse_cholesky_.data(), stale_.data(), lower_.data());
    if (bodies_.size() > 0) bodies_.scale(matrix, order_, first, last, inverse_cholesky_, lower_);
    return 0.0;
  };
  over_parts(scale_columns);
  scale_columns(0, order_.separator(), n);
  std::fill(stale_.begin(), stale_.end(), 0);
  return true;
}

/// The scaled matrix maps t to (I + L) q; the terms of tᵀ(I + L) q are the contributions of the rows to pᵀÂp.
void ConjugateGradient::find_indefinite_rows() {
  indefinite_rows_.clear();
  const int n = order_.num_rows();
  AlignedVector<double> product = q_;
  for (int c = 0; c < n; ++c) {
    for (int k = order_.column_start[c]; k < order_.column_start[c + 1]; ++k) {
      const Matrix3 block = Eigen::Map<const Eigen::Matrix3f>(lower_.data() + kBlock * k).cast<double>();
      Eigen::Map<Vector3>(product.data() + 4 * static_cast<std::ptrdiff_t>(order_.row[k])) +=
          block * Eigen::Map<const Vector3>(q_.data() + 4 * static_cast<std::ptrdiff_t>(c));
    }
  }
  std::vector<double> part(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const std::ptrdiff_t at = 4 * static_cast<std::ptrdiff_t>(i);
    part[i] = Eigen::Map<const Vector3>(t_.data() + at).dot(Eigen::Map<const Vector3>(product.data() + at));
  }
  // Scaling mixes the rows of a body.
  for (int first = matrix_->pattern->first_body_row(); first < n; first += BodyBlocks::kRows) {
    const auto own = part.begin() + first;
    std::fill_n(own, BodyBlocks::kRows, std::accumulate(own, own + BodyBlocks::kRows, 0.0));
  }
  const double least = std::min(0.0, *std::min_element(part.begin(), part.end()));
  for (int r = 0; r < n; ++r) {
    if (const double of_row = part[order_.row_of[r]]; of_row < 0.0 && of_row <= kIndefinitePart * least)
      indefinite_rows_.push_back(r);
  }
}

std::optional<Eigen::VectorXd> ConjugateGradient::factorize(const Eigen::VectorXd& b) {
  ++factorized_;
  if (!direct_) direct_.emplace();
  if (!direct_->prepare(*matrix_)) return std::nullopt;
  return direct_->solve(b);
}

std::optional<Eigen::VectorXd> ConjugateGradient::solve(const Eigen::VectorXd& b) {
  auto x = iterate(b, std::max(tolerance_, kFloatTolerance));
  const int factorized_before = factorized_;
  // Refinement of the error by rounding L to floats.
  for (double left = kFloatTolerance; x && left > tolerance_ && factorized_ == factorized_before;
       left *= kFloatTolerance) {
    const auto rest = iterate(b - matrix_->multiply(*x), std::max(tolerance_ / left, kFloatTolerance));
    if (!rest) return std::nullopt;
    *x += *rest;
  }
  return x;
}

std::optional<Eigen::VectorXd> ConjugateGradient::iterate(const Eigen::VectorXd& b, double tolerance) {
  const int n = order_.num_rows(), separator = order_.separator();
  const Blocks L(order_);
  // The fourth numbers of all rows are set to zero once and stay zero.
  for (AlignedVector<double>* v : {&r_, &t_, &q_}) v->resize(4 * static_cast<std::size_t>(n), 0.0);
  for (AlignedVector<double>* v : {&x_, &p_}) v->assign(4 * static_cast<std::size_t>(n), 0.0);
  for (int i = 0; i < n; ++i) Eigen::Map<Vector3>(r_.data() + 4 * order_.row_of[i]) = b.segment<3>(3 * i);
  const int first_body_row = matrix_->pattern->first_body_row();
  unscale(inverse_cholesky_.data(), false, r_.data(), first_body_row);
  bodies_.unscale(false, r_);
  forward(nullptr, nullptr, r_.data());
  const auto separator_too = [&](auto&& rows) {
    const double of_parts = over_parts([&](int /*part*/, int first, int last) { return rows(first, last); });
    return of_parts + rows(separator, n);
  };
  double rr = separator_too([&](int first, int last) { return dot_product(r_.data(), r_.data(), first, last); });
  const double target = tolerance * tolerance * rr;
  double beta = 0.0;
  for (int i = 0; rr > target; ++i) {
    if (i == max_products_) return factorize(b);
    const auto up = [&](int /*part*/, int first, int last) {
      sweep_up(L, first, last, lower_.data(), beta, r_.data(), p_.data(), t_.data(), q_.data());
      return 0.0;
    };
    up(0, separator, n);
    over_parts(up);
    const double curvature = forward(t_.data(), p_.data(), q_.data());
    ++products_;
    if (!(curvature > 0.0)) {
      find_indefinite_rows();
      return std::nullopt;
    }
    const double last_rr = rr, alpha = rr / curvature;
    rr = separator_too(
        [&](int first, int last) { return advance(alpha, t_.data(), q_.data(), x_.data(), r_.data(), first, last); });
    beta = rr / last_rr;
  }
  unscale(inverse_cholesky_.data(), true, x_.data(), first_body_row);
  bodies_.unscale(true, x_);
  Eigen::VectorXd out(3 * static_cast<Eigen::Index>(n));
  for (int i = 0; i < n; ++i) out.segment<3>(3 * i) = Eigen::Map<const Vector3>(x_.data() + 4 * order_.row_of[i]);
  return out;
}

}  // namespace tacipc
