#include "stages/gel/press/solve/elastic_assembly.h"

#include <limits>

namespace tacipc {
namespace {

constexpr int kNowhere = std::numeric_limits<int>::min();

using Places = std::array<std::array<int, kLanes>, ElasticPacks::kBlocks>;

/// Adds weight × the blocks of one pack, none of them transposed: a column of a block is one addition.
TACIPC_CLONES void scatter_straight(const ElasticPacks::Derivatives& from, const Places& places, double weight,
                                    double* values) {
  for (int b = 0; b < ElasticPacks::kBlocks; ++b) {
    for (int half = 0; half < 2; ++half) {
      for (int c = 0; c < 3; ++c) {
        Quad lanes[4];
        transpose(from.hessian[b] + 3 * c, half, lanes);
        for (int l = 0; l < 4; ++l) {
          const int place = places[b][4 * half + l];
          if (place == kNowhere) continue;
          double* column = values + BlockMatrix::kStride * static_cast<std::size_t>(place) + 4 * c;
          store_quad(column, load_quad(column) + weight * lanes[l]);
        }
      }
    }
  }
}

/// Adds weight × the blocks of one pack, any of which may be stored transposed.
void scatter_any(const ElasticPacks::Derivatives& from, const Places& places, double weight, double* values) {
  for (int b = 0; b < ElasticPacks::kBlocks; ++b) {
    for (int l = 0; l < kLanes; ++l) {
      const int place = places[b][l];
      if (place == kNowhere) continue;
      double* block = values + BlockMatrix::kStride * static_cast<std::size_t>(place >= 0 ? place : -1 - place);
      const int row = place >= 0 ? 1 : 4, column = place >= 0 ? 4 : 1;
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) block[column * c + row * r] += weight * from.hessian[b][3 * c + r][l];
      }
    }
  }
}

}  // namespace

ElasticAssembly::ElasticAssembly(const ElasticPacks& packs, const FreeVertices& free)
    : packs_(packs), free_(free), groups_(packs.size(), free.size(), [&](int p, auto&& touches) {
        const auto& corners = packs.corners(p);
        for (const auto& corner : corners.vertices) {
          for (int l = 0; l < corners.count; ++l) touches(free.free_of_vertex[corner[l]]);
        }
      }) {}

void ElasticAssembly::look_up(const BlockPattern& pattern) {
  places_.resize(static_cast<std::size_t>(packs_.size()));
  none_transposed_.assign(places_.size(), true);
  for (int p = 0; p < packs_.size(); ++p) {
    const auto& corners = packs_.corners(p);
    for (int b = 0, at = 0; b < 4; ++b) {
      for (int a = b; a < 4; ++a, ++at) {
        for (int l = 0; l < kLanes; ++l) {
          const int i = free_.free_of_vertex[corners.vertices[a][l]], j = free_.free_of_vertex[corners.vertices[b][l]];
          int& place = places_[static_cast<std::size_t>(p)][at][l];
          place = l >= corners.count || i < 0 || j < 0 ? kNowhere
                  : i >= j                             ? pattern.find(i, j)
                                                       : -1 - pattern.find(j, i);
          if (place < 0 && place != kNowhere) none_transposed_[static_cast<std::size_t>(p)] = false;
        }
      }
    }
  }
}

void ElasticAssembly::add_gradient(int pack, const ElasticPacks::Derivatives& found, NewtonSystem& system) const {
  const auto& corners = packs_.corners(pack);
  for (int l = 0; l < corners.count; ++l) {
    for (int a = 0; a < 4; ++a) {
      const int i = free_.free_of_vertex[corners.vertices[a][l]];
      if (i < 0) continue;
      double* g = system.gradient.data() + 3 * static_cast<std::ptrdiff_t>(i);
      for (int c = 0; c < 3; ++c) g[c] += weight_ * found.gradient[a][c][l];
    }
  }
}

void ElasticAssembly::add_hessian(int pack, const ElasticPacks::Derivatives& found, NewtonSystem& system) const {
  const auto place = static_cast<std::size_t>(pack);
  (none_transposed_[place] ? scatter_straight : scatter_any)(found, places_[place], weight_,
                                                             system.hessian.values.data());
}

void ElasticAssembly::add(const Positions& x, std::span<const double> pressure, double weight, NewtonSystem& system) {
  if (pattern_ != system.hessian.pattern) {
    pattern_ = system.hessian.pattern;
    look_up(*pattern_);
  }
  weight_ = weight;
  states_.resize(places_.size());
  changed_.assign(places_.size(), 1);
  groups_.for_each([&](const std::vector<int>& group) {
    ElasticPacks::Derivatives found;
    for (const int p : group) {
      const double* of_pack = pressure.empty() ? nullptr : &pressure[static_cast<std::size_t>(kLanes * p)];
      packs_.derivatives(p, x, of_pack, states_[static_cast<std::size_t>(p)], found);
      add_gradient(p, found, system);
      add_hessian(p, found, system);
    }
  });
}

void ElasticAssembly::update(const Positions& x, std::span<const double> pressure, double tolerance,
                             NewtonSystem& system, std::vector<char>& changed_rows) {
  groups_.for_each([&](const std::vector<int>& group) {
    ElasticPacks::Derivatives found;
    for (const int p : group) {
      const double* of_pack = pressure.empty() ? nullptr : &pressure[static_cast<std::size_t>(kLanes * p)];
      const auto place = static_cast<std::size_t>(p);
      changed_[place] = packs_.change(p, x, of_pack, tolerance, states_[place], found);
      add_gradient(p, found, system);
      if (!changed_[place]) continue;
      add_hessian(p, found, system);
      const auto& corners = packs_.corners(p);
      for (const auto& corner : corners.vertices) {
        for (int l = 0; l < corners.count; ++l) {
          if (const int i = free_.free_of_vertex[corner[l]]; i >= 0) changed_rows[static_cast<std::size_t>(i)] = 1;
        }
      }
    }
  });
}

}  // namespace tacipc
