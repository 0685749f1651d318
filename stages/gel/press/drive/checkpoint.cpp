#include "stages/gel/press/drive/checkpoint.h"

#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>

#include "common/base/error.h"

namespace tacipc {
namespace {

/// Appends values to a string of bytes. One description of a frame serves both Writer and Reader.
class Writer {
 public:
  void bytes(const void* values, std::size_t count) { bytes_.append(static_cast<const char*>(values), count); }
  void rows(const auto& matrix) { size(matrix.rows()); }
  void items(const auto& list) { size(std::ssize(list)); }
  std::string take() { return std::move(bytes_); }

 private:
  void size(std::int64_t count) { bytes(&count, sizeof(count)); }
  std::string bytes_;
};

/// Takes values from a string of bytes.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  void bytes(void* values, std::size_t count) {
    if (count > bytes_.size()) throw DataError("a saved frame ends too early");
    if (count > 0) std::memcpy(values, bytes_.data(), count);  // an empty array has no address
    bytes_.remove_prefix(count);
  }
  void rows(auto& matrix) {
    matrix.resize(size(sizeof(double) * static_cast<std::size_t>(matrix.cols())), matrix.cols());
  }
  void items(auto& list) { list.resize(static_cast<std::size_t>(size(1))); }  // each item has at least one byte
  bool at_end() const { return bytes_.empty(); }

 private:
  Eigen::Index size(std::size_t bytes_each) {
    std::int64_t count = 0;
    bytes(&count, sizeof(count));
    if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() / bytes_each)
      throw DataError("a saved frame ends too early");
    return static_cast<Eigen::Index>(count);
  }
  std::string_view bytes_;
};

/// Reads or writes a number, a matrix of numbers, a list, an optional, or a struct described by fields().
void one(auto& io, auto& value) {
  using T = std::remove_cvref_t<decltype(value)>;
  if constexpr (std::is_base_of_v<Eigen::MatrixBase<T>, T>) {
    if constexpr (T::RowsAtCompileTime == Eigen::Dynamic) io.rows(value);
    io.bytes(value.data(), sizeof(typename T::Scalar) * static_cast<std::size_t>(value.size()));
  } else if constexpr (requires { value.has_value(); }) {
    char has = value.has_value() ? 1 : 0;
    io.bytes(&has, 1);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(value)>>) value = has ? T(std::in_place) : T();
    if (has) one(io, *value);
  } else if constexpr (requires { value.begin(); }) {
    if constexpr (requires(T list) { list.resize(1); }) io.items(value);
    for (auto& item : value) one(io, item);
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    io.bytes(&value, sizeof(value));
  } else {
    fields(io, value);
  }
}

void all(auto& io, auto&... values) { (one(io, values), ...); }

template <typename T, typename Struct>
concept Is = std::is_same_v<std::remove_const_t<T>, Struct>;

void fields(auto& io, Is<Wrench> auto& wrench) { all(io, wrench.force_n, wrench.torque_n_m); }

void fields(auto& io, Is<StepReport> auto& r) {
  all(io, r.time_steps, r.newton_iterations, r.moving_iterations, r.patches, r.patch_iterations, r.lag_iterations,
      r.exact_hessian_waits, r.approximated_share, r.velocity_residual_m_s, r.force_residual_n, r.friction_residual_n,
      r.barrier_factor, r.contact_force_n, r.object_shift_m, r.body_residual_n, r.body_residual_n_m, r.body_load_n);
}

void fields(auto& io, Is<Balance> auto& b) {
  all(io, b.force_n, b.torque_n_m, b.relative, b.contact_n, b.inertia_n, b.mount_n);
}

void fields(auto& io, Is<Frame> auto& f) {
  all(io, f.time_s, f.phase, f.phase_index, f.positions, f.gel_from_object, f.holder_pose, f.normal_force_n,
      f.friction_force_n, f.contact_state, f.force_n, f.torque_n_m, f.balance, f.min_gap_m, f.stand_off_m,
      f.min_volume_ratio, f.pose_error_m, f.body_strain, f.object_velocity_m_s, f.object_spin_rad_s, f.intersections,
      f.inverted_tets, f.gel_in_object, f.stress_pa, f.solver);
}

void fields(auto& io, Is<WholeAccount> auto& w) {
  all(io, w.kinetic_j, w.elastic_j, w.contact_j, w.gravitational_j, w.work_j, w.friction_loss_j, w.damping_loss_j,
      w.method_loss_j, w.momentum_kg_m_s, w.angular_momentum_kg_m2_s, w.impulse_n_s, w.angular_impulse_n_m_s,
      w.method_angular_n_m_s, w.momentum_residual_n, w.angular_residual_n_m);
}

void fields(auto& io, Is<RigidMotion> auto& motion) { all(io, motion.velocity_m_s, motion.angular_momentum_kg_m2_s); }

void fields(auto& io, Is<State> auto& s) {
  all(io, s.x, s.velocity_m_s, s.object_velocity_m_s, s.object_motion, s.barrier_factor, s.viscous_pa);
}

void fields(auto& io, Is<WorldState> auto& s) {
  all(io, s.motion, s.world_from_body, s.mount_n, s.held, s.on_others, s.between, s.account, s.time_s);
}

void fields(auto& io, Is<PressProgress> auto& progress) { all(io, progress.world, progress.object_shift_m); }

void fields(auto& io, Is<FingerDrive> auto& drive) { all(io, drive.force_n, drive.closed_m, drive.velocity_m_s); }

void fields(auto& io, Is<GraspFrame> auto& f) {
  all(io, f.time_s, f.phase, f.world_from_hand, f.world_from_finger, f.force_on_finger_n, f.drives, f.world_from_object,
      f.velocity_m_s, f.spin_rad_s, f.grip_imbalance, f.slip_m, f.turn_rad, f.whole);
}

void fields(auto& io, Is<GripControl> auto& d) {
  all(io, d.wanted_n, d.closed_m, d.velocity_m_s, d.last_step_m, d.last_grip_n, d.stiffness_n_m, d.let_go, d.by_way,
      d.wanted_closed_m);
}

void fields(auto& io, Is<HandState> auto& hand) { all(io, hand.drives, hand.world_from_hand, hand.grip_n); }

void fields(auto& io, Is<GraspProgress> auto& progress) { all(io, progress.world, progress.hand); }

void fields(auto& io, Is<SceneFrame> auto& f) {
  all(io, f.time_s, f.phase_index, f.world_from_body, f.velocity_m_s, f.spin_rad_s, f.strain, f.soft_m, f.between,
      f.min_gap_m, f.intersections, f.whole, f.solver);
}

template <typename... Parts>
std::string pack(const Parts&... parts) {
  Writer writer;
  all(writer, parts...);
  return writer.take();
}

template <typename... Parts>
void unpack(std::string_view bytes, Parts&... parts) {
  Reader reader(bytes);
  all(reader, parts...);
  if (!reader.at_end()) throw DataError("a saved frame has more bytes than a frame");
}

}  // namespace

std::string pack_frame(const Frame& frame, const PressProgress& progress) { return pack(frame, progress); }

void unpack_frame(std::string_view bytes, Frame& frame, PressProgress& progress) { unpack(bytes, frame, progress); }

std::string pack_frame(const GraspFrame& frame, const std::vector<Frame>& fingers, const GraspProgress& progress) {
  return pack(fingers, frame, progress);
}

void unpack_frame(std::string_view bytes, GraspFrame& frame, std::vector<Frame>& fingers, GraspProgress& progress) {
  unpack(bytes, fingers, frame, progress);
}

std::string pack_frame(const SceneFrame& frame, const std::vector<Frame>& gels, const WorldState& state) {
  return pack(gels, frame, state);
}

void unpack_frame(std::string_view bytes, SceneFrame& frame, std::vector<Frame>& gels, WorldState& state) {
  unpack(bytes, gels, frame, state);
}

}  // namespace tacipc
