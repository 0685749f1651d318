#include "common/sample/press_folder.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

#include "common/base/error.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

using enum NpyType;

/// Returns "0 reference, 1 approach, …".
template <typename Names>
std::string code_list(const Names& names) {
  std::string text;
  for (std::size_t code = 0; code < names.size(); ++code)
    text += fmt::format("{}{} {}", code > 0 ? ", " : "", code, names[code]);
  return text;
}

const std::array<NpyField, 17>& all_arrays() {
  static const std::array<NpyField, 17> kFields{{
      {"positions.npy", f8, {kFrames, kVertices, 3}, "m", "gel vertices in the order of `gel.msh`; frame 0 is rest"},
      {"object_pose.npy", f8, {kFrames, 4, 4}, "m", "`gel_from_object`"},
      {"time.npy", f8, {kFrames}, "s", "time of the frame, 0 at the first"},
      {"phase.npy", u1, {kFrames}, "code", code_list(kPhaseNames) + "; approach: no contact yet"},
      {"wrench.npy",
       f8,
       {kFrames, 6},
       "N, N m",
       "force and torque about the origin of S on the gel, over the whole contact"},
      {"contact_force.npy",
       f8,
       {kFrames, kFrontVertices, 2, 3},
       "N",
       "normal [0] and friction [1] force on each front vertex; includes gel–gel pairs, which cancel in the sum"},
      {"front_vertices.npy",
       i4,
       {kFrontVertices},
       "row",
       "rows of `positions.npy` that lie on the front face, ascending"},
      {"traction.npy",
       f8,
       {kFrames, kTractionRows, kTractionColumns, 2, 3},
       "Pa",
       "normal [0] and friction [1] force per area of the plane on a grid over what the camera sees of the front; row "
       "0 at the smallest y, column 0 at the smallest x. Times the cell's area it sums to the forces on the vertices "
       "inside"},
      {"contact_state.npy",
       u1,
       {kFrames, kFrontVertices},
       "code",
       code_list(kContactStateNames) + " ([meaning](press.md#output))"},
      {"first_slip.npy",
       f8,
       {kFrontVertices},
       "s",
       "time of the first frame in which a vertex slips; +∞ if it never does",
       false},
      {"markers.npy", f8, {kFrames, kMarkers, 3}, "m", "markers on the deformed front"},
      {"marker_displacement.npy",
       f8,
       {kFrames, kMarkers, 2, 3},
       "m",
       "[0] since rest, [1] since the end of the first press (zero before)"},
      {"object_twist.npy",
       f8,
       {kFrames, 6},
       "m/s, rad/s",
       "velocity of the object's centre of mass and its angular velocity; only where the motion has a phase in which "
       "it "
       "is free"},
      {"holder_pose.npy",
       f8,
       {kFrames, 4, 4},
       "m",
       "`gel_from_object` if the mount were rigid, so the motion of the object's holder against the sensor's housing; "
       "only of a sensor whose [mount](press.md#a-mount-that-gives-way) gives way"},
      {"stress.npy",
       f8,
       {kFrames, kTets, 6},
       "Pa",
       "Cauchy stress of each tetrahedron of `gel.msh`: xx, yy, zz, yz, xz, xy in frame S, > 0 in tension; this and "
       "the "
       "next two only where the press file says `stress: true` ([stress](press.md#stress))"},
      {"front_pressure.npy",
       f8,
       {kFrames, kFrontVertices, 2},
       "Pa",
       "pressure on each front vertex, [0] of the contact force over its area, [1] of the stress behind it, −n · σ n"},
      {"front_shear.npy",
       f8,
       {kFrames, kFrontVertices, 2, 3},
       "Pa",
       "traction along the front, on the gel, of the same two"},
  }};
  return kFields;
}

Positions rows_of(const std::vector<double>& values) {
  return Eigen::Map<const Positions>(values.data(), static_cast<Eigen::Index>(values.size() / 3), 3);
}

/// Reads the two vectors of every row, as ContactParts or MarkerDisplacement.
template <typename Pair>
Pair pair_of(const std::vector<double>& values) {
  const auto count = static_cast<Eigen::Index>(values.size() / 6);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>> both(values.data(), count, 6);
  return {both.leftCols<3>(), both.rightCols<3>()};
}

/// Converts codes to the enum with these names.
/// \param first index of the first value in the file
template <typename Code, typename Names>
std::vector<Code> codes_of(const std::vector<double>& values, const Names& names, const fs::path& path,
                           std::size_t first = 0) {
  std::vector<Code> codes;
  for (const double value : values) {
    if (!(value >= 0.0 && value < static_cast<double>(names.size()) && std::floor(value) == value))
      throw DataError("{}: value {} is {}, which is not one of {}", path.string(), first + codes.size(), value,
                      code_list(names));
    codes.push_back(static_cast<Code>(static_cast<int>(value)));
  }
  return codes;
}

}  // namespace

std::span<const NpyField> press_fields() { return all_arrays(); }

const NpyField& field_of(PressArray array) { return all_arrays()[static_cast<std::size_t>(array)]; }

void PressFolder::require(std::initializer_list<PressArray> arrays) const {
  for (const PressArray array : arrays) arrays_.require(field_of(array));
}

void PressFolder::require_front(const std::vector<int>& vertices) const {
  if (front_vertices() != vertices)
    throw DataError("{}: does not list the front of the gel", path(PressArray::front_vertices).string());
}

std::vector<double> PressFolder::times() const { return arrays_.whole(field_of(PressArray::time)); }

std::vector<PhaseKind> PressFolder::phases() const {
  return codes_of<PhaseKind>(arrays_.whole(field_of(PressArray::phase)), kPhaseNames, path(PressArray::phase));
}

std::vector<Matrix4> PressFolder::poses() const { return arrays_.items<Matrix4>(field_of(PressArray::object_pose)); }

std::vector<Matrix4> PressFolder::holder_poses() const {
  return arrays_.items<Matrix4>(field_of(PressArray::holder_pose));
}

std::vector<Wrench> PressFolder::wrenches() const { return arrays_.items<Wrench>(field_of(PressArray::wrench)); }

std::vector<Twist> PressFolder::twists() const { return arrays_.items<Twist>(field_of(PressArray::object_twist)); }

std::vector<int> PressFolder::front_vertices() const {
  const std::vector<double> values = arrays_.whole(field_of(PressArray::front_vertices));
  const std::size_t gel = extent(PressArray::positions, kVertices);
  std::vector<int> rows;
  for (const double value : values) {
    if (!(value >= 0.0 && value < static_cast<double>(gel)))
      throw DataError("{}: {} is not a row of {}", path(PressArray::front_vertices).string(), value,
                      field_of(PressArray::positions).file);
    rows.push_back(static_cast<int>(value));
  }
  return rows;
}

std::vector<double> PressFolder::first_slips() const { return arrays_.whole(field_of(PressArray::first_slip)); }

Positions PressFolder::positions(std::size_t frame) const { return rows_of(frame_of(PressArray::positions, frame)); }

ContactParts PressFolder::contact_forces(std::size_t frame) const {
  return pair_of<ContactParts>(frame_of(PressArray::contact_force, frame));
}

std::vector<ContactState> PressFolder::contact_states(std::size_t frame) const {
  const std::vector<double> values = frame_of(PressArray::contact_state, frame);
  return codes_of<ContactState>(values, kContactStateNames, path(PressArray::contact_state), frame * values.size());
}

ContactParts PressFolder::tractions(std::size_t frame) const {
  return pair_of<ContactParts>(frame_of(PressArray::traction, frame));
}

Positions PressFolder::markers(std::size_t frame) const { return rows_of(frame_of(PressArray::markers, frame)); }

SymmetricRows PressFolder::stresses(std::size_t frame) const {
  const std::vector<double> values = frame_of(PressArray::stress, frame);
  return Eigen::Map<const SymmetricRows>(values.data(), static_cast<Eigen::Index>(values.size() / 6), 6);
}

FrontTraction PressFolder::front_of(std::size_t frame, Eigen::Index which) const {
  const std::vector<double> pressures = frame_of(PressArray::front_pressure, frame),
                            shears = frame_of(PressArray::front_shear, frame);
  const auto count = static_cast<Eigen::Index>(pressures.size() / 2);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return {Eigen::Map<const Rows>(pressures.data(), count, 2).col(which),
          Eigen::Map<const Rows>(shears.data(), count, 6).middleCols<3>(3 * which)};
}

FrontTraction PressFolder::front_by_contact(std::size_t frame) const { return front_of(frame, 0); }

FrontTraction PressFolder::front_by_stress(std::size_t frame) const { return front_of(frame, 1); }

MarkerDisplacement PressFolder::marker_displacements(std::size_t frame) const {
  return pair_of<MarkerDisplacement>(frame_of(PressArray::marker_displacement, frame));
}

}  // namespace tacipc
