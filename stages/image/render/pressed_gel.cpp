#include "stages/image/render/pressed_gel.h"

#include <Eigen/Geometry>

#include "common/base/error.h"

namespace tacipc {
namespace {

using enum PressArray;

/// \throw DataError unless frame 0 is the gel at rest
void check_rest(const PressFolder& press, const TetMesh& gel) {
  Eigen::Index worst = 0;
  const double distance = (press.positions(0) - gel.positions).rowwise().norm().maxCoeff(&worst);
  if (distance > 1e-6) {
    throw DataError("{}: frame 0 is not the gel at rest: vertex {} is {:.3g} mm away from its place in the gel",
                    press.path(PressArray::positions).string(), worst, 1e3 * distance);
  }
}

/// Traction of one frame on the membrane's vertices, Pa: normal plus friction force over the vertex's share of the
/// deformed area, a third of each triangle around it.
Positions traction_of(const ContactParts& forces_n, const Membrane& membrane) {
  const Eigen::Index count = membrane.positions.rows();
  Eigen::VectorXd area = Eigen::VectorXd::Zero(count);
  for (Eigen::Index f = 0; f < membrane.triangles.rows(); ++f) {
    const Vector3 a = membrane.positions.row(membrane.triangles(f, 0)).transpose();
    const Vector3 b = membrane.positions.row(membrane.triangles(f, 1)).transpose();
    const Vector3 c = membrane.positions.row(membrane.triangles(f, 2)).transpose();
    const double third = (b - a).cross(c - a).norm() / 6.0;
    for (int k = 0; k < 3; ++k) area[membrane.triangles(f, k)] += third;
  }
  Positions traction_pa = Positions::Zero(count, 3);
  for (Eigen::Index v = 0; v < count; ++v) {
    if (area[v] > 0.0) traction_pa.row(v) = (forces_n.normal.row(v) + forces_n.friction.row(v)) / area[v];
  }
  return traction_pa;
}

}  // namespace

PressedGel::PressedGel(const std::filesystem::path& press, const TetMesh& gel)
    : gel_(gel), press_(PressFolder::finished(press, {{kVertices, static_cast<std::size_t>(gel.num_vertices())}})) {
  check_rest(press_, gel);
  for (std::size_t frame = 1; frame < num_frames(); ++frame)
    press_.positions(frame);  // checks every frame before the long work
  if (press_.has(contact_force) != press_.has(contact_state)) {
    throw DataError("{}: has one of {} and {} without the other", press.string(), field_of(contact_force).file,
                    field_of(contact_state).file);
  }
  if (press_.has(contact_force)) {
    press_.require_front(gel.vertices(BoundaryTag::front));
    press_.require({contact_force, contact_state});
  }
  if (press_.has(PressArray::markers)) press_.require({PressArray::markers});
}

SurfaceFields PressedGel::fields(std::size_t frame, const Membrane& membrane) const {
  if (!press_.has(contact_force)) return {};
  return {.traction_pa = traction_of(press_.contact_forces(frame), membrane), .contact = press_.contact_states(frame)};
}

std::vector<std::size_t> PressedGel::phase_ends() const {
  std::vector<std::size_t> ends;
  if (!press_.has(PressArray::phase)) return ends;
  const std::vector<PhaseKind> phases = press_.phases();
  for (std::size_t f = 1; f < phases.size(); ++f)
    if (f + 1 == phases.size() || phases[f + 1] != phases[f]) ends.push_back(f);
  return ends;
}

Positions PressedGel::markers(std::size_t frame) const {
  return press_.has(PressArray::markers) ? press_.markers(frame) : Positions(0, 3);
}

}  // namespace tacipc
