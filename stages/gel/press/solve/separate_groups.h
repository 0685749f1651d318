// Groups of work items that share no unknown of a system.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace tacipc {

/// Groups of the items 0 … count − 1, each of which adds to some unknowns. Items whose unknowns all lie in one part of
/// the numbering form one group per part; items that reach several parts form the last group. No two groups before the
/// last share an unknown, so they can run in parallel and the order of additions still does not depend on threads.
class SeparateGroups {
 public:
  /// \param unknowns_of unknowns_of(i, touches) calls touches(u) for each unknown u of item i; negative u are ignored.
  /// An item without unknowns is in no group.
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

  /// Calls add(group) for each group.
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
