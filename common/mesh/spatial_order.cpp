#include "common/mesh/spatial_order.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace tacipc {
namespace {

/// Returns the lowest 21 bits with two zeros after each.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x1f00000000ffffULL;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffULL;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
  return (bits | bits << 2) & 0x1249249249249249ULL;
}

}  // namespace

std::vector<int> spatial_order(const Positions& points) {
  std::vector<int> order(points.rows());
  std::iota(order.begin(), order.end(), 0);
  if (order.empty()) return order;
  const Eigen::RowVector3d low = points.colwise().minCoeff();
  const double extent = (points.colwise().maxCoeff() - low).maxCoeff();
  constexpr double kCells = (1 << 21) - 1;
  std::vector<std::uint64_t> code(order.size());
  for (std::size_t i = 0; i < code.size(); ++i) {
    const Eigen::RowVector3d at = (points.row(i) - low) * (extent > 0 ? kCells / extent : 0);
    code[i] = spread(static_cast<std::uint64_t>(at.x())) | spread(static_cast<std::uint64_t>(at.y())) << 1 |
              spread(static_cast<std::uint64_t>(at.z())) << 2;
  }
  std::ranges::stable_sort(order, [&](int a, int b) { return code[a] < code[b]; });
  return order;
}

std::vector<int> spatial_rank(const Positions& points) {
  std::vector<int> rank(points.rows());
  int next = 0;
  for (const int i : spatial_order(points)) rank[i] = next++;
  return rank;
}

}  // namespace tacipc
