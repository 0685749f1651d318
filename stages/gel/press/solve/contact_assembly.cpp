#include "stages/gel/press/solve/contact_assembly.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

namespace tacipc {
namespace {

constexpr std::size_t kStencilsPerChunk = 1024, kChunksAtATime = 16;

/// Sum of the derivatives of consecutive pairs that push on one primitive of the gel.
struct Sum {
  std::array<int, 3> vertices;  // gel vertices
  int count;
  Quad gradient[3] = {};
  Quad blocks[PackedBlocks::kBlocks][3] = {};  // by columns, laid out as in BlockMatrix
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

/// Gel primitive of a gel–object pair, if some of its vertices are free and the others do not move.
std::optional<WantedVertices> gel_primitive(std::span<const int> v, const FreeVertices& free, int first_object_vertex,
                                            const ObjectMotion& motion) {
  if (motion.in_full) return std::nullopt;
  const auto is_object = [&](int k) {
    return v[k] >= first_object_vertex && free.free_of_vertex[v[k]] < 0 &&
           (free.carried.empty() || !free.carrier(v[k]));
  };
  const WantedVertices own = !is_object(3) ? kTriangle : !is_object(1) ? kFirstEdge : kPoint;
  bool any_free = false;
  for (int k = 0; k < 4; ++k) {
    if (k < own.first || k >= own.first + own.count) {
      if (!is_object(k)) return std::nullopt;
      continue;
    }
    const bool is_free = free.free_of_vertex[v[k]] >= 0;
    if (v[k] >= first_object_vertex || !(is_free || motion.of_vertices.row(v[k]).isZero(0.0))) return std::nullopt;
    any_free = any_free || is_free;
  }
  return any_free ? std::optional(own) : std::nullopt;
}

PairVertices wanted_vertices(std::span<const int> v, const FreeVertices& free, int first_object_vertex,
                             const ObjectMotion& motion) {
  // Control points of a body receive contributions of all of its vertices.
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

/// Subtracts old blocks: `out` becomes the change, without gradient.
TACIPC_CLONES void subtract_blocks(int vertices, const PackedBlocks& old, PackedBlocks& out) {
  for (int b = 0; b < vertices; ++b) {
    for (Pack& g : out.gradient[b]) g = Pack{};
    for (int a = b; a < vertices; ++a) {
      for (int c = 0; c < 9; ++c) out.blocks[block_index(a, b)][c] -= old.blocks[block_index(a, b)][c];
    }
  }
}

void scatter(const Sum& sum, double weight, const FreeVertices& free, const Vector3& translation,
             NewtonSystem& system) {
  const bool moves = translation != Vector3::Zero();
  for (int b = 0; b < sum.count; ++b) {
    const int j = free.free_of_vertex[sum.vertices[b]];
    for (int c = 0; j >= 0 && c < 3; ++c) system.gradient[3 * j + c] += weight * sum.gradient[b][c];
    for (int a = b; a < sum.count; ++a) {
      const int i = free.free_of_vertex[sum.vertices[a]];
      const auto& columns = sum.blocks[block_index(a, b)];
      if (moves) {
        for (int r = 0; r < 3; ++r) {
          for (int c = 0; c < 3; ++c) {
            if (i >= 0) system.coupling[3 * i + r] -= weight * columns[c][r] * translation[c];
            if (j >= 0 && a != b) system.coupling[3 * j + c] -= weight * columns[c][r] * translation[r];
          }
        }
      }
      if (i < 0 || j < 0) continue;
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

/// Adds weight × these stencils in a fixed order. Stencils of gel and object are evaluated eight at a time by
/// evaluate_pack(which, count, primitive, blocks). All others are evaluated one by one by evaluate_single(stencil,
/// wanted, local), which returns false for a stencil that vanishes.
template <typename EvaluatePack, typename EvaluateSingle>
void add_stencils(double weight, const ContactTerm& term, const std::vector<int>& stencils, const FreeVertices& free,
                  int first_object_vertex, const ObjectMotion& motion, NewtonSystem& system,
                  EvaluatePack&& evaluate_pack, EvaluateSingle&& evaluate_single) {
  const auto primitive_of = [&](int stencil) {
    return gel_primitive(term.stencil(stencil), free, first_object_vertex, motion);
  };
  const auto evaluate = [&](std::size_t first, std::size_t last, Chunk& out) {
    while (first < last) {
      const auto primitive = primitive_of(stencils[first]);
      if (!primitive) {
        const int stencil = stencils[first++];
        const PairVertices wanted = wanted_vertices(term.stencil(stencil), free, first_object_vertex, motion);
        if (wanted == 0) continue;
        Single& one = out.singles.emplace_back();
        one.stencil = stencil;
        one.wanted = wanted;
        if (!evaluate_single(stencil, wanted, one.local)) out.singles.pop_back();
        continue;
      }
      StencilPack pack;
      int count = 0;
      for (; count < kLanes && first + count < last; ++count) {
        const auto next = primitive_of(stencils[first + count]);
        if (!next || next->first != primitive->first || next->count != primitive->count) break;
        pack[count] = stencils[first + count];
      }
      std::fill(pack.begin() + count, pack.end(), pack[0]);
      PackedBlocks found;
      evaluate_pack(pack, count, *primitive, found);
      // Pointers to sums follow below: growth must not move any.
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
  for (std::size_t first = 0; first < stencils.size(); first += kStencilsPerChunk * kChunksAtATime) {
    std::vector<Chunk> chunks(
        std::min(kChunksAtATime, (stencils.size() - first + kStencilsPerChunk - 1) / kStencilsPerChunk));
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t k) {
      const std::size_t begin = first + k * kStencilsPerChunk;
      evaluate(begin, std::min(stencils.size(), begin + kStencilsPerChunk), chunks[k]);
    });
    for (const Chunk& chunk : chunks) {
      for (const Sum& sum : chunk.sums) scatter(sum, weight, free, motion.translation, system);
      for (const Single& one : chunk.singles)
        scatter_pair(term.stencil(one.stencil), one.wanted, one.local, weight, free, first_object_vertex,
                     motion.of_vertices, system);
    }
  }
}

/// Shares of eight stencils.
Pack shares_of(const ContactTerm& term, const StencilPack& which, const Blend& blend) {
  Pack shares;
  for (int l = 0; l < kLanes; ++l) shares[l] = blend.share(term.stencil(which[l]));
  return shares;
}

}  // namespace

void assemble_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                      const FreeVertices& free, int first_object_vertex, const Blend& blend, const ObjectMotion& motion,
                      NewtonSystem& system) {
  add_stencils(
      weight, term, active, free, first_object_vertex, motion, system,
      [&](const StencilPack& which, int count, WantedVertices wanted, PackedBlocks& out) {
        term.evaluate_pack(which, count, x, shares_of(term, which, blend), wanted, out);
      },
      [&](int stencil, PairVertices wanted, PairLocal& out) {
        const std::span<const int> v = term.stencil(stencil);
        return term.evaluate_blended(stencil, points_of(v, x), blend.share(v), wanted, out);
      });
}

void reblend_contact(double weight, const ContactTerm& term, const std::vector<int>& active, const Positions& x,
                     const FreeVertices& free, int first_object_vertex, const Blend& before, const Blend& after,
                     const ObjectMotion& motion, NewtonSystem& system, std::vector<char>& changed_rows) {
  std::vector<int> stencils;
  for (const int i : active) {
    const std::span<const int> v = term.stencil(i);
    if (before.share(v) == after.share(v)) continue;
    stencils.push_back(i);
    for (const int k : v) {
      if (const int row = free.free_of_vertex[k]; row >= 0) changed_rows[static_cast<std::size_t>(row)] = 1;
    }
  }
  add_stencils(
      weight, term, stencils, free, first_object_vertex, motion, system,
      [&](const StencilPack& which, int count, WantedVertices wanted, PackedBlocks& out) {
        PackedBlocks old;
        term.evaluate_pack(which, count, x, shares_of(term, which, before), wanted, old);
        term.evaluate_pack(which, count, x, shares_of(term, which, after), wanted, out);
        subtract_blocks(wanted.count, old, out);
      },
      [&](int stencil, PairVertices wanted, PairLocal& out) {
        const std::span<const int> v = term.stencil(stencil);
        const FourPoints points = points_of(v, x);
        PairLocal old;
        if (!term.evaluate_blended(stencil, points, before.share(v), wanted, old)) return false;
        term.evaluate_blended(stencil, points, after.share(v), wanted, out);
        out.hessian -= old.hessian;
        out.gradient.setZero();
        return true;
      });
}

}  // namespace tacipc
