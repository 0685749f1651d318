#include "stages/press/solve/block_matrix.h"

#include <algorithm>

namespace tacipc {

FreeVertices::FreeVertices(int num_vertices, const std::vector<bool>& fixed) : free_of_vertex(num_vertices, -1) {
  for (int v = 0; v < num_vertices; ++v) {
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

BlockPattern make_block_pattern(int size, std::vector<std::array<int, 2>> pairs) {
  for (auto& pair : pairs) pair = {std::min(pair[0], pair[1]), std::max(pair[0], pair[1])};  // column, row
  for (int i = 0; i < size; ++i) pairs.push_back({i, i});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  BlockPattern pattern;
  pattern.column_start.assign(static_cast<std::size_t>(size) + 1, 0);
  for (const auto& [column, r] : pairs) {
    ++pattern.column_start[column + 1];
    pattern.row.push_back(r);
  }
  for (int c = 0; c < size; ++c) pattern.column_start[c + 1] += pattern.column_start[c];
  return pattern;
}

Eigen::VectorXd BlockMatrix::multiply(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (int c = 0; c < pattern->size(); ++c) {
    for (int k = pattern->column_start[c]; k < pattern->column_start[c + 1]; ++k) {
      const int r = pattern->row[k];
      const Eigen::Map<const Matrix3> block(values.data() + 9 * static_cast<std::size_t>(k));
      y.segment<3>(3 * r) += block * x.segment<3>(3 * c);
      if (r != c) y.segment<3>(3 * c) += block.transpose() * x.segment<3>(3 * r);
    }
  }
  return y;
}

}  // namespace tacipc
