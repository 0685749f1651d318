#include "stages/press/solve/block_matrix.h"

#include <algorithm>
#include <numeric>

#include "common/simd.h"

namespace tacipc {
namespace {

/// Column by column: what a column's blocks do to the rows below goes there at once, what they do to the column itself
/// is summed up over all of them first.
TACIPC_CLONES void multiply_columns(const int* column_start, const int* row, int size, const double* values,
                                    const double* x, double* y) {
  for (int c = 0; c < size; ++c) {
    const Quad xc = load_quad(x + 4 * static_cast<std::ptrdiff_t>(c));
    const double x0 = xc[0], x1 = xc[1], x2 = xc[2];
    int k = column_start[c];
    const double* diagonal = values + BlockMatrix::kStride * static_cast<std::size_t>(k);
    Quad own = load_quad(diagonal) * x0 + load_quad(diagonal + 4) * x1 + load_quad(diagonal + 8) * x2;
    Quad sum0 = {}, sum1 = {}, sum2 = {};
    for (++k; k < column_start[c + 1]; ++k) {
      const double* block = values + BlockMatrix::kStride * static_cast<std::size_t>(k);
      const Quad b0 = load_quad(block), b1 = load_quad(block + 4), b2 = load_quad(block + 8);
      const std::ptrdiff_t r = 4 * static_cast<std::ptrdiff_t>(row[k]);
      const Quad xr = load_quad(x + r);
      store_quad(y + r, load_quad(y + r) + (b0 * x0 + b1 * x1 + b2 * x2));
      sum0 += b0 * xr;
      sum1 += b1 * xr;
      sum2 += b2 * xr;
    }
    own += Quad{(sum0[0] + sum0[1]) + sum0[2], (sum1[0] + sum1[1]) + sum1[2], (sum2[0] + sum2[1]) + sum2[2], 0.0};
    double* yc = y + 4 * static_cast<std::ptrdiff_t>(c);
    store_quad(yc, load_quad(yc) + own);
  }
}

}  // namespace

FreeVertices::FreeVertices(int num_vertices, const std::vector<bool>& fixed)
    : FreeVertices(
          [&] {
            std::vector<int> all(static_cast<std::size_t>(num_vertices));
            std::iota(all.begin(), all.end(), 0);
            return all;
          }(),
          fixed) {}

FreeVertices::FreeVertices(const std::vector<int>& order, const std::vector<bool>& fixed)
    : free_of_vertex(fixed.size(), -1) {
  for (const int v : order) {
    if (fixed[v]) continue;
    free_of_vertex[v] = static_cast<int>(vertex_of_free.size());
    vertex_of_free.push_back(v);
  }
}

int BlockPattern::find(int r, int column) const {
  const auto first = row.begin() + column_start[column], last = row.begin() + column_start[column + 1];
  const auto found = std::lower_bound(first, last, r);
  return found != last && *found == r ? static_cast<int>(found - row.begin()) : -1;
}

BlockPattern make_block_pattern(int size, const std::vector<std::array<int, 2>>& pairs) {
  // Sorted by column first, which takes no comparisons, then within each column.
  std::vector<int> start(static_cast<std::size_t>(size) + 1, 0);
  for (const auto& [a, b] : pairs) ++start[std::min(a, b) + 1];
  for (int c = 0; c < size; ++c) start[c + 1] += start[c];
  std::vector<int> rows(pairs.size()), next(start.begin(), start.end() - 1);
  for (const auto& [a, b] : pairs) rows[next[std::min(a, b)]++] = std::max(a, b);
  BlockPattern pattern;
  pattern.column_start.push_back(0);
  for (int c = 0; c < size; ++c) {
    const auto first = rows.begin() + start[c], last = rows.begin() + start[c + 1];
    std::sort(first, last);
    pattern.row.push_back(c);
    for (auto it = first, end = std::unique(first, last); it != end; ++it) {
      if (*it != c) pattern.row.push_back(*it);
    }
    pattern.column_start.push_back(pattern.num_blocks());
  }
  return pattern;
}

void BlockMatrix::multiply_padded(const double* x, double* y) const {
  std::fill(y, y + 4 * static_cast<std::ptrdiff_t>(pattern->size()), 0.0);
  multiply_columns(pattern->column_start.data(), pattern->row.data(), pattern->size(), values.data(), x, y);
}

Eigen::VectorXd BlockMatrix::multiply(const Eigen::VectorXd& x) const {
  std::vector<double> in;
  pad(x, in);
  std::vector<double> out(in.size());
  multiply_padded(in.data(), out.data());
  return unpadded(out);
}

void pad(const Eigen::VectorXd& x, std::vector<double>& out) {
  out.assign(static_cast<std::size_t>(x.size() / 3 * 4), 0.0);
  for (Eigen::Index i = 0; i < x.size() / 3; ++i) Eigen::Map<Vector3>(out.data() + 4 * i) = x.segment<3>(3 * i);
}

Eigen::VectorXd unpadded(const std::vector<double>& x) {
  const auto n = static_cast<Eigen::Index>(x.size() / 4);
  Eigen::VectorXd out(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) out.segment<3>(3 * i) = Eigen::Map<const Vector3>(x.data() + 4 * i);
  return out;
}

}  // namespace tacipc
