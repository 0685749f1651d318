// Helpers shared by the broad phases.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "common/base/types.h"
#include "stages/gel/press/contact/bvh.h"
#include "stages/gel/press/contact/pair_pack.h"
#include "stages/gel/press/contact/plane_filter.h"

namespace tacipc {

/// Vertices as primitives of one vertex each.
struct OneVertex {
  const std::vector<int>& vertices;
  std::size_t size() const { return vertices.size(); }
  std::array<int, 1> operator[](std::size_t i) const { return {vertices[i]}; }
};

/// Box around some rows of x.
template <typename Vertices>
Box box_around(const Positions& x, const Vertices& vertices) {
  Box box;
  for (const int v : vertices) box.extend(Vector3(x.row(v)));
  return box;
}

/// Largest reach of some vertices.
template <typename Vertices>
double farthest_reach(const std::vector<double>& reach_m, const Vertices& vertices) {
  double farthest = 0.0;
  for (const int v : vertices) farthest = std::max(farthest, reach_m[static_cast<std::size_t>(v)]);
  return farthest;
}

/// Whether any of these vertices is marked.
template <typename Vertices>
bool has_one(const std::vector<char>& marked, const Vertices& vertices) {
  return std::any_of(vertices.begin(), vertices.end(), [&](int v) { return marked[static_cast<std::size_t>(v)] != 0; });
}

/// A box enlarged by `by` on all sides.
inline Box grown(Box box, double by) {
  box.min().array() -= by;
  box.max().array() += by;
  return box;
}

/// Box around each primitive at x.
template <typename Primitives>
std::vector<Box> boxes_at(const Primitives& primitives, const Positions& x) {
  std::vector<Box> boxes(primitives.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = box_around(x, primitives[i]);
  return boxes;
}

/// Runs fill(first, last, found) for chunks of 0 … count in parallel and appends their results in order.
template <typename Item, typename Fill>
void collect(std::size_t count, std::vector<Item>& out, Fill&& fill) {
  constexpr std::size_t kChunk = 512;
  std::vector<std::vector<Item>> found((count + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t chunk) {
    fill(chunk * kChunk, std::min(count, (chunk + 1) * kChunk), found[chunk]);
  });
  std::size_t size = out.size();
  for (const auto& part : found) size += part.size();
  out.reserve(size);
  for (const auto& part : found) out.insert(out.end(), part.begin(), part.end());
}

/// Calls keep(i) in order for each of the pairs first … last − 1 that may come nearer than within_m(i) between x and x
/// + p: those that no plane proves to stay apart.
template <typename Within, typename Keep>
void for_each_coming_near(const std::vector<ContactPair>& pairs, std::size_t first, std::size_t last, Within&& within_m,
                          const Positions& x, const Positions& p, Keep&& keep) {
  while (first < last) {
    const PairPack pack(pairs, first, last);
    Pack wanted = {};
    for (int l = 0; l < pack.count; ++l) wanted[l] = within_m(first + static_cast<std::size_t>(l));
    const unsigned apart = stay_apart(x.data(), p.data(), 1.0, pack.pairs, pack.kind(), 0.0, wanted, Pack{});
    for (int l = 0; l < pack.count; ++l) {
      if (!(apart >> l & 1U)) keep(first + static_cast<std::size_t>(l));
    }
    first += static_cast<std::size_t>(pack.count);
  }
}

}  // namespace tacipc
