#include "stages/rival/mpm/run_motion.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/sample/placement.h"
#include "stages/rival/mpm/object_points.h"

namespace tacipc {
namespace {

/// Largest displacement of any point of the object between two poses. The distance is convex, so it occurs at a vertex.
double travel(const Positions& vertices, const Matrix4& from, const Matrix4& to) {
  return (transformed(to, vertices) - transformed(from, vertices)).rowwise().norm().maxCoeff();
}

class Motion {
 public:
  Motion(const MpmScene& scene, double speed_factor, const MpmObserver& observe)
      : scene_(scene),
        speed_factor_(speed_factor),
        observe_(observe),
        points_(scene.lattice.rest_m, scene.setup),
        placed_(place(scene.object.positions,
                      {scene.face, scene.sample.rotate_rad, scene.sample.center_x_m, scene.sample.center_y_m},
                      scene.config.object.start_gap_m)),
        pose_(placed_) {
    for (const Phase& phase : scene.sample.motion) num_frames_ += phase.steps;
    points_.place_object(scene.object_points_m, placed_);
  }

  MpmRun run() {
    save(PhaseKind::reference, -1);
    for (std::size_t p = 0; p < scene_.sample.motion.size(); ++p) {
      const Phase& phase = scene_.sample.motion[p];
      const PhaseStart start =
          phase_start(scene_.sample, scene_.object.positions, placed_, pose_, scene_.config.object.start_gap_m);
      const double start_depth_m = gel_depth_m();
      const bool to_depth = phase.kind == PhaseKind::press && scene_.config.depth_of_gel;
      if (to_depth && !(phase.depth_m > start_depth_m))
        throw DataError("a press to {:.3g} mm begins where the gel is {:.3g} mm deep", 1e3 * phase.depth_m,
                        1e3 * start_depth_m);
      for (int index = 1; index <= phase.steps; ++index) {
        if (to_depth)
          press_until(start_depth_m + (phase.depth_m - start_depth_m) * index / phase.steps);
        else
          follow(phase, start, index);
        save(phase.kind, static_cast<int>(p));
      }
    }
    out_.sorts = points_.num_sorts();
    out_.grid_nodes = points_.num_nodes();
    return std::move(out_);
  }

 private:
  double step_s() const { return scene_.setup.step_s; }
  double gel_depth_m() const { return points_.deepest_m(scene_.lattice.first_of_top()); }
  double lowest_m() const { return transformed(pose_, scene_.object.positions).col(2).minCoeff(); }

  void step_to(const Matrix4& pose) {
    out_.object_speed_m_s = std::max(out_.object_speed_m_s, travel(scene_.object.positions, pose_, pose) / step_s());
    points_.step(pose);
    pose_ = pose;
    out_.particle_speed_m_s = std::max(out_.particle_speed_m_s, points_.largest_speed_m_s());
  }

  void report_progress(double depth_m) const {
    constexpr int kStepsBetweenMessages = 16;
    if (points_.num_steps() % kStepsBetweenMessages == 0)
      observe_(static_cast<int>(out_.frames.size()), num_frames_, points_.num_steps(), depth_m);
  }

  /// Moves straight down until a check (at least one) finds the gel's front at that depth, by the frame's criterion.
  void press_until(double depth_m) {
    const double down_m = scene_.config.object.press_speed_m_s * speed_factor_ * step_s();
    double reached_m = 0.0;
    do {
      for (int s = 0; s < scene_.config.check_every; ++s) {
        Matrix4 pose = pose_;
        pose(2, 3) -= down_m;
        step_to(pose);
      }
      reached_m = gel_depth_m();
      report_progress(reached_m);
      if (const double lowest = lowest_m(); lowest < -scene_.lattice.thickness_m)
        throw SolverError("the object is {:.3g} mm deep, through the gel, whose front is {:.3g} mm deep", -1e3 * lowest,
                          1e3 * reached_m);
    } while (reached_m < depth_m - scene_.config.frame_within_m);
  }

  /// Moves along the phase's path to its frame `index`, in even steps.
  void follow(const Phase& phase, const PhaseStart& start, int index) {
    // A path's goals are counted in the phase's own time steps; their duration is not used.
    const auto goal = [&](double frames) {
      return goal_of(phase, frames * phase.substeps, start, 0.0).gel_from_object;
    };
    const bool vertical = phase.kind == PhaseKind::press || phase.kind == PhaseKind::release;
    const auto& object = scene_.config.object;
    const double speed = speed_factor_ * (vertical ? object.press_speed_m_s : object.move_speed_m_s);
    const double travel_m = travel(scene_.object.positions, pose_, goal(index));
    const double duration_s = travel_m > 0.0 ? travel_m / speed : scene_.config.hold_frame_s / speed_factor_;
    const int steps = std::max(1, static_cast<int>(std::ceil(duration_s / step_s() - 1e-9)));
    for (int s = 1; s <= steps; ++s) {
      step_to(goal(index - 1 + static_cast<double>(s) / steps));
      report_progress(0.0);
    }
  }

  void save(PhaseKind phase, int phase_index) {
    MpmFrame frame{.time_s = points_.num_steps() * step_s(),
                   .phase = phase,
                   .phase_index = phase_index,
                   .gel_from_object = pose_,
                   .front_m = front_at_rest(scene_.lattice) +
                              points_.shifts_m(scene_.lattice.first_of_top(), scene_.lattice.num_columns()),
                   .gel_depth_m = gel_depth_m(),
                   .object_depth_m = 0.0 - lowest_m(),
                   .momentum_kg_m_s = points_.momentum(),
                   .kinetic_energy_j = points_.kinetic_energy_j(),
                   .steps = points_.num_steps()};
    touched_ = touched_ || frame.kinetic_energy_j > 0.0;
    if (phase == PhaseKind::press && !touched_) frame.phase = PhaseKind::approach;
    log_info("frame {}/{} {}: step {}, gel {:.4f} mm deep, object {:.4f} mm", out_.frames.size(), num_frames_,
             name_of(frame.phase), frame.steps, 1e3 * frame.gel_depth_m, 1e3 * frame.object_depth_m);
    out_.frames.push_back(std::move(frame));
  }

  const MpmScene& scene_;
  double speed_factor_;
  const MpmObserver& observe_;
  MaterialPoints points_;
  Matrix4 placed_, pose_;
  int num_frames_ = 0;
  bool touched_ = false;
  MpmRun out_;
};

}  // namespace

double MpmScene::points_per_m2() const { return static_cast<double>(object_points_m.rows()) / surface_area(object); }

MpmScene make_scene(const MpmConfig& config, const Sensor& sensor, const SampleSpec& sample, const TriangleMesh& object,
                    const std::string& default_face) {
  MpmScene scene{.config = config,
                 .sample = sample,
                 .face = sample.face.value_or(default_face),
                 .lattice = make_gel_lattice(config.gel, sensor.gel),
                 .setup = {},
                 .object = object,
                 .object_points_m = {}};
  for (const Phase& phase : sample.motion) {
    if (phase.kind == PhaseKind::free)
      throw UsageError("the sample lets the object go; mpm moves it by prescribed motions only");
    if (phase.load_n)
      throw UsageError("the sample loads the object with a force; mpm moves it by prescribed motions only");
    if (phase.kind == PhaseKind::press && phase.depth_m >= scene.lattice.thickness_m)
      throw DataError("depth {:.3g} mm is not less than the gel's thickness {:.3g} mm", 1e3 * phase.depth_m,
                      1e3 * scene.lattice.thickness_m);
  }
  Material material = sensor.material;
  material.density_kg_m3 = config.density_kg_m3.value_or(material.density_kg_m3);
  material.youngs_modulus_pa = config.youngs_modulus_pa.value_or(material.youngs_modulus_pa);
  material.poissons_ratio = config.poissons_ratio.value_or(material.poissons_ratio);
  MpmSetup& setup = scene.setup;
  setup.grid_spacing_m = config.grid_spacing_m;
  setup.grid_origin_m = config.grid_origin_m.value_or(Vector3(0.0, 0.0, -scene.lattice.thickness_m));
  setup.mu_pa = material.lame_mu_pa();
  setup.lambda_pa = material.lame_lambda_pa();
  setup.density_kg_m3 = material.density_kg_m3;
  setup.particle_volume_m3 = config.gel.volume_m3.value_or(std::pow(config.gel.spacing_m, 3));
  setup.step_s = config.step_s.value_or(config.courant * config.grid_spacing_m / setup.wave_speed_m_s());
  setup.damping_per_s = config.damping_per_s;
  setup.object_mass_ratio = config.object.mass_ratio;
  if (config.gel.fixed_layers)
    setup.num_fixed = *config.gel.fixed_layers * scene.lattice.num_columns();
  else
    setup.held_below_m = -scene.lattice.thickness_m;
  if (setup.damping_per_s * setup.step_s >= 1.0)
    throw UsageError("damping_per_s: takes more than all velocity in one step");
  const double wanted = std::ceil(config.object.samples_per_m2 * surface_area(object));
  constexpr double kMaxPoints = 1e8;
  if (!(wanted <= kMaxPoints)) throw DataError("the object's surface would get {:.3g} points", wanted);
  scene.object_points_m = sample_surface(object, std::max(1, static_cast<int>(wanted)), config.object.seed);
  return scene;
}

MpmRun run_motion(const MpmScene& scene, double speed_factor, const MpmObserver& observe) {
  return Motion(scene, speed_factor, observe).run();
}

}  // namespace tacipc
