#include "stages/gel/press/solve/sweep_order.h"

#include <algorithm>
#include <utility>

namespace tacipc {

SweepOrder make_sweep_order(const BlockPattern& pattern, int num_parts) {
  const int n = pattern.size(), first_body_row = pattern.first_body_row();
  const auto part_of = [&](int r) { return static_cast<int>(static_cast<long long>(r) * num_parts / first_body_row); };
  std::vector<bool> separates(static_cast<std::size_t>(n), false);
  // Bodies first: otherwise everything that touches a body would be in the separator instead.
  std::fill(separates.begin() + first_body_row, separates.end(), true);
  for (int c = 0; c < first_body_row; ++c) {
    for (int k = pattern.column_start[c]; k < pattern.column_start[c + 1] && !separates[c]; ++k)
      separates[c] = part_of(pattern.row[k]) != part_of(c) && !separates[pattern.row[k]];
  }

  SweepOrder order;
  order.row_of.resize(static_cast<std::size_t>(n));
  int next = 0;
  for (int part = 0, r = 0; part < num_parts; ++part) {
    order.part_start.push_back(next);
    for (; r < first_body_row && part_of(r) == part; ++r) {
      if (!separates[r]) order.row_of[r] = next++;
    }
  }
  order.part_start.push_back(next);
  for (int r = 0; r < n; ++r) {
    if (separates[r]) order.row_of[r] = next++;
  }
  order.part_start.push_back(n);

  const auto for_each_block = [&](auto&& take) {
    for (int c = 0; c < n; ++c) {
      for (int k = pattern.column_start[c] + 1; k < pattern.column_start[c + 1]; ++k) {
        const int i = order.row_of[pattern.row[k]], j = order.row_of[c];
        take(std::max(i, j), std::min(i, j), i > j ? k : -1 - k);
      }
    }
  };
  order.column_start.assign(static_cast<std::size_t>(n) + 1, 0);
  for_each_block([&](int /*row*/, int column, int /*source*/) { ++order.column_start[column + 1]; });
  for (int c = 0; c < n; ++c) order.column_start[c + 1] += order.column_start[c];
  struct Entry {
    int row, source;
  };
  std::vector<Entry> entries(static_cast<std::size_t>(order.column_start[n]));
  std::vector<int> next_of(order.column_start.begin(), order.column_start.end() - 1);
  for_each_block([&](int row, int column, int source) { entries[next_of[column]++] = {row, source}; });
  order.row.reserve(entries.size());
  order.source.reserve(entries.size());
  for (int c = 0; c < n; ++c) {
    const auto first = entries.begin() + order.column_start[c], last = entries.begin() + order.column_start[c + 1];
    std::sort(first, last, [](const Entry& a, const Entry& b) { return a.row < b.row; });
    const auto in_separator = std::find_if(first, last, [&](const Entry& e) { return e.row >= order.separator(); });
    order.separator_start.push_back(static_cast<int>(in_separator - entries.begin()));
    for (auto e = first; e != last; ++e) {
      order.row.push_back(e->row);
      order.source.push_back(e->source);
    }
  }
  return order;
}

}  // namespace tacipc
