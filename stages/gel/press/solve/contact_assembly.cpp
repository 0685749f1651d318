#include "stages/gel/press/solve/contact_assembly.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

namespace tacipc {
namespace {

constexpr std::size_t kChunk = 1024, kChunksAtATime = 16;

/// Derivatives of all pairs in a row that push on one primitive of the gel.
struct Sum {
  std::array<int, 3> vertices;  // of the gel
  int count;
  Quad gradient[3] = {};
  Quad blocks[PackedBlocks::kBlocks][3] = {};  // by columns, as BlockMatrix has them
};

/// A pair that is evaluated by itself.
struct Single {
  int stencil;
  PairVertices wanted;
  PairLocal local;
};

struct Chunk {
  std::vector<Sum> sums;
  std::vector<Single> singles;
};

/// The gel's primitive of a pair of gel and object, if all of its vertices are free.
std::optional<WantedVertices> gel_primitive(std::span<const int> v, const FreeVertices& free, int first_object_vertex) {
  const auto is_free = [&](int k) { return free.free_of_vertex[v[k]] >= 0; };
  const auto is_object = [&](int k) {
    return v[k] >= first_object_vertex && !is_free(k) && (free.carried.empty() || !free.carrier(v[k]));
  };
  if (is_free(0) && is_object(1) && is_object(2) && is_object(3)) return kPoint;
  if (is_object(0) && is_free(1) && is_free(2) && is_free(3)) return kTriangle;
  if (is_free(0) && is_free(1) && is_object(2) && is_object(3)) return kFirstEdge;
  return std::nullopt;
}

PairVertices wanted_vertices(std::span<const int> v, const FreeVertices& free, int first_object_vertex,
                             const ObjectMotion& motion) {
  // A body's points take part of all of its vertices.
  if (!free.carried.empty() && std::any_of(v.begin(), v.end(), [&](int k) { return free.carrier(k) != nullptr; }))
    return kAllPairVertices;
  const bool with_object = motion.in_full || motion.translation != Vector3::Zero();
  PairVertices wanted = 0;
  for (int a = 0; a < 4; ++a) {
    if (free.free_of_vertex[v[a]] >= 0 || (with_object && v[a] >= first_object_vertex)) wanted |= 1U << a;
  }
  return wanted;
}

FourPoints points_of(std::span<const int> v, const Positions& x) {
  return {x.row(v[0]), x.row(v[1]), x.row(v[2]), x.row(v[3])};
}

/// Adds each lane to its sum.
TACIPC_CLONES void add_lanes(const PackedBlocks& from, int lanes, int vertices, Sum* const* sums) {
  const auto add = [&](const Pack* rows, auto&& column_of) __attribute__((always_inline)) {
    for (int half = 0; 4 * half < lanes; ++half) {
      Quad columns[4];
      transpose(rows, half, columns);
      for (int l = 0; l < 4 && 4 * half + l < lanes; ++l) column_of(*sums[4 * half + l]) += columns[l];
    }
  };
  for (int b = 0; b < vertices; ++b) {
    add(
        from.gradient[b], [&](Sum & sum) __attribute__((always_inline))->Quad & { return sum.gradient[b]; });
    for (int a = b; a < vertices; ++a) {
      const int block = block_index(a, b);
      for (int c = 0; c < 3; ++c)
        add(
            from.blocks[block] + 3 * c, [&](Sum & sum) __attribute__((always_inline))->Quad &
                                            { return sum.blocks[block][c]; });
    }
  }
}

void scatter(const Sum& sum, double weight, const FreeVertices& free, const Vector3& translation,
             NewtonSystem& system) {
  const bool moves = translation != Vector3::Zero();
  for (int b = 0; b < sum.count; ++b) {
    const int j = free.free_of_vertex[sum.vertices[b]];
    for (int c = 0; c < 3; ++c) system.gradient[3 * j + c] += weight * sum.gradient[b][c];
    for (int a = b; a < sum.count; ++a) {
      const int i = free.free_of_vertex[sum.vertices[a]];
      const auto& columns = sum.blocks[block_index(a, b)];
      if (moves) {
        for (int r = 0; r < 3; ++r) {
          for (int c = 0; c < 3; ++c) {
            system.coupling[3 * i + r] -= weight * columns[c][r] * translation[c];
            if (a != b) system.coupling[3 * j + c] -= weight * columns[c][r] * translation[r];
          }
        }
      }
      if (i >= j) {
        double* block = system.hessian.block(i, j).data();
        for (int c = 0; c < 3; ++c) store_quad(block + 4 * c, load_quad(block + 4 * c) + weight * columns[c]);
      }
      if (i < j || (i == j && a != b)) {
        BlockMatrix::Block block = system.hessian.block(j, i);
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r) block(c, r) += weight * columns[c][r];
      }
    }
  }
}

}  // namespace

void assemble_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                      const FreeVertices& free, int first_object_vertex, const Blend& blend, const ObjectMotion& motion,
                      NewtonSystem& system) {
  const auto evaluate_single = [&](int stencil, std::vector<Single>& out) {
    const std::span<const int> v = term.stencil(stencil);
    const PairVertices wanted = wanted_vertices(v, free, first_object_vertex, motion);
    if (wanted == 0) return;
    Single& one = out.emplace_back();
    one.stencil = stencil;
    one.wanted = wanted;
    if (!term.evaluate_blended(stencil, points_of(v, x), blend.share(v), wanted, one.local)) out.pop_back();
  };
  const auto evaluate = [&](std::size_t first, std::size_t last, Chunk& out) {
    while (first < last) {
      const auto primitive =
          motion.in_full ? std::nullopt : gel_primitive(term.stencil(active[first]), free, first_object_vertex);
      if (!primitive) {
        evaluate_single(active[first++], out.singles);
        continue;
      }
      StencilPack pack;
      Pack shares = {};
      int count = 0;
      for (; count < kLanes && first + count < last; ++count) {
        const auto next = gel_primitive(term.stencil(active[first + count]), free, first_object_vertex);
        if (!next || next->first != primitive->first || next->count != primitive->count) break;
        pack[count] = active[first + count];
        shares[count] = blend.share(term.stencil(pack[count]).subspan(primitive->first, primitive->count));
      }
      std::fill(pack.begin() + count, pack.end(), pack[0]);
      PackedBlocks found;
      term.evaluate_pack(pack, count, x, shares, *primitive, found);
      // Pointers to sums below: none may be moved by growth.
      if (out.sums.capacity() < out.sums.size() + kLanes) out.sums.reserve(2 * out.sums.size() + 8 * kLanes);
      std::array<Sum*, kLanes> sums;
      for (int lane = 0; lane < count; ++lane) {
        const std::span<const int> v = term.stencil(pack[lane]).subspan(primitive->first, primitive->count);
        if (out.sums.empty() || out.sums.back().count != primitive->count ||
            !std::equal(v.begin(), v.end(), out.sums.back().vertices.begin())) {
          Sum& sum = out.sums.emplace_back();
          sum.count = primitive->count;
          std::copy(v.begin(), v.end(), sum.vertices.begin());
        }
        sums[lane] = &out.sums.back();
      }
      add_lanes(found, count, primitive->count, sums.data());
      first += static_cast<std::size_t>(count);
    }
  };
  for (std::size_t first = 0; first < active.size(); first += kChunk * kChunksAtATime) {
    std::vector<Chunk> chunks(std::min(kChunksAtATime, (active.size() - first + kChunk - 1) / kChunk));
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t k) {
      const std::size_t begin = first + k * kChunk;
      evaluate(begin, std::min(active.size(), begin + kChunk), chunks[k]);
    });
    for (const Chunk& chunk : chunks) {
      for (const Sum& sum : chunk.sums) scatter(sum, weight, free, motion.translation, system);
      for (const Single& one : chunk.singles)
        scatter_pair(term.stencil(one.stencil), one.wanted, one.local, weight, free, first_object_vertex,
                     motion.of_vertices, system);
    }
  }
}

void reblend_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                     const FreeVertices& free, int first_object_vertex, const Blend& before, const Blend& after,
                     const ObjectMotion& motion, NewtonSystem& system, std::vector<char>& changed_rows) {
  PairLocal old, local;
  for (const int stencil : active) {
    const std::span<const int> v = term.stencil(stencil);
    const double was = before.share(v), is = after.share(v);
    if (was == is) continue;
    const PairVertices wanted = wanted_vertices(v, free, first_object_vertex, motion);
    if (wanted == 0) continue;
    const FourPoints points = points_of(v, x);
    if (!term.evaluate_blended(stencil, points, was, wanted, old)) continue;
    term.evaluate_blended(stencil, points, is, wanted, local);
    local.hessian -= old.hessian;
    local.gradient.setZero();
    scatter_pair(v, wanted, local, weight, free, first_object_vertex, motion.of_vertices, system);
    for (const int k : v) {
      if (const int row = free.free_of_vertex[k]; row >= 0) changed_rows[static_cast<std::size_t>(row)] = 1;
    }
  }
}

}  // namespace tacipc
