// What the two broad phases share.
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

/// The box around rows of x.
template <typename Vertices>
Box box_around(const Positions& x, const Vertices& vertices) {
  Box box;
  for (const int v : vertices) box.extend(Vector3(x.row(v)));
  return box;
}

/// The farthest reach of some vertices.
template <typename Vertices>
double farthest_reach(const std::vector<double>& reach_m, const Vertices& vertices) {
  double farthest = 0.0;
  for (const int v : vertices) farthest = std::max(farthest, reach_m[static_cast<std::size_t>(v)]);
  return farthest;
}

/// Whether some vertices have one of those that are marked.
template <typename Vertices>
bool has_one(const std::vector<char>& marked, const Vertices& vertices) {
  return std::any_of(vertices.begin(), vertices.end(), [&](int v) { return marked[static_cast<std::size_t>(v)] != 0; });
}

inline Box grown(Box box, double by) {
  box.min().array() -= by;
  box.max().array() += by;
  return box;
}

template <typename Primitives>
std::vector<Box> boxes_at(const Primitives& primitives, const Positions& x) {
  std::vector<Box> boxes(primitives.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = box_around(x, primitives[i]);
  return boxes;
}

/// Runs fill(first, last, found) for chunks of 0 … count and joins what they found in order.
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

/// Calls keep(i) for pairs first … last − 1 but for those that a plane shows to stay farther apart than within_m(i)
/// from x to x + p, in order.
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
