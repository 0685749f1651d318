#include "stages/gel/press/solve/volume_assembly.h"

#include <algorithm>

namespace tacipc {
namespace {

/// Adds c gᵢ gⱼᵀ to the blocks i ≥ j, column by column.
TACIPC_CLONES void scatter_products(const double* gradients, int count, double c, const int* places, double* values) {
  for (int j = 0; j < count; ++j) {
    const Quad g = c * load_quad(gradients + 4 * j);
    for (int i = j; i < count; ++i, ++places) {
      const Quad row = load_quad(gradients + 4 * i);
      double* block = values + BlockMatrix::kStride * static_cast<std::size_t>(*places);
      for (int k = 0; k < 3; ++k) store_quad(block + 4 * k, load_quad(block + 4 * k) + g[k] * row);
    }
  }
}

}  // namespace

VolumeAssembly::VolumeAssembly(const AveragedElasticity& elasticity, const FreeVertices& free)
    : elasticity_(elasticity), free_(free), groups_(elasticity.num_stencils(), free.size(), [&](int c, auto&& touches) {
        for (const int v : elasticity.stencil(c)) touches(free.free_of_vertex[v]);
      }) {}

void VolumeAssembly::look_up(const BlockPattern& pattern) {
  clusters_.assign(static_cast<std::size_t>(elasticity_.num_stencils()), {});
  for (int c = 0; c < elasticity_.num_stencils(); ++c) {
    const auto stencil = elasticity_.stencil(c);
    const auto number = [&](int member) { return free_.free_of_vertex[stencil[static_cast<std::size_t>(member)]]; };
    Cluster& cluster = clusters_[static_cast<std::size_t>(c)];
    for (int k = 0; k < static_cast<int>(stencil.size()); ++k) {
      if (number(k) >= 0) cluster.members.push_back(k);
    }
    std::sort(cluster.members.begin(), cluster.members.end(), [&](int a, int b) { return number(a) < number(b); });
    for (auto j = cluster.members.begin(); j != cluster.members.end(); ++j) {
      for (auto i = j; i != cluster.members.end(); ++i) cluster.places.push_back(pattern.find(number(*i), number(*j)));
    }
  }
}

void VolumeAssembly::add(const std::vector<double>& second, const Positions& x, double weight, NewtonSystem& system) {
  if (pattern_ != system.hessian.pattern) {
    pattern_ = system.hessian.pattern;
    look_up(*pattern_);
  }
  groups_.for_each([&](const std::vector<int>& group) {
    Eigen::Matrix3Xd of_stencil;
    Eigen::Matrix4Xd of_members;
    for (const int c : group) {
      const Cluster& cluster = clusters_[static_cast<std::size_t>(c)];
      elasticity_.volume_gradient(c, x, of_stencil);
      of_members.setZero(4, static_cast<Eigen::Index>(cluster.members.size()));
      for (std::size_t k = 0; k < cluster.members.size(); ++k)
        of_members.col(static_cast<Eigen::Index>(k)).head<3>() = of_stencil.col(cluster.members[k]);
      scatter_products(of_members.data(), static_cast<int>(cluster.members.size()),
                       weight * second[static_cast<std::size_t>(c)], cluster.places.data(),
                       system.hessian.values.data());
    }
  });
}

}  // namespace tacipc
