#include "stages/rival/mpm/transfer.h"

#include <limits>

#include "stages/rival/mpm/fixed_corotated.h"

namespace tacipc {
namespace {

/// Nodes that sixteen particles reach, and their weights.
struct Stencils {
  IntLanes node;        // first of the 3 × 3 × 3 nodes
  Lanes weight[3][3];   // weights along each axis
  Lanes from_first[3];  // position of the particle relative to that node, cells
};

/// Quadratic B-spline at the three nodes; the first is a distance f ∈ [½, 1½] before the particle.
TACIPC_INLINE void spline(const Lanes& f, Lanes* weight) {
  weight[0] = 0.5f * (1.5f - f) * (1.5f - f);
  weight[1] = 0.75f - (f - 1.0f) * (f - 1.0f);
  weight[2] = 0.5f * (f - 0.5f) * (f - 0.5f);
}

TACIPC_INLINE void find_stencils(const ParticlePack& pack, const Slab& slab, Stencils& out) {
  out.node = IntLanes{};
  for (int axis = 0; axis < 3; ++axis) {
    // From the slab's origin all positions are positive, so that truncation rounds down.
    const Lanes x = (pack.rest[axis] - static_cast<float>(slab.origin[axis])) + pack.shift[axis];
    const IntLanes cell = __builtin_convertvector(x - 0.5f, IntLanes);
    out.from_first[axis] = x - __builtin_convertvector(cell, Lanes);
    spline(out.from_first[axis], out.weight[axis]);
    out.node = out.node * slab.nodes[axis] + cell;
  }
}

TACIPC_INLINE int num_particles(const ParticlePack& pack) {
  int count = 0;
  while (count < kParticleLanes && pack.id[count] >= 0) ++count;
  return count;
}

/// 0 in the four lanes of the first node, 1 in those of the next, …
constexpr Lanes kLevel = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

/// Adds wx[i] wy[j] (column + i along_x + j along_y) to the columns of nodes that a particle reaches. Each column of
/// three is updated as one of four, the last with weight 0.
TACIPC_INLINE void add_to_columns(float* first, std::ptrdiff_t stride_x, std::ptrdiff_t stride_y, const float* wx,
                                  const float* wy, const Lanes& column, const Lanes& along_x, const Lanes& along_y) {
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const Lanes row = column + static_cast<float>(i) * along_x;
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      auto* nodes = reinterpret_cast<FourNodes*>(first + i * stride_x + j * stride_y);
      *nodes += (wx[i] * wy[j]) * (row + static_cast<float>(j) * along_y);
    }
  }
}

struct Strides {
  std::ptrdiff_t x, y;
  explicit Strides(const Slab& slab)
      : x(4 * static_cast<std::ptrdiff_t>(slab.nodes[1]) * slab.nodes[2]),
        y(4 * static_cast<std::ptrdiff_t>(slab.nodes[2])) {}
};

}  // namespace

TACIPC_CLONES void scatter(const ParticlePack* packs, int num_packs, const StepMaterial& material, Slab& slab) {
  const Strides stride(slab);
  float* const values = slab.values.data();
  for (const ParticlePack* pack = packs; pack != packs + num_packs; ++pack) {
    Stencils at;
    find_stencils(*pack, slab, at);
    Lanes affine[9];
    kirchhoff_stresses(pack->deformation, material.mu, material.lambda, affine);
    for (int k = 0; k < 9; ++k) affine[k] = pack->affine[k] - affine[k];
    Lanes at_first[3];  // v + A (x − x_p) at the first node
    for (int r = 0; r < 3; ++r)
      at_first[r] = pack->velocity[r] - (affine[3 * r] * at.from_first[0] + affine[3 * r + 1] * at.from_first[1] +
                                         affine[3 * r + 2] * at.from_first[2]);
    // Per particle: (momentum, mass) at the first node, and its increments along x, y, z.
    FloatQuad first[kParticleLanes], grow[3][kParticleLanes], weight[3][kParticleLanes];
    quads_of_lanes(at_first[0], at_first[1], at_first[2], all_lanes(1.0f), first);
    for (int axis = 0; axis < 3; ++axis) {
      quads_of_lanes(affine[axis], affine[3 + axis], affine[6 + axis], Lanes{}, grow[axis]);
      quads_of_lanes(at.weight[axis][0], at.weight[axis][1], at.weight[axis][2], Lanes{}, weight[axis]);
    }
    const int count = num_particles(*pack);
    for (int l = 0; l < count; ++l) {
      const Lanes wz = one_per_node(weight[2][l]);
      const Lanes column = wz * (on_each_node(first[l]) + kLevel * on_each_node(grow[2][l]));
      const float wx[3] = {weight[0][l][0], weight[0][l][1], weight[0][l][2]};
      const float wy[3] = {weight[1][l][0], weight[1][l][1], weight[1][l][2]};
      add_to_columns(values + 4 * static_cast<std::ptrdiff_t>(at.node[l]), stride.x, stride.y, wx, wy, column,
                     wz * on_each_node(grow[0][l]), wz * on_each_node(grow[1][l]));
    }
  }
}

TACIPC_CLONES void scatter(const MovingPoint* points, int num_points, float mass, Slab& slab) {
  const Strides stride(slab);
  for (const MovingPoint* point = points; point != points + num_points; ++point) {
    float weight[3][3];
    std::ptrdiff_t node = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float x = point->position[axis];
      const int cell = static_cast<int>(x - 0.5f);
      const float f = x - static_cast<float>(cell);
      weight[axis][0] = 0.5f * (1.5f - f) * (1.5f - f);
      weight[axis][1] = 0.75f - (f - 1.0f) * (f - 1.0f);
      weight[axis][2] = 0.5f * (f - 0.5f) * (f - 0.5f);
      node = node * slab.nodes[axis] + cell;
    }
    const FloatQuad moving = {mass * point->velocity[0], mass * point->velocity[1], mass * point->velocity[2], mass};
    const FloatQuad wz = {weight[2][0], weight[2][1], weight[2][2], 0.0f};
    add_to_columns(slab.values.data() + 4 * node, stride.x, stride.y, weight[0], weight[1],
                   one_per_node(wz) * on_each_node(moving), Lanes{}, Lanes{});
  }
}

TACIPC_CLONES void update_nodes(Slab& slab, std::size_t first, std::size_t last, float keep) {
  const auto column = 4 * static_cast<std::size_t>(slab.nodes[2]);
  for (std::size_t c = first; c < last; ++c) {
    float* const nodes = slab.values.data() + c * column;
    for (std::size_t at = 0; at < column; at += kParticleLanes) {
      auto* four = reinterpret_cast<FourNodes*>(nodes + at);
      const Lanes value = *four;
      const Lanes mass = __builtin_shufflevector(value, value, 3, 3, 3, 3, 7, 7, 7, 7, 11, 11, 11, 11, 15, 15, 15, 15);
      *four = mass > 0.0f ? keep * value / mass : Lanes{};
    }
    for (int k = 0; k < 4 * slab.held_nodes; ++k) nodes[k] = 0.0f;
  }
}

TACIPC_CLONES GatherReport gather(ParticlePack* packs, int num_packs, const Slab& slab, int num_fixed) {
  const Strides stride(slab);
  const float* const values = slab.values.data();
  Lanes largest = {};
  for (ParticlePack* pack = packs; pack != packs + num_packs; ++pack) {
    Stencils at;
    find_stencils(*pack, slab, at);
    FloatQuad weight[3][kParticleLanes];
    for (int axis = 0; axis < 3; ++axis)
      quads_of_lanes(at.weight[axis][0], at.weight[axis][1], at.weight[axis][2], Lanes{}, weight[axis]);
    FloatQuad mean[kParticleLanes], moment[3][kParticleLanes];  // Σ w v, Σ w v (x_i − x_first)
    const int count = num_particles(*pack);
    for (int l = count; l < kParticleLanes; ++l) {
      mean[l] = FloatQuad{};
      for (auto& along : moment) along[l] = FloatQuad{};
    }
    for (int l = 0; l < count; ++l) {
      const float* const node = values + 4 * static_cast<std::ptrdiff_t>(at.node[l]);
      const FloatQuad wx = weight[0][l], wy = weight[1][l];
      Lanes sum = {}, sum_x = {}, sum_y = {};
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) {
        const Lanes v0 = *reinterpret_cast<const FourNodes*>(node + i * stride.x),
                    v1 = *reinterpret_cast<const FourNodes*>(node + i * stride.x + stride.y),
                    v2 = *reinterpret_cast<const FourNodes*>(node + i * stride.x + 2 * stride.y);
        const Lanes of_1 = wy[1] * v1, of_2 = wy[2] * v2;
        const Lanes row = wx[i] * (wy[0] * v0 + of_1 + of_2);
        sum += row;
        sum_x += static_cast<float>(i) * row;
        sum_y += wx[i] * (of_1 + 2.0f * of_2);
      }
      const Lanes wz = one_per_node(weight[2][l]);
      sum *= wz;
      mean[l] = sum_of_nodes(sum);
      moment[0][l] = sum_of_nodes(wz * sum_x);
      moment[1][l] = sum_of_nodes(wz * sum_y);
      moment[2][l] = sum_of_nodes(kLevel * sum);
    }
    Lanes v[3], B[3][3];
    lanes_of_quads(mean, v[0], v[1], v[2]);
    for (int axis = 0; axis < 3; ++axis) lanes_of_quads(moment[axis], B[0][axis], B[1][axis], B[2][axis]);
    Lanes C[9], F[9];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) C[3 * r + c] = 4.0f * (B[r][c] - v[r] * at.from_first[c]);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        const Lanes* const f = pack->deformation;
        F[3 * r + c] = f[3 * r + c] + (C[3 * r] * f[c] + C[3 * r + 1] * f[3 + c] + C[3 * r + 2] * f[6 + c]);
      }
    }
    Lanes speed_squared = {};
    for (int r = 0; r < 3; ++r) {
      v[r] = pack->id < num_fixed ? Lanes{} : v[r];
      pack->velocity[r] = v[r];
      pack->shift[r] += v[r];
      speed_squared += v[r] * v[r];
    }
    for (int k = 0; k < 9; ++k) {
      pack->affine[k] = C[k];
      pack->deformation[k] = F[k];
    }
    // A comparison with NaN is false.
    largest = larger(speed_squared < 1e6f ? speed_squared : all_lanes(std::numeric_limits<float>::infinity()), largest);
  }
  return {largest_of(largest)};
}

}  // namespace tacipc
