#include "stages/render/press_folder.h"

#include <Eigen/Geometry>
#include <cmath>

#include "common/error.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

std::string shape_text(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t length : shape) text += (text.empty() ? "" : ", ") + std::to_string(length);
  return text;
}

std::optional<NpyArray> read_if_there(const fs::path& path, const std::vector<std::size_t>& shape) {
  if (!fs::exists(path)) return std::nullopt;
  NpyArray array = read_npy(path);
  if (array.shape != shape) {
    throw DataError("{}: has shape ({}) where ({}) is needed", path.string(), shape_text(array.shape),
                    shape_text(shape));
  }
  for (const double value : array.data) {
    if (!std::isfinite(value)) throw DataError("{}: has a number that is not finite", path.string());
  }
  return array;
}

/// Rows of `positions.npy` on the front face as the press wrote them must be the gel's own.
void check_front(const fs::path& path, const std::vector<int>& front) {
  const NpyArray rows = read_npy(path);
  bool same = rows.data.size() == front.size();
  for (std::size_t i = 0; same && i < front.size(); ++i) same = rows.data[i] == front[i];
  if (!same) throw DataError("{}: is not the front face of this gel", path.string());
}

}  // namespace

Positions frame_positions(const NpyArray& positions, std::size_t frame) {
  const auto vertices = static_cast<Eigen::Index>(positions.shape[1]);
  return Eigen::Map<const Positions>(positions.data.data() + frame * positions.shape[1] * 3, vertices, 3);
}

void check_positions(const NpyArray& positions, const TetMesh& gel, const std::string& name) {
  const auto num_vertices = static_cast<std::size_t>(gel.num_vertices());
  if (positions.shape.size() != 3 || positions.shape[2] != 3 || positions.shape[0] == 0) {
    throw DataError("{}: has shape ({}) where (frames, vertices, 3) is needed", name, shape_text(positions.shape));
  }
  if (positions.shape[1] != num_vertices) {
    throw DataError("{}: has {} vertices, the gel {}", name, positions.shape[1], num_vertices);
  }
  for (std::size_t i = 0; i < positions.data.size(); ++i) {
    if (!std::isfinite(positions.data[i])) {
      throw DataError("{}: frame {}, vertex {} is not finite", name, i / (3 * num_vertices), i / 3 % num_vertices);
    }
  }
  const Positions first = frame_positions(positions, 0);
  Eigen::Index worst = 0;
  const double distance = (first - gel.positions).rowwise().norm().maxCoeff(&worst);
  if (distance > 1e-6) {
    throw DataError("{}: frame 0 is not the gel at rest: vertex {} is {:.3g} mm away from its place in the gel", name,
                    worst, 1e3 * distance);
  }
}

PressFrames read_press(const fs::path& folder, const TetMesh& gel) {
  if (!fs::exists(folder / "press.yaml")) {
    throw DataError("{}: has no press.yaml, so the press did not finish", folder.string());
  }
  PressFrames press{.positions = read_npy(folder / "positions.npy")};
  check_positions(press.positions, gel, (folder / "positions.npy").string());
  const std::vector<int> front = gel.vertices(BoundaryTag::front);
  const std::size_t frames = press.num_frames();
  press.contact_force = read_if_there(folder / "contact_force.npy", {frames, front.size(), 2, 3});
  press.contact_state = read_if_there(folder / "contact_state.npy", {frames, front.size()});
  if (press.contact_force.has_value() != press.contact_state.has_value()) {
    throw DataError("{}: has one of contact_force.npy and contact_state.npy without the other", folder.string());
  }
  if (press.contact_force) check_front(folder / "front_vertices.npy", front);
  if (fs::exists(folder / "markers.npy")) {
    const NpyArray markers = read_npy(folder / "markers.npy");
    const std::size_t count = markers.shape.size() == 3 ? markers.shape[1] : 0;
    press.markers = read_if_there(folder / "markers.npy", {frames, count, 3});
  }
  return press;
}

SurfaceFields surface_fields(const PressFrames& press, std::size_t frame, const Membrane& membrane) {
  SurfaceFields fields;
  if (!press.contact_force) return fields;
  const Eigen::Index count = membrane.positions.rows();
  Eigen::VectorXd area = Eigen::VectorXd::Zero(count);
  for (Eigen::Index f = 0; f < membrane.triangles.rows(); ++f) {
    const Vector3 a = membrane.positions.row(membrane.triangles(f, 0)).transpose();
    const Vector3 b = membrane.positions.row(membrane.triangles(f, 1)).transpose();
    const Vector3 c = membrane.positions.row(membrane.triangles(f, 2)).transpose();
    const double third = (b - a).cross(c - a).norm() / 6.0;
    for (int k = 0; k < 3; ++k) area[membrane.triangles(f, k)] += third;
  }
  fields.traction_pa = Positions::Zero(count, 3);
  fields.contact.resize(static_cast<std::size_t>(count));
  for (Eigen::Index v = 0; v < count; ++v) {
    const std::size_t row = frame * static_cast<std::size_t>(count) + static_cast<std::size_t>(v);
    const double* force = press.contact_force->data.data() + 6 * row;
    for (int c = 0; c < 3 && area[v] > 0.0; ++c) fields.traction_pa(v, c) = (force[c] + force[3 + c]) / area[v];
    const double state = press.contact_state->data[row];
    if (state != 0.0 && state != 1.0 && state != 2.0)
      throw DataError("contact_state.npy: {} is none of 0, 1, 2 (frame {})", state, frame);
    fields.contact[static_cast<std::size_t>(v)] = static_cast<std::uint8_t>(state);
  }
  return fields;
}

Positions frame_markers(const PressFrames& press, std::size_t frame) {
  return press.markers ? frame_positions(*press.markers, frame) : Positions(0, 3);
}

}  // namespace tacipc
