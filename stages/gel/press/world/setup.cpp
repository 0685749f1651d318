#include "stages/gel/press/world/setup.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/sensor/averaged_volume.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/energy/joined_term.h"
#include "stages/gel/press/measure/front_surface.h"

namespace tacipc {
namespace {

/// Barrier stiffness κ = c h² E ℓ² / d̂³ in kg m⁻², as stiff as the gel below. At a given d/d̂ the force of a pair is
/// about κ d̂³/h² (from ∂/∂d of κ/h² b(d²), b of barrier.h), and a vertex of the gel is pressed in by about E ℓ². Their
/// ratio c is the same for any gel, mesh and d̂.
double balanced_barrier_stiffness(const PressConfig& config, const Material& material, const Scales& scales) {
  const double h = config.time_step_s, l = scales.front_edge_m, d = scales.d_hat_m;
  return config.relative_barrier_stiffness * h * h * material.youngs_modulus_pa * l * l / (d * d * d);
}

/// Material law of a body and its element.
struct Elastic {
  ElasticLaw law;
  Element kind;
};

Elastic elastic_of(const DeformableBody& body) {
  const Material& m = body.material;
  return {make_elastic_law(m.law, m.lame_mu_pa(), m.lame_lambda_pa()),
          body.element == "averaged_volume" ? Element::averaged_volume : Element::linear};
}

}  // namespace

Scales scales_of(const PressConfig& config, const Sensor& sensor, const TetMesh& gel) {
  Scales scales;
  scales.front_edge_m = median_front_edge_m(gel);
  scales.diagonal_m = (gel.positions.colwise().maxCoeff() - gel.positions.colwise().minCoeff()).norm();
  scales.d_hat_m = config.relative_d_hat * scales.diagonal_m;
  scales.gap_horizon_m = 2.0 * config.start_gap_d_hat * scales.d_hat_m;
  scales.start_gap_m = config.start_gap_d_hat * scales.d_hat_m;
  scales.barrier_stiffness =
      config.barrier_stiffness.value_or(balanced_barrier_stiffness(config, sensor.material, scales));
  return scales;
}

std::string element_of(const PressConfig& config, const Material& material) {
  if (config.element != "auto") return config.element;
  return material.poissons_ratio >= kAveragedVolumeFrom ? "averaged_volume" : "linear";
}

GelModel make_gel_model(const std::vector<DeformableBody>& bodies) {
  std::vector<TetMesh> meshes;
  for (const DeformableBody& body : bodies) meshes.push_back(body.mesh);
  const TetMesh all = meshes.size() == 1 ? std::move(meshes.front()) : joined(meshes);
  GelModel model{.elasticity = nullptr,
                 .tets = all.tets,
                 .mass_kg = Eigen::VectorXd(all.num_vertices()),
                 .glued = all.vertices(BoundaryTag::glued)};
  std::vector<std::shared_ptr<const EnergyTerm>> elastic;
  std::vector<Viscoelasticity::Body> viscous;
  bool relaxes = false;
  Eigen::Index first_vertex = 0, first_tet = 0;
  for (const DeformableBody& body : bodies) {
    const auto& [material, element, mesh] = body;
    const auto [law, kind] = elastic_of(body);
    const Tetrahedra tets = all.tets.middleRows(first_tet, mesh.num_tets());
    elastic.push_back(make_elasticity(all.positions, tets, law, kind));
    model.mass_kg.segment(first_vertex, mesh.num_vertices()) = lumped_masses(
        mesh.tets, make_rest_tets(mesh.positions, mesh.tets), mesh.num_vertices(), material.density_kg_m3);
    viscous.push_back({.series = material.relaxation, .stress = std::nullopt});
    if (!material.relaxation.empty()) {
      relaxes = true;
      viscous.back().stress = make_tet_stress(all.positions, tets, law, kind);
    }
    first_vertex += mesh.num_vertices();
    first_tet += mesh.num_tets();
  }
  model.elasticity = elastic.size() == 1 ? elastic.front() : std::make_shared<JoinedTerm>(std::move(elastic));
  if (relaxes) model.viscoelasticity = std::make_shared<Viscoelasticity>(viscous);
  return model;
}

TetStress tet_stress_of(const DeformableBody& body) {
  const auto [law, kind] = elastic_of(body);
  return make_tet_stress(body.mesh.positions, body.mesh.tets, law, kind);
}

StepSettings step_settings(const PressConfig& config, const Scales& scales) {
  StepSettings settings{.laws = ContactLaws({config.coefficient_of_friction(), scales.d_hat_m}),
                        .front_edge_m = scales.front_edge_m,
                        .barrier_stiffness_j_m4 = scales.barrier_stiffness / (config.time_step_s * config.time_step_s),
                        .adaptive_barrier = config.adaptive_barrier_stiffness,
                        .pair_counting = config.pair_counting,
                        .quasi_static = config.quasi_static,
                        .augmented_lagrangian = config.augmented_lagrangian,
                        .gravity_m_s2 = config.gravity_m_s2,
                        .mass_damping_per_s = config.mass_damping_per_s,
                        .stiffness_damping_s = config.stiffness_damping_s,
                        .linear_solver = config.linear_solver,
                        .newton = config.newton};
  settings.newton.velocity_tolerance_m_s = config.relative_velocity_tolerance * scales.diagonal_m;
  if (config.coefficient_of_friction() > 0.0) settings.friction = friction_settings(*config.friction, scales);
  return settings;
}

FrictionSettings friction_settings(const FrictionConfig& friction, const Scales& scales) {
  return {.speed_threshold_m_s = friction.relative_speed_threshold * scales.diagonal_m,
          .max_lag_iterations = friction.iterated ? friction.max_lag_iterations : 1,
          .renewed_only_at_minima = friction.only_at_minima,
          .relative_lag_tolerance = friction.relative_lag_tolerance};
}

bool check_object(const TriangleMesh& object, const PressConfig& config) {
  std::vector<std::array<int, 2>> edges;
  for (Eigen::Index t = 0; t < object.num_triangles(); ++t)
    for (int k = 0; k < 3; ++k) edges.push_back({object.triangles(t, k), object.triangles(t, (k + 1) % 3)});
  std::sort(edges.begin(), edges.end());
  const auto alone = std::find_if(edges.begin(), edges.end(), [&](const std::array<int, 2>& edge) {
    return !std::binary_search(edges.begin(), edges.end(), std::array<int, 2>{edge[1], edge[0]});
  });
  const bool closed = alone == edges.end();
  if (!config.pair_counting.once) return closed;
  if (!closed)
    throw DataError(
        "the object is not closed: the edge of its vertices {} and {} is not between two faces that look the same way "
        "(barrier.pairs: once counts on it)",
        (*alone)[0], (*alone)[1]);
  if (!(signed_volume(object) > 0.0))
    throw DataError("the object's faces look inwards (barrier.pairs: once counts on their looking outwards)");
  return true;
}

void require_rigid_mount(const Sensor& sensor) {
  if (sensor.mount.gives_way())
    throw UsageError(
        fmt::format("{}: a mount that gives way is for single presses, not for grasps and scenes; leave the section "
                    "mount out",
                    sensor.name));
}

void check_motion(const SampleSpec& sample, const Sensor& sensor, const PressConfig& config) {
  for (const Phase& phase : sample.motion) {
    if (phase.kind == PhaseKind::press && phase.depth_m >= sensor.gel.thickness_m) {
      throw DataError("depth {:.3g} mm is not less than the gel's thickness {:.3g} mm", 1e3 * phase.depth_m,
                      1e3 * sensor.gel.thickness_m);
    }
  }
  if (config.augmented_lagrangian && std::any_of(sample.motion.begin(), sample.motion.end(),
                                                 [](const Phase& phase) { return phase.load_n.has_value(); }))
    throw UsageError(
        "constraints: augmented_lagrangian holds the object to its pose; a load or a free object needs elimination");
  if (sensor.mount.gives_way()) {
    if (config.augmented_lagrangian)
      throw UsageError(
          "constraints: augmented_lagrangian holds the object to its pose; a mount that gives way needs elimination");
    if (std::any_of(sample.motion.begin(), sample.motion.end(),
                    [](const Phase& phase) { return phase.kind == PhaseKind::free; }))
      throw UsageError(
          fmt::format("{}: its mount gives way to a held object, not to one that is free; leave the section mount out",
                      sensor.name));
  }
  const bool weightless = config.gravity_m_s2 == Vector3::Zero();
  for (const Phase& phase : sample.motion) {
    if (phase.kind == PhaseKind::free && weightless && phase.load_n == Vector3::Zero()) {
      log_warning(
          "the object is free, but has neither weight nor load: gravity_m_s2 is 0 and the phase has no force_n");
      break;
    }
  }
}

}  // namespace tacipc
