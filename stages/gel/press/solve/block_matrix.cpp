#include "stages/gel/press/solve/block_matrix.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace tacipc {

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

BlockPattern make_block_pattern(int size, const std::vector<std::array<int, 2>>& pairs, int num_bodies) {
  constexpr int kBodyRows = BlockPattern::kBodyRows;
  const int first_body_row = size - kBodyRows * num_bodies;
  // A body's first row represents all of its rows until the end.
  const auto head = [&](int r) { return r < first_body_row ? r : r - (r - first_body_row) % kBodyRows; };
  const auto end_of = [&](int h) { return h < first_body_row ? h + 1 : h + kBodyRows; };
  // Sorted by column first, which needs no comparisons, then within each column.
  std::vector<int> start(static_cast<std::size_t>(size) + 1, 0);
  for (const auto& [a, b] : pairs) ++start[head(std::min(a, b)) + 1];
  for (int c = 0; c < size; ++c) start[c + 1] += start[c];
  std::vector<int> rows(pairs.size()), next(start.begin(), start.end() - 1);
  for (const auto& [a, b] : pairs) rows[next[head(std::min(a, b))]++] = head(std::max(a, b));
  BlockPattern pattern;
  pattern.num_bodies = num_bodies;
  pattern.column_start.push_back(0);
  for (int h = 0; h < size; h = end_of(h)) {
    const auto first = rows.begin() + start[h], last = rows.begin() + start[h + 1];
    std::sort(first, last);
    const auto end = std::unique(first, last);
    for (int c = h; c < end_of(h); ++c) {
      for (int r = c; r < end_of(h); ++r) pattern.row.push_back(r);
      for (auto it = first; it != end; ++it) {
        for (int r = *it; *it != h && r < end_of(*it); ++r) pattern.row.push_back(r);
      }
      pattern.column_start.push_back(pattern.num_blocks());
    }
  }
  return pattern;
}

void BlockMatrix::clear(std::shared_ptr<const BlockPattern> p) {
  pattern = std::move(p);
  values.resize(kStride * static_cast<std::size_t>(pattern->num_blocks()));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, values.size(), 1 << 16), [&](const auto& range) {
    std::fill(&values[range.begin()], &values[range.begin()] + range.size(), 0.0);
  });
}

Eigen::VectorXd BlockMatrix::multiply(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (int c = 0; c < pattern->size(); ++c) {
    for (int k = pattern->column_start[c]; k < pattern->column_start[c + 1]; ++k) {
      const int r = pattern->row[k];
      y.segment<3>(3 * r) += block(k) * x.segment<3>(3 * c);
      if (r != c) y.segment<3>(3 * c) += block(k).transpose() * x.segment<3>(3 * r);
    }
  }
  return y;
}

}  // namespace tacipc
