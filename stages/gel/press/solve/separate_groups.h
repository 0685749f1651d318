// Groups of work that share no unknown of a system.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace tacipc {

/// Numbers 0 … count − 1 of things that add to some unknowns each, in groups: those whose unknowns all lie in one part
/// of the numbering, part by part, and last those of several parts. No two groups before the last touch the same
/// unknown, so that they may go in parallel and the order of additions still does not depend on threads.
class SeparateGroups {
 public:
  /// `unknowns_of(i, touches)` calls touches(u) for each unknown of i; negative ones do not count. What has none is
  /// in no group.
  template <typename UnknownsOf>
  SeparateGroups(int count, int num_unknowns, UnknownsOf&& unknowns_of) {
    const int num_parts = count > kMinCountForParts ? kParts : 1;
    groups_.resize(static_cast<std::size_t>(num_parts) + 1);
    for (int i = 0; i < count; ++i) {
      int first = num_parts, last = -1;
      unknowns_of(i, [&](int u) {
        if (u < 0) return;
        const auto part = static_cast<int>(static_cast<long long>(u) * num_parts / num_unknowns);
        first = std::min(first, part);
        last = std::max(last, part);
      });
      if (last >= 0) groups_[static_cast<std::size_t>(first == last ? first : num_parts)].push_back(i);
    }
  }

  /// Calls add(group) for each.
  template <typename Add>
  void for_each(Add&& add) const {
    tbb::parallel_for(
        std::size_t{0}, groups_.size() - 1, [&](std::size_t part) { add(groups_[part]); }, tbb::simple_partitioner());
    add(groups_.back());
  }

 private:
  static constexpr int kParts = 4, kMinCountForParts = 200;
  std::vector<std::vector<int>> groups_;
};

}  // namespace tacipc
