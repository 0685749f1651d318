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

/// Adds c gᵢ gⱼᵀ − c′ gᵢ′ gⱼ′ᵀ to the blocks i ≥ j.
TACIPC_CLONES void scatter_change(const double* gradients, double c, const double* before, double c_before, int count,
                                  const int* places, double* values) {
  for (int j = 0; j < count; ++j) {
    const Quad g = c * load_quad(gradients + 4 * j), g_before = c_before * load_quad(before + 4 * j);
    for (int i = j; i < count; ++i, ++places) {
      const Quad row = load_quad(gradients + 4 * i), row_before = load_quad(before + 4 * i);
      double* block = values + BlockMatrix::kStride * static_cast<std::size_t>(*places);
      for (int k = 0; k < 3; ++k)
        store_quad(block + 4 * k, load_quad(block + 4 * k) + (g[k] * row - g_before[k] * row_before));
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

void VolumeAssembly::find_gradients(int c, const Positions& x, Eigen::Matrix3Xd& of_stencil,
                                    Eigen::Matrix4Xd& out) const {
  const std::vector<int>& members = clusters_[static_cast<std::size_t>(c)].members;
  elasticity_.volume_gradient(c, x, of_stencil);
  out.setZero(4, static_cast<Eigen::Index>(members.size()));
  for (std::size_t k = 0; k < members.size(); ++k)
    out.col(static_cast<Eigen::Index>(k)).head<3>() = of_stencil.col(members[k]);
}

void VolumeAssembly::add(const std::vector<double>& second, const Positions& x, double weight, NewtonSystem& system) {
  if (pattern_ != system.hessian.pattern) {
    pattern_ = system.hessian.pattern;
    look_up(*pattern_);
  }
  weight_ = weight;
  groups_.for_each([&](const std::vector<int>& group) {
    Eigen::Matrix3Xd of_stencil;
    for (const int c : group) {
      Cluster& cluster = clusters_[static_cast<std::size_t>(c)];
      find_gradients(c, x, of_stencil, cluster.gradients);
      cluster.second = weight * second[static_cast<std::size_t>(c)];
      scatter_products(cluster.gradients.data(), static_cast<int>(cluster.members.size()), cluster.second,
                       cluster.places.data(), system.hessian.values.data());
    }
  });
}

void VolumeAssembly::update(const std::vector<double>& second, const Positions& x, const ElasticAssembly& changed,
                            NewtonSystem& system, std::vector<char>& changed_rows) {
  groups_.for_each([&](const std::vector<int>& group) {
    Eigen::Matrix3Xd of_stencil;
    Eigen::Matrix4Xd gradients;
    for (const int c : group) {
      const auto [first, last] = elasticity_.packs_of(c);
      bool any = false;
      for (int p = first; p <= last; ++p) any = any || changed.changed(p);
      if (!any) continue;
      Cluster& cluster = clusters_[static_cast<std::size_t>(c)];
      find_gradients(c, x, of_stencil, gradients);
      const double now = weight_ * second[static_cast<std::size_t>(c)];
      scatter_change(gradients.data(), now, cluster.gradients.data(), cluster.second,
                     static_cast<int>(cluster.members.size()), cluster.places.data(), system.hessian.values.data());
      cluster.gradients.swap(gradients);
      cluster.second = now;
      for (const int v : elasticity_.stencil(c)) {
        if (const int i = free_.free_of_vertex[v]; i >= 0) changed_rows[static_cast<std::size_t>(i)] = 1;
      }
    }
  });
}

}  // namespace tacipc
