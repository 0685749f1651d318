#include "stages/press/solve/volume_assembly.h"

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

void VolumeAssembly::look_up(const AveragedElasticity& elasticity, const FreeVertices& free) {
  patches_.assign(static_cast<std::size_t>(elasticity.num_stencils()), {});
  for (int p = 0; p < elasticity.num_stencils(); ++p) {
    const auto stencil = elasticity.stencil(p);
    const auto number = [&](int member) { return free.free_of_vertex[stencil[static_cast<std::size_t>(member)]]; };
    Patch& patch = patches_[static_cast<std::size_t>(p)];
    for (int k = 0; k < static_cast<int>(stencil.size()); ++k) {
      if (number(k) >= 0) patch.members.push_back(k);
    }
    std::sort(patch.members.begin(), patch.members.end(), [&](int a, int b) { return number(a) < number(b); });
    for (auto j = patch.members.begin(); j != patch.members.end(); ++j) {
      for (auto i = j; i != patch.members.end(); ++i) patch.places.push_back(pattern_->find(number(*i), number(*j)));
    }
  }
}

void VolumeAssembly::add(const AveragedElasticity& elasticity, const std::vector<double>& second, const Positions& x,
                         double weight, const FreeVertices& free, NewtonSystem& system) {
  if (pattern_ != system.hessian.pattern) {
    pattern_ = system.hessian.pattern;
    look_up(elasticity, free);
    if (groups_.empty()) {
      groups_ = SeparateGroups(elasticity.num_stencils(), free.size(), [&](int p, auto&& touches) {
        for (const int v : elasticity.stencil(p)) touches(free.free_of_vertex[v]);
      });
    }
  }
  groups_.for_each([&](const std::vector<int>& group) {
    Eigen::Matrix3Xd of_stencil;
    Eigen::Matrix4Xd of_members;
    for (const int p : group) {
      const Patch& patch = patches_[static_cast<std::size_t>(p)];
      elasticity.volume_gradient(p, x, of_stencil);
      of_members.setZero(4, static_cast<Eigen::Index>(patch.members.size()));
      for (std::size_t k = 0; k < patch.members.size(); ++k)
        of_members.col(static_cast<Eigen::Index>(k)).head<3>() = of_stencil.col(patch.members[k]);
      scatter_products(of_members.data(), static_cast<int>(patch.members.size()),
                       weight * second[static_cast<std::size_t>(p)], patch.places.data(), system.hessian.values.data());
    }
  });
}

}  // namespace tacipc
