#include "stages/gel/press/solve/assembly.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "stages/gel/press/energy/inertia.h"
#include "stages/gel/press/energy/viscous_memory.h"

namespace tacipc {
namespace {

constexpr int kChunk = 256;
constexpr std::size_t kAtATime = 8192;  // number of gradients that fit in the cache

std::vector<int> all_stencils(const EnergyTerm& term) {
  std::vector<int> all(static_cast<std::size_t>(term.num_stencils()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Evaluates these stencils in parallel, a chunk at a time, and passes them to `scatter` one by one in order.
template <typename Scatter>
void for_each_local(const EnergyTerm& term, const std::vector<int>& stencils, const Positions& x, Order order,
                    Scatter&& scatter) {
  const int count = static_cast<int>(stencils.size());
  std::vector<Local> locals(static_cast<std::size_t>(std::min(count, kChunk)));
  for (int first = 0; first < count; first += kChunk) {
    const int size = std::min(kChunk, count - first);
    tbb::parallel_for(tbb::blocked_range<int>(0, size, 32), [&](const auto& range) {
      Eigen::VectorXd local_x;
      for (int k = range.begin(); k < range.end(); ++k) {
        gather(x, term.stencil(stencils[first + k]), local_x);
        term.evaluate(stencils[first + k], local_x, order, locals[k]);
      }
    });
    for (int k = 0; k < size; ++k) {
      if (!locals[k].zero) scatter(term.stencil(stencils[first + k]), locals[k]);
    }
  }
}

/// Unknowns of a pair's four vertices: x_a = Σ_d part(a, d) u_d plus prescribed terms.
struct PairUnknowns {
  static constexpr int kMost = 8;  // two bodies, or up to three gel vertices and a body
  int count = 0;
  std::array<int, kMost> free;  // numbers among the free vertices
  Eigen::Matrix<double, 4, kMost> part = Eigen::Matrix<double, 4, kMost>::Zero();

  PairUnknowns(std::span<const int> stencil, const FreeVertices& all) {
    for (int a = 0; a < 4; ++a) {
      if (const int i = all.free_of_vertex[stencil[a]]; i >= 0) {
        part(a, index(i)) += 1.0;
      } else if (const CarriedBody* body = all.carrier(stencil[a])) {
        const int first = all.free_of_vertex[body->first_control_point];
        for (int k = 0; k < 4; ++k) part(a, index(first + k)) += body->weights(stencil[a] - body->first_vertex, k);
      }
    }
  }

 private:
  int index(int unknown) {
    for (int d = 0; d < count; ++d) {
      if (free[d] == unknown) return d;
    }
    free[count] = unknown;
    return count++;
  }
};

bool is_carried(std::span<const int> stencil, const FreeVertices& free) {
  return std::any_of(stencil.begin(), stencil.end(), [&](int v) { return free.carrier(v) != nullptr; });
}

}  // namespace

std::shared_ptr<const BlockPattern> mesh_pattern(const FreeVertices& free, const EnergyTerm& term) {
  std::vector<std::array<int, 2>> pairs;
  for (int s = 0; s < term.num_stencils(); ++s) {
    const std::span<const int> stencil = term.stencil(s);
    for (std::size_t i = 0; i < stencil.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const int a = free.free_of_vertex[stencil[i]], b = free.free_of_vertex[stencil[j]];
        if (a >= 0 && b >= 0) pairs.push_back({a, b});
      }
    }
  }
  return std::make_shared<BlockPattern>(make_block_pattern(free.size(), pairs, static_cast<int>(free.carried.size())));
}

std::shared_ptr<const BlockPattern> cover_contacts(std::shared_ptr<const BlockPattern> pattern,
                                                   const FreeVertices& free, int first_object_vertex,
                                                   const ContactTerm& term, const std::vector<int>& active,
                                                   const Positions& x) {
  const auto held_object = [&](int v) {
    return v >= first_object_vertex && free.free_of_vertex[v] < 0 && !free.carrier(v);
  };
  std::vector<std::array<int, 2>> missing;
  bool body_missing = false;
  Local local;
  Eigen::VectorXd local_x;
  for (const int i : active) {
    const auto stencil = term.stencil(i);
    // The vertices of the other side share an element.
    if (held_object(stencil.front()) || held_object(stencil.back())) continue;
    if (is_carried(stencil, free)) {
      const PairUnknowns of(stencil, free);
      for (int d = 0; d < of.count && !body_missing; ++d) {
        for (int e = 0; e < d; ++e)
          body_missing =
              body_missing || pattern->find(std::max(of.free[d], of.free[e]), std::min(of.free[d], of.free[e])) < 0;
      }
      continue;
    }
    bool covered = true;
    for (std::size_t a = 0; a < stencil.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const int p = free.free_of_vertex[stencil[a]], q = free.free_of_vertex[stencil[b]];
        covered = covered && (p < 0 || q < 0 || pattern->find(std::max(p, q), std::min(p, q)) >= 0);
      }
    }
    if (covered) continue;
    gather(x, stencil, local_x);
    term.evaluate(i, local_x, Order::value, local);
    if (local.zero) continue;
    for (std::size_t a = 0; a < stencil.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const int p = free.free_of_vertex[stencil[a]], q = free.free_of_vertex[stencil[b]];
        if (p >= 0 && q >= 0) missing.push_back({p, q});
      }
    }
  }
  for (int i = 0; body_missing && i < term.num_stencils(); ++i) {
    const auto stencil = term.stencil(i);
    if (!is_carried(stencil, free)) continue;
    const PairUnknowns of(stencil, free);
    for (int d = 0; d < of.count; ++d) {
      for (int e = 0; e < d; ++e) missing.push_back({of.free[d], of.free[e]});
    }
  }
  if (missing.empty()) return pattern;
  for (int c = 0; c < pattern->size(); ++c) {
    for (int k = pattern->column_start[c]; k < pattern->column_start[c + 1]; ++k)
      missing.push_back({c, pattern->row[k]});
  }
  return std::make_shared<BlockPattern>(make_block_pattern(pattern->size(), missing, pattern->num_bodies));
}

void clear(NewtonSystem& system, const FreeVertices& free, std::shared_ptr<const BlockPattern> pattern) {
  system.hessian.clear(std::move(pattern));
  clear_gradient(system, free);
}

void clear_gradient(NewtonSystem& system, const FreeVertices& free) {
  const Eigen::Index n = 3 * static_cast<Eigen::Index>(free.size());
  system.gradient.setZero(n);
  system.coupling.setZero(n);
  system.object_border.setZero(n, 3);
  system.object_hessian.setZero();
  system.object_gradient.setZero();
  system.object_coupling.setZero();
}

namespace {

/// Adds the derivatives of one stencil. \param wanted vertices whose blocks exist
template <typename Local>
void scatter(std::span<const int> stencil, PairVertices wanted, const Local& local, double weight,
             const FreeVertices& free, int first_object_vertex, const Positions& motion, NewtonSystem& system) {
  const int count = static_cast<int>(stencil.size());
  const auto is_wanted = [&](int k) { return k >= 4 || (wanted >> k & 1U); };
  for (int a = 0; a < count; ++a) {
    if (!is_wanted(a)) continue;
    const int i = free.free_of_vertex[stencil[a]];
    const bool object = i < 0 && stencil[a] >= first_object_vertex;
    if (i < 0 && !object) continue;
    if (object) {
      system.object_gradient += weight * local.gradient.template segment<3>(3 * a);
    } else {
      system.gradient.segment<3>(3 * i) += weight * local.gradient.template segment<3>(3 * a);
    }
    for (int b = 0; b < count; ++b) {
      if (!is_wanted(b)) continue;
      const int j = free.free_of_vertex[stencil[b]];
      const auto block = local.hessian.template block<3, 3>(3 * a, 3 * b);
      if (object) {
        if (j >= 0) continue;
        system.object_coupling += weight * block * motion.row(stencil[b]).transpose();
        if (stencil[b] >= first_object_vertex) system.object_hessian += weight * block;
      } else if (j < 0) {
        system.coupling.segment<3>(3 * i) += weight * block * motion.row(stencil[b]).transpose();
        if (stencil[b] >= first_object_vertex) system.object_border.middleRows<3>(3 * i) += weight * block;
      } else if (i >= j) {
        system.hessian.block(i, j) += weight * block;
      }
    }
  }
}

/// Adds a pair with a free body: g_d = Σ_a c_ad g_a, H_de = Σ_ab c_ad c_be H_ab.
void scatter_carried(std::span<const int> stencil, const PairLocal& local, double weight, const FreeVertices& free,
                     const Positions& motion, NewtonSystem& system) {
  const PairUnknowns of(stencil, free);
  std::array<Vector3, 4> prescribed;
  bool driven = false;
  for (int b = 0; b < 4; ++b) {
    const bool held = free.free_of_vertex[stencil[b]] < 0 && !free.carrier(stencil[b]);
    prescribed[b] = held ? Vector3(motion.row(stencil[b])) : Vector3::Zero();
    driven = driven || prescribed[b] != Vector3::Zero();
  }
  for (int d = 0; d < of.count; ++d) {
    Vector3 gradient = Vector3::Zero();
    Eigen::Matrix<double, 3, 12> rows = Eigen::Matrix<double, 3, 12>::Zero();
    for (int a = 0; a < 4; ++a) {
      const double part = weight * of.part(a, d);
      if (part == 0.0) continue;
      gradient += part * local.gradient.segment<3>(3 * a);
      rows += part * local.hessian.middleRows<3>(3 * a);
    }
    const int i = of.free[d];
    system.gradient.segment<3>(3 * i) += gradient;
    for (int b = 0; driven && b < 4; ++b)
      system.coupling.segment<3>(3 * i) += rows.middleCols<3>(3 * b) * prescribed[b];
    for (int e = 0; e < of.count; ++e) {
      if (of.free[e] > i) continue;
      Matrix3 block = Matrix3::Zero();
      for (int b = 0; b < 4; ++b) {
        if (of.part(b, e) != 0.0) block += of.part(b, e) * rows.middleCols<3>(3 * b);
      }
      system.hessian.block(i, of.free[e]) += block;
    }
  }
}

}  // namespace

void scatter_pair(std::span<const int> stencil, PairVertices wanted, const PairLocal& local, double weight,
                  const FreeVertices& free, int first_object_vertex, const Positions& motion, NewtonSystem& system) {
  if (!free.carried.empty() && is_carried(stencil, free))
    return scatter_carried(stencil, local, weight, free, motion, system);
  scatter(stencil, wanted, local, weight, free, first_object_vertex, motion, system);
}

namespace {

/// Adds masses of free vertices: multiples of the identity on the diagonal, without local matrices.
void assemble_masses(const Inertia& inertia, double weight, const Positions& x, const FreeVertices& free,
                     bool with_hessian, NewtonSystem& system) {
  for (int s = 0; s < inertia.num_stencils(); ++s) {
    const int v = inertia.stencil(s).front(), i = free.free_of_vertex[v];
    if (i < 0) continue;
    system.gradient.segment<3>(3 * i) += weight * inertia.gradient(s, x.row(v));
    if (with_hessian)
      system.hessian.block(system.hessian.pattern->column_start[i]).diagonal().array() += weight * inertia.mass_kg(s);
  }
}

const Inertia* inertia_of_gel(const WeightedTerm& weighted, int first_object_vertex) {
  const auto* inertia = dynamic_cast<const Inertia*>(weighted.term.get());
  return inertia && inertia->stencil(0).front() < first_object_vertex ? inertia : nullptr;
}

}  // namespace

bool has_constant_hessian(const WeightedTerm& weighted, int first_object_vertex) {
  return inertia_of_gel(weighted, first_object_vertex) || dynamic_cast<const ViscousMemory*>(weighted.term.get());
}

void add_gradient(const WeightedTerm& weighted, const Positions& x, const FreeVertices& free, NewtonSystem& system) {
  if (const auto* inertia = dynamic_cast<const Inertia*>(weighted.term.get()))
    return assemble_masses(*inertia, weighted.weight, x, free, false, system);
  const auto& memory = dynamic_cast<const ViscousMemory&>(*weighted.term);
  std::vector<TetCorners> found(std::min(kAtATime, static_cast<std::size_t>(memory.num_stencils())));
  for (int first = 0; first < memory.num_stencils(); first += static_cast<int>(found.size())) {
    const int count = std::min(static_cast<int>(found.size()), memory.num_stencils() - first);
    tbb::parallel_for(tbb::blocked_range<int>(0, count, kChunk), [&](const auto& range) {
      for (int k = range.begin(); k < range.end(); ++k)
        found[static_cast<std::size_t>(k)] = memory.gradient(first + k, x);
    });
    for (int k = 0; k < count; ++k) {
      const std::span<const int> stencil = memory.stencil(first + k);
      for (int a = 0; a < 4; ++a) {
        const int i = free.free_of_vertex[stencil[static_cast<std::size_t>(a)]];
        if (i >= 0) system.gradient.segment<3>(3 * i) += weighted.weight * found[static_cast<std::size_t>(k)].col(a);
      }
    }
  }
}

void add_inertia_coupling(const WeightedTerm& weighted, int first_object_vertex, const Positions& motion,
                          const FreeVertices& free, NewtonSystem& system) {
  const Inertia* inertia = inertia_of_gel(weighted, first_object_vertex);
  for (int s = 0; inertia && s < inertia->num_stencils(); ++s) {
    const int v = inertia->stencil(s).front(), i = free.free_of_vertex[v];
    if (i >= 0) system.coupling.segment<3>(3 * i) += weighted.weight * inertia->mass_kg(s) * motion.row(v).transpose();
  }
}

void assemble(const WeightedTerm& weighted, const Positions& x, const FreeVertices& free, int first_object_vertex,
              Order order, const Positions& motion, NewtonSystem& system) {
  if (const Inertia* inertia = inertia_of_gel(weighted, first_object_vertex))
    return assemble_masses(*inertia, weighted.weight, x, free, true, system);
  for_each_local(
      *weighted.term, all_stencils(*weighted.term), x, order, [&](std::span<const int> stencil, const Local& local) {
        scatter(stencil, kAllPairVertices, local, weighted.weight, free, first_object_vertex, motion, system);
      });
}

Positions gradient_of(const EnergyTerm& term, const Positions& x) {
  Positions gradient = Positions::Zero(x.rows(), 3);
  const auto add = [&](std::span<const int> stencil, const auto& local) {
    for (std::size_t a = 0; a < stencil.size(); ++a)
      gradient.row(stencil[a]) += local.template segment<3>(3 * static_cast<Eigen::Index>(a)).transpose();
  };
  const auto* contact = dynamic_cast<const ContactTerm*>(&term);
  if (!contact) {
    for_each_local(term, all_stencils(term), x, Order::gradient,
                   [&](std::span<const int> stencil, const Local& local) { add(stencil, local.gradient); });
    return gradient;
  }
  const std::vector<int> active = contact->active(x);
  struct Found {
    bool any;
    Vector12 gradient;
  };
  std::vector<Found> found(std::min(active.size(), kAtATime));
  for (std::size_t first = 0; first < active.size(); first += kAtATime) {
    const std::size_t count = std::min(kAtATime, active.size() - first);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kChunk), [&](const auto& range) {
      for (std::size_t k = range.begin(); k < range.end(); ++k) {
        const int i = active[first + k];
        const std::span<const int> v = term.stencil(i);
        found[k].any =
            contact->evaluate_gradient(i, {x.row(v[0]), x.row(v[1]), x.row(v[2]), x.row(v[3])}, found[k].gradient);
      }
    });
    for (std::size_t k = 0; k < count; ++k) {
      if (found[k].any) add(term.stencil(active[first + k]), found[k].gradient);
    }
  }
  return gradient;
}

}  // namespace tacipc
