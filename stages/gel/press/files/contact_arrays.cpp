#include "stages/gel/press/files/contact_arrays.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "common/sample/press_folder.h"
#include "stages/gel/press/measure/front_traction.h"
#include "stages/gel/press/measure/traction_grid.h"

namespace tacipc {
namespace {

/// Time at which each front vertex first slips; +∞ if it never does.
std::vector<double> first_slip_s(const Simulation& simulation) {
  std::vector<double> first(simulation.front.vertices.size(), std::numeric_limits<double>::infinity());
  for (const Frame& frame : simulation.frames) {
    for (std::size_t v = 0; v < first.size(); ++v) {
      if (frame.contact_state[v] == ContactState::slip) first[v] = std::min(first[v], frame.time_s);
    }
  }
  return first;
}

}  // namespace

void write_contact(const ArrayWriter& writer, const Sensor& sensor, const Simulation& simulation) {
  const auto& frames = simulation.frames;
  const FrontSurface& front = simulation.front;
  writer.write(PressArray::front_vertices, {front.vertices.begin(), front.vertices.end()});
  writer.write(PressArray::contact_force, frames, [](const Frame& f) {
    return ContactParts{f.normal_force_n, f.friction_force_n};
  });
  writer.write(PressArray::contact_state, frames, [](const Frame& f) { return f.contact_state; });
  writer.write(PressArray::first_slip, first_slip_s(simulation));
  const TractionGrid grid = TractionGrid::over_window(sensor.camera);
  writer.write(PressArray::traction, frames, [&](const Frame& f) {
    return spread_traction(grid, front, on_front(front, f.positions), f.normal_force_n, f.friction_force_n);
  });
}

void write_stress(const ArrayWriter& writer, const TetMesh& gel, const Simulation& simulation) {
  const auto& frames = simulation.frames;
  const FrontSurface& front = simulation.front;
  if (frames[0].stress_pa.rows() == 0) return;
  writer.write(PressArray::stress, frames, &Frame::stress_pa);
  const std::vector<int> behind = tets_behind(front, gel.tets);
  std::vector<double> pressure_pa, shear_pa;
  for (const Frame& f : frames) {
    const Positions x = on_front(front, f.positions);
    const FrontTraction of_forces = traction_of_forces(front, x, f.normal_force_n + f.friction_force_n);
    const FrontTraction of_stress = traction_of_stress(front, x, f.stress_pa, behind);
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      for (const FrontTraction* of : {&of_forces, &of_stress}) {
        pressure_pa.push_back(of->pressure[v]);
        append_numbers(shear_pa, of->shear.row(v));
      }
    }
  }
  writer.write(PressArray::front_pressure, pressure_pa);
  writer.write(PressArray::front_shear, shear_pa);
}

}  // namespace tacipc
