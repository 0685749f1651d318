#include "common/sample/press_folder.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <utility>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/format/npy_pose.h"
#include "common/stage/record.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

using enum NpyType;

constexpr const char* kRecord = "press.yaml";

/// "0 reference, 1 approach, …"
template <typename Names>
std::string code_list(const Names& names) {
  std::string text;
  for (std::size_t code = 0; code < names.size(); ++code)
    text += fmt::format("{}{} {}", code > 0 ? ", " : "", code, names[code]);
  return text;
}

const std::array<NpyField, 14>& all_fields() {
  static const std::array<NpyField, 14> kFields{{
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
  }};
  return kFields;
}

Positions rows_of(const std::vector<double>& values) {
  return Eigen::Map<const Positions>(values.data(), static_cast<Eigen::Index>(values.size() / 3), 3);
}

/// The two vectors of every row.
std::pair<Positions, Positions> pairs_of(const std::vector<double>& values) {
  const auto count = static_cast<Eigen::Index>(values.size() / 6);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>> both(values.data(), count, 6);
  return {both.leftCols<3>(), both.rightCols<3>()};
}

/// The codes as the enum of which `names` are the words. `first`: index of the first value in the file.
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

std::span<const NpyField> press_fields() { return all_fields(); }

const NpyField& field_of(PressArray array) { return all_fields()[static_cast<std::size_t>(array)]; }

PressFolder::PressFolder(fs::path folder, Extents known) : folder_(std::move(folder)), known_(std::move(known)) {
  const fs::path record = folder_ / kRecord;
  if (!fs::is_regular_file(record)) return;
  const Record outputs = Record::from_file(record).section("outputs");
  for (const std::string& name : outputs.keys()) {
    if (auto hash = outputs.text(name)) vouched_.emplace(name, std::move(*hash));
  }
}

PressFolder PressFolder::finished(fs::path folder, Extents known) {
  if (!fs::exists(folder / kRecord))
    throw DataError("{}: has no press.yaml, so the press did not finish", folder.string());
  return PressFolder(std::move(folder), std::move(known));
}

bool PressFolder::has(PressArray array) const { return fs::is_regular_file(path(array)); }

NpyFrames& PressFolder::open(PressArray array) const {
  if (const auto found = open_.find(array); found != open_.end()) return found->second;
  refuse_changed(array);
  NpyFrames file(path(array));
  match_shape(field_of(array), file.shape(), path(array).string(), known_);
  refuse_no_frames(array);
  return open_.emplace(array, std::move(file)).first->second;
}

void PressFolder::refuse_changed(PressArray array) const {
  const auto vouched = vouched_.find(field_of(array).file);
  if (vouched == vouched_.end() || !has(array) || !unchanged_.insert(array).second) return;
  if (content_hash(path(array)) != vouched->second)
    throw DataError("{}: has changed since press.yaml was written beside it", path(array).string());
}

void PressFolder::refuse_no_frames(PressArray array) const {
  const auto frames = known_.find(kFrames);
  if (frames != known_.end() && frames->second == 0) throw DataError("{}: has no frames", path(array).string());
}

std::size_t PressFolder::extent(PressArray array, std::string_view symbol) const {
  open(array);
  return known_.at(symbol);
}

void PressFolder::require(std::initializer_list<PressArray> arrays) const {
  for (const PressArray array : arrays) open(array);
}

void PressFolder::require_front(const std::vector<int>& vertices) const {
  if (front_vertices() != vertices)
    throw DataError("{}: does not list the front of the gel", path(PressArray::front_vertices).string());
}

std::vector<double> PressFolder::whole(PressArray array) const {
  refuse_changed(array);
  std::vector<double> values = read_field(field_of(array), path(array), known_).data;
  refuse_no_frames(array);
  return values;
}

std::vector<double> PressFolder::frame_of(PressArray array, std::size_t frame) const {
  NpyFrames& file = open(array);
  if (frame >= file.shape()[0])
    throw DataError("{}: has no frame {}, but {} frames", path(array).string(), frame, file.shape()[0]);
  NpyArray values{.shape = file.frame_shape(), .data = file.frame(frame)};
  check_finite(field_of(array), values, fmt::format("{}: frame {}", path(array).string(), frame));
  return std::move(values.data);
}

std::vector<double> PressFolder::times() const { return whole(PressArray::time); }

std::vector<PhaseKind> PressFolder::phases() const {
  return codes_of<PhaseKind>(whole(PressArray::phase), kPhaseNames, path(PressArray::phase));
}

std::vector<Matrix4> PressFolder::poses() const { return poses_of(PressArray::object_pose); }

std::vector<Matrix4> PressFolder::holder_poses() const { return poses_of(PressArray::holder_pose); }

std::vector<Matrix4> PressFolder::poses_of(PressArray array) const {
  const std::vector<double> values = whole(array);
  std::vector<Matrix4> poses;
  for (std::size_t at = 0; at < values.size(); at += 16) poses.push_back(pose_of(&values[at]));
  return poses;
}

std::vector<Wrench> PressFolder::wrenches() const {
  const std::vector<double> values = whole(PressArray::wrench);
  std::vector<Wrench> wrenches;
  for (std::size_t at = 0; at < values.size(); at += 6)
    wrenches.push_back(
        {Vector3(values[at], values[at + 1], values[at + 2]), Vector3(values[at + 3], values[at + 4], values[at + 5])});
  return wrenches;
}

std::vector<Twist> PressFolder::twists() const {
  const std::vector<double> values = whole(PressArray::object_twist);
  std::vector<Twist> twists;
  for (std::size_t at = 0; at < values.size(); at += 6)
    twists.push_back(
        {Vector3(values[at], values[at + 1], values[at + 2]), Vector3(values[at + 3], values[at + 4], values[at + 5])});
  return twists;
}

std::vector<int> PressFolder::front_vertices() const {
  const std::vector<double> values = whole(PressArray::front_vertices);
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

std::vector<double> PressFolder::first_slips() const { return whole(PressArray::first_slip); }

Positions PressFolder::positions(std::size_t frame) const { return rows_of(frame_of(PressArray::positions, frame)); }

ContactParts PressFolder::contact_forces(std::size_t frame) const {
  auto [normal, friction] = pairs_of(frame_of(PressArray::contact_force, frame));
  return {std::move(normal), std::move(friction)};
}

std::vector<ContactState> PressFolder::contact_states(std::size_t frame) const {
  const std::vector<double> values = frame_of(PressArray::contact_state, frame);
  return codes_of<ContactState>(values, kContactStateNames, path(PressArray::contact_state), frame * values.size());
}

ContactParts PressFolder::tractions(std::size_t frame) const {
  auto [normal, friction] = pairs_of(frame_of(PressArray::traction, frame));
  return {std::move(normal), std::move(friction)};
}

Positions PressFolder::markers(std::size_t frame) const { return rows_of(frame_of(PressArray::markers, frame)); }

MarkerDisplacement PressFolder::marker_displacements(std::size_t frame) const {
  auto [since_rest, since_press] = pairs_of(frame_of(PressArray::marker_displacement, frame));
  return {std::move(since_rest), std::move(since_press)};
}

void PressWriter::write(PressArray array, const std::vector<double>& values) const {
  write_field(field_of(array), stage_.output((folder_ / field_of(array).file).generic_string()), extents_, values);
}

void PressWriter::append(std::vector<double>& all, const std::vector<double>& values) {
  all.insert(all.end(), values.begin(), values.end());
}

void PressWriter::append(std::vector<double>& all, const std::vector<ContactState>& states) {
  for (const ContactState state : states) all.push_back(static_cast<double>(state));
}

void PressWriter::append(std::vector<double>& all, const Matrix4& pose) { append_pose(all, pose); }

void PressWriter::append(std::vector<double>& all, const Positions& rows) {
  all.insert(all.end(), rows.data(), rows.data() + rows.size());
}

void PressWriter::append(std::vector<double>& all, const ContactParts& parts) {
  for (Eigen::Index i = 0; i < parts.normal.rows(); ++i) {
    for (int k = 0; k < 3; ++k) all.push_back(parts.normal(i, k));
    for (int k = 0; k < 3; ++k) all.push_back(parts.friction(i, k));
  }
}

void PressWriter::append(std::vector<double>& all, const Twist& twist) {
  for (const Vector3& part : {twist.velocity_m_s, twist.spin_rad_s}) all.insert(all.end(), part.begin(), part.end());
}

void PressWriter::append(std::vector<double>& all, const Wrench& wrench) {
  for (const Vector3& part : {wrench.force_n, wrench.torque_n_m}) all.insert(all.end(), part.begin(), part.end());
}

}  // namespace tacipc
