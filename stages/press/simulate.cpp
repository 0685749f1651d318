#include "stages/press/simulate.h"

#include <cmath>

#include "common/error.h"
#include "common/log.h"
#include "stages/press/contact/intersection_check.h"

namespace tacipc {
namespace {

GelModel make_gel_model(const Sensor& sensor, const TetMesh& gel, int num_vertices) {
  const Material& material = sensor.material;
  auto elasticity = std::make_shared<Elasticity>(gel.positions, gel.tets,
                                                 NeoHookean{material.lame_mu_pa(), material.lame_lambda_pa()});
  std::vector<bool> fixed(static_cast<std::size_t>(num_vertices), false);
  for (int v = static_cast<int>(gel.num_vertices()); v < num_vertices; ++v) fixed[v] = true;
  for (const int v : gel.vertices(BoundaryTag::glued)) fixed[v] = true;
  Eigen::VectorXd mass_kg = lumped_masses(gel.tets, elasticity->rest(), gel.num_vertices(), material.density_kg_m3);
  return {gel.tets, std::move(elasticity), std::move(mass_kg), FreeVertices(num_vertices, fixed)};
}

/// Exact judgement of one frame.
void check_frame(int frame, const TetMesh& gel, const Positions& gel_positions, const TriangleMesh& object,
                 const Positions& object_positions) {
  const IntersectionReport report =
      find_intersections({gel_positions, gel.boundary}, {object_positions, object.triangles});
  if (!report.none()) {
    throw SolverError("frame {}: {} gel–object and {} gel–gel triangle pairs intersect", frame, report.gel_object,
                      report.gel_gel);
  }
  if (const auto inverted = count_inverted_tets(gel_positions, gel.tets); inverted > 0) {
    throw SolverError("frame {}: {} tetrahedra are inverted", frame, inverted);
  }
}

}  // namespace

Simulation simulate(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
                    const SampleSpec& sample, const std::string& default_face, const ProgressObserver& observe) {
  const Vector3 extent = gel.positions.colwise().maxCoeff() - gel.positions.colwise().minCoeff();
  const double diagonal_m = extent.norm();
  Simulation out;
  out.d_hat_m = config.relative_d_hat * diagonal_m;
  out.gap_horizon_m = 2.0 * config.start_gap_d_hat * out.d_hat_m;
  out.face = sample.face.value_or(default_face);
  const Placement placement{out.face, sample.rotate_rad, sample.center_x_m, sample.center_y_m};
  const double start_z_m = config.start_gap_d_hat * out.d_hat_m;
  const auto pose_at = [&](int frame) {
    const double t = static_cast<double>(frame) / sample.steps;
    return place(object.positions, placement, (1.0 - t) * start_z_m - t * sample.depth_m);
  };
  if (sample.depth_m >= sensor.gel.thickness_m) {
    throw DataError("depth {:.3g} mm is not less than the gel's thickness {:.3g} mm", 1e3 * sample.depth_m,
                    1e3 * sensor.gel.thickness_m);
  }

  const Positions object_start = transformed(pose_at(0), object.positions);
  const ContactMesh mesh = make_contact_mesh(gel.positions, gel.boundary, object_start, object.triangles);
  const NewtonSettings newton{.velocity_tolerance_m_s = config.relative_velocity_tolerance * diagonal_m,
                              .relative_force_tolerance = config.relative_force_tolerance,
                              .force_tolerance_n = config.force_tolerance_n,
                              .max_iterations = config.max_newton_iterations};
  GelModel model = make_gel_model(sensor, gel, mesh.num_vertices());
  const auto elasticity = model.elasticity;
  TimeStepper stepper(mesh, std::move(model), config.time_step_s, out.d_hat_m, config.barrier_stiffness, newton);

  Positions x = mesh.rest_positions;
  Positions velocity = Positions::Zero(gel.num_vertices(), 3);
  const auto save = [&](int index, const Positions& object_positions, const StepReport& report) {
    Frame frame;
    frame.positions = x.topRows(gel.num_vertices());
    frame.gel_from_object = pose_at(index);
    frame.contact_force = stepper.contact_forces(x);
    for (Eigen::Index v = 0; v < gel.num_vertices(); ++v) {
      const Vector3 force = frame.contact_force.row(v), arm = frame.positions.row(v);
      frame.force_n += force;
      frame.torque_n_m += arm.cross(force);
    }
    frame.mount_force_n = stepper.mount_forces(x).colwise().sum();
    frame.min_gap_m = stepper.smallest_gap(x, out.gap_horizon_m);
    frame.min_volume_ratio = min_volume_ratio(frame.positions, gel.tets, elasticity->rest());
    frame.solver = report;
    check_frame(index, gel, frame.positions, object, object_positions);
    log_info("frame {}/{}: force {:.4f} N, {} Newton iterations, smallest gap {:.3g} um, smallest volume ratio {:.3f}",
             index, sample.steps, 0.0 - frame.force_n.z(), report.newton_iterations, 1e6 * frame.min_gap_m,
             frame.min_volume_ratio);
    out.frames.push_back(std::move(frame));
  };

  save(0, object_start, {});
  if (out.frames[0].min_gap_m <= out.d_hat_m) {
    throw DataError("the object is {:.3g} m from the gel in frame 0, nearer than the barrier's reach {:.3g} m",
                    out.frames[0].min_gap_m, out.d_hat_m);
  }
  for (int index = 1; index <= sample.steps; ++index) {
    const Positions target = transformed(pose_at(index), object.positions);
    StepReport report;
    try {
      report = stepper.advance(x, velocity, target, [&](int iteration, double residual) {
        observe(index, sample.steps, iteration, residual);
      });
    } catch (const SolverError& error) {
      throw SolverError("frame {}: {}", index, error.what());
    }
    save(index, target, report);
  }
  out.symbolic_analyses = stepper.num_analyses();
  return out;
}

}  // namespace tacipc
