#include "stages/rival/mpm/material_points.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "common/base/error.h"
#include "common/base/flush_denormals.h"

namespace tacipc {
namespace {

/// Largest move per step, in cells, for a step that is short enough.
constexpr double kLargestMove = 0.5;
/// Half a cell below the limit of the tiles, because cells are computed from rounded numbers.
constexpr double kDriftBeforeSorting = kDrift - 0.5;

/// Calls work(tile) for every tile, one colour of tiles at a time, so that concurrent tiles share no node.
template <typename Work>
void for_each_tile_by_color(const Slab& slab, const Work& work) {
  for (int color = 0; color < 4; ++color) {
    const int first_x = color / 2, first_y = color % 2;
    const int count_x = (slab.tiles[0] - first_x + 1) / 2, count_y = (slab.tiles[1] - first_y + 1) / 2;
    tbb::parallel_for(0, std::max(0, count_x * count_y), [&](int i) {
      const FlushDenormals flush;
      work((first_x + 2 * (i / count_y)) * slab.tiles[1] + first_y + 2 * (i % count_y));
    });
  }
}

}  // namespace

double MpmSetup::wave_speed_m_s() const { return std::sqrt((lambda_pa + 2.0 * mu_pa) / density_kg_m3); }

MaterialPoints::MaterialPoints(const Positions& rest_m, const MpmSetup& setup)
    : setup_(setup), num_particles_(static_cast<int>(rest_m.rows())) {
  assert(num_particles_ > 0);
  const double scale =
      4.0 * setup.step_s * setup.step_s / (setup.density_kg_m3 * setup.grid_spacing_m * setup.grid_spacing_m);
  material_ = {static_cast<float>(scale * setup.mu_pa), static_cast<float>(scale * setup.lambda_pa)};
  sorted_.packs.resize((static_cast<std::size_t>(num_particles_) + kParticleLanes - 1) / kParticleLanes);
  for (int i = 0; i < static_cast<int>(sorted_.packs.size()) * kParticleLanes; ++i) {
    ParticlePack& pack = sorted_.packs[i / kParticleLanes];
    const int l = i % kParticleLanes;
    if (l == 0) pack = ParticlePack{};
    pack.id[l] = i < num_particles_ ? i : -1;
    for (int k = 0; k < 9; k += 4) pack.deformation[k][l] = 1.0f;
    for (int axis = 0; axis < 3 && i < num_particles_; ++axis)
      pack.rest[axis][l] = static_cast<float>((rest_m(i, axis) - setup.grid_origin_m[axis]) / setup.grid_spacing_m);
  }
  sort();
}

void MaterialPoints::place_object(const Positions& points_m, const Matrix4& gel_from_object) {
  object_m_ = points_m;
  gel_from_object_ = gel_from_object;
  object_points(gel_from_object, object_now_);
  sort();
}

void MaterialPoints::object_points(const Matrix4& gel_from_object, std::vector<std::array<double, 3>>& points) const {
  points.resize(object_m_.rows());
  const Matrix3 rotation = gel_from_object.topLeftCorner<3, 3>() / setup_.grid_spacing_m;
  const Vector3 shift = (gel_from_object.topRightCorner<3, 1>() - setup_.grid_origin_m) / setup_.grid_spacing_m;
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, object_m_.rows(), 4096), [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      const Vector3 at = rotation * object_m_.row(i).transpose() + shift;
      points[i] = {at.x(), at.y(), at.z()};
    }
  });
}

void MaterialPoints::sort() {
  const double held = setup_.held_below_m ? (*setup_.held_below_m - setup_.grid_origin_m.z()) / setup_.grid_spacing_m
                                          : -std::numeric_limits<double>::infinity();
  sorted_ = sort_particles(sorted_.packs, held);
  drift_ = 0.0;
  ++num_sorts_;
  std::vector<int> tile_of(object_now_.size());
  first_near_point_.assign(static_cast<std::size_t>(sorted_.slab.num_tiles()) + 1, 0);
  for (std::size_t i = 0; i < tile_of.size(); ++i) {
    tile_of[i] = tile_of_point(sorted_.slab, object_now_[i]);
    if (tile_of[i] >= 0) ++first_near_point_[static_cast<std::size_t>(tile_of[i]) + 1];
  }
  for (std::size_t t = 1; t < first_near_point_.size(); ++t) first_near_point_[t] += first_near_point_[t - 1];
  near_points_.resize(first_near_point_.back());
  std::vector<int> next(first_near_point_.begin(), first_near_point_.end() - 1);
  for (std::size_t i = 0; i < tile_of.size(); ++i)
    if (tile_of[i] >= 0) near_points_[next[tile_of[i]]++] = static_cast<int>(i);
}

double MaterialPoints::move_object(const Matrix4& gel_from_object) {
  object_points(gel_from_object, object_next_);
  double largest = 0.0;
  for (std::size_t i = 0; i < object_now_.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      largest = std::max(largest, std::abs(object_next_[i][axis] - object_now_[i][axis]));
  if (!(largest <= kLargestMove))
    throw SolverError("the object moves {:.3g} cells of the grid in one step (at most {})", largest, kLargestMove);
  if (drift_ > kDriftBeforeSorting) sort();
  moving_.resize(near_points_.size());
  for (std::size_t i = 0; i < near_points_.size(); ++i) {
    const auto& now = object_now_[near_points_[i]];
    const auto& next = object_next_[near_points_[i]];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      moving_[i].position[axis] = static_cast<float>(now[axis] - sorted_.slab.origin[axis]);
      moving_[i].velocity[axis] = static_cast<float>(next[axis] - now[axis]);
    }
  }
  std::swap(object_now_, object_next_);
  gel_from_object_ = gel_from_object;
  return largest;
}

void MaterialPoints::step(const Matrix4& gel_from_object) {
  const double object_move = move_object(gel_from_object);
  Slab& slab = sorted_.slab;
  const auto columns = static_cast<std::size_t>(slab.nodes[0]) * slab.nodes[1];
  const tbb::blocked_range<std::size_t> all_columns(0, columns, 256);
  const auto column = 4 * static_cast<std::size_t>(slab.nodes[2]);
  tbb::parallel_for(all_columns, [&](const auto& range) {
    std::fill(slab.values.begin() + static_cast<std::ptrdiff_t>(range.begin() * column),
              slab.values.begin() + static_cast<std::ptrdiff_t>(range.end() * column), 0.0f);
  });
  const auto object_mass = static_cast<float>(setup_.object_mass_ratio);
  for_each_tile_by_color(slab, [&](int t) {
    const TilePacks& tile = sorted_.tiles[t];
    const int first = first_near_point_[t], last = first_near_point_[static_cast<std::size_t>(t) + 1];
    scatter(sorted_.packs.data() + tile.first, tile.count, material_, slab);
    scatter(moving_.data() + first, last - first, object_mass, slab);
  });
  const auto keep = static_cast<float>(1.0 - setup_.damping_per_s * setup_.step_s);
  tbb::parallel_for(all_columns, [&](const auto& range) {
    const FlushDenormals flush;
    update_nodes(slab, range.begin(), range.end(), keep);
  });
  std::vector<float> speeds(sorted_.tiles.size());
  tbb::parallel_for(std::size_t{0}, sorted_.tiles.size(), [&](std::size_t t) {
    const FlushDenormals flush;
    const TilePacks& tile = sorted_.tiles[t];
    speeds[t] = gather(sorted_.packs.data() + tile.first, tile.count, slab, setup_.num_fixed).largest_speed_squared;
  });
  ++num_steps_;
  largest_speed_ = std::sqrt(static_cast<double>(*std::ranges::max_element(speeds)));
  drift_ += std::max(object_move, largest_speed_);
  if (!(largest_speed_ <= kLargestMove))
    throw SolverError(
        "step {}: particles move {:.3g} cells of the grid in one step (at most {}): the step of {:.3g} s is too long "
        "for this grid and material",
        num_steps_, largest_speed_, kLargestMove, setup_.step_s);
}

template <typename Visit>
void MaterialPoints::for_each_particle(const Visit& visit) const {
  for (const ParticlePack& pack : sorted_.packs)
    for (int l = 0; l < kParticleLanes && pack.id[l] >= 0; ++l) visit(pack, l);
}

Positions MaterialPoints::shifts_m(int first, int count) const {
  Positions shifts(count, 3);
  for_each_particle([&](const ParticlePack& pack, int l) {
    const int row = pack.id[l] - first;
    if (row < 0 || row >= count) return;
    for (int axis = 0; axis < 3; ++axis)
      shifts(row, axis) = metres_per_cell() * static_cast<double>(pack.shift[axis][l]);
  });
  return shifts;
}

double MaterialPoints::deepest_m(int first) const {
  float lowest = 0.0f;
  for (const ParticlePack& pack : sorted_.packs)
    for (int l = 0; l < kParticleLanes; ++l)
      if (pack.id[l] >= first) lowest = std::min(lowest, pack.shift[2][l]);
  return 0.0 - metres_per_cell() * static_cast<double>(lowest);
}

void MaterialPoints::set_packs(std::vector<ParticlePack> packs) {
  sorted_.packs = std::move(packs);
  sort();
}

Vector3 MaterialPoints::momentum() const {
  Vector3 sum = Vector3::Zero();
  for_each_particle([&](const ParticlePack& pack, int l) {
    for (int axis = 0; axis < 3; ++axis) sum[axis] += static_cast<double>(pack.velocity[axis][l]);
  });
  return setup_.particle_mass_kg() * metres_per_cell() / setup_.step_s * sum;
}

double MaterialPoints::kinetic_energy_j() const {
  double sum = 0.0;
  for_each_particle([&](const ParticlePack& pack, int l) {
    for (int axis = 0; axis < 3; ++axis)
      sum += static_cast<double>(pack.velocity[axis][l]) * static_cast<double>(pack.velocity[axis][l]);
  });
  const double cells_to_m_s = metres_per_cell() / setup_.step_s;
  return 0.5 * setup_.particle_mass_kg() * cells_to_m_s * cells_to_m_s * sum;
}

}  // namespace tacipc
