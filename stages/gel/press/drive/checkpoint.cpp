#include "stages/gel/press/drive/checkpoint.h"

#include <cstring>
#include <type_traits>

#include "common/base/error.h"

namespace tacipc {
namespace {

/// Appends to, or takes from, a string of bytes: one description of a frame serves both directions.
class Writer {
 public:
  template <typename T>
  void plain(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  template <int Columns>
  void rows(const Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor>& array) {
    plain(static_cast<std::int64_t>(array.rows()));
    bytes_.append(reinterpret_cast<const char*>(array.data()), sizeof(double) * static_cast<std::size_t>(array.size()));
  }
  void states(const std::vector<ContactState>& states) {
    plain(static_cast<std::int64_t>(states.size()));
    for (const ContactState state : states) plain(state);
  }
  void history(const Viscoelasticity::History& history) {
    plain(static_cast<std::int64_t>(history.size()));
    for (const SymmetricRows& member : history) rows(member);
  }
  template <typename T>
  void sized(const std::vector<T>& items) {
    plain(static_cast<std::int64_t>(items.size()));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <typename T>
  void plain(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(static_cast<void*>(&value), take(sizeof(T)), sizeof(T));
  }
  template <int Columns>
  void rows(Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor>& array) {
    const auto count = size(Columns * sizeof(double));
    array.resize(count, Columns);
    const std::size_t bytes = Columns * sizeof(double) * static_cast<std::size_t>(count);
    if (bytes > 0) std::memcpy(array.data(), take(bytes), bytes);  // an empty array has no address
  }
  void states(std::vector<ContactState>& states) {
    states.resize(static_cast<std::size_t>(size(1)));
    for (ContactState& state : states) plain(state);
  }
  void history(Viscoelasticity::History& history) {
    history.resize(static_cast<std::size_t>(size(sizeof(std::int64_t))));  // each has at least its own size
    for (SymmetricRows& member : history) rows(member);
  }
  template <typename T>
  void sized(std::vector<T>& items) {
    items.resize(static_cast<std::size_t>(size(1)));  // each has more than a byte
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  const char* take(std::size_t count) {
    if (count > bytes_.size()) throw DataError("a saved frame ends too early");
    const char* at = bytes_.data();
    bytes_.remove_prefix(count);
    return at;
  }
  Eigen::Index size(std::size_t bytes_each) {
    std::int64_t count = 0;
    plain(count);
    if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() / bytes_each)
      throw DataError("a saved frame ends too early");
    return static_cast<Eigen::Index>(count);
  }
  std::string_view bytes_;
};

void each(auto& io, auto& matrix) {
  for (Eigen::Index i = 0; i < matrix.size(); ++i) io.plain(matrix.data()[i]);
}

void all(auto& io, auto& items, const auto& fields_of) {
  io.sized(items);
  for (auto& item : items) fields_of(item);
}

void matrices(auto& io, auto& items) {
  all(io, items, [&](auto& item) { each(io, item); });
}

void wrenches(auto& io, auto& items) {
  all(io, items, [&](auto& wrench) {
    each(io, wrench.force_n);
    each(io, wrench.torque_n_m);
  });
}

void solver(auto& io, auto& report) {
  io.plain(report.time_steps);
  io.plain(report.newton_iterations);
  io.plain(report.moving_iterations);
  io.plain(report.patches);
  io.plain(report.patch_iterations);
  io.plain(report.lag_iterations);
  io.plain(report.exact_hessian_waits);
  io.plain(report.approximated_share);
  io.plain(report.velocity_residual_m_s);
  io.plain(report.force_residual_n);
  io.plain(report.friction_residual_n);
  io.plain(report.barrier_factor);
  io.plain(report.contact_force_n);
  each(io, report.object_shift_m);
  io.plain(report.body_residual_n);
  io.plain(report.body_residual_n_m);
  io.plain(report.body_load_n);
}

void gel_frame_fields(auto& io, auto& frame) {
  io.plain(frame.time_s);
  io.plain(frame.phase);
  io.plain(frame.phase_index);
  io.rows(frame.positions);
  each(io, frame.gel_from_object);
  each(io, frame.holder_pose);
  io.rows(frame.normal_force_n);
  io.rows(frame.friction_force_n);
  io.states(frame.contact_state);
  each(io, frame.force_n);
  each(io, frame.torque_n_m);
  io.plain(frame.balance.force_n);
  io.plain(frame.balance.torque_n_m);
  io.plain(frame.balance.relative);
  each(io, frame.balance.contact_n);
  each(io, frame.balance.inertia_n);
  each(io, frame.balance.mount_n);
  io.plain(frame.min_gap_m);
  io.plain(frame.stand_off_m);
  io.plain(frame.min_volume_ratio);
  io.plain(frame.pose_error_m);
  io.plain(frame.body_strain);
  each(io, frame.object_velocity_m_s);
  each(io, frame.object_spin_rad_s);
  io.plain(frame.intersections);
  io.plain(frame.inverted_tets);
  io.plain(frame.gel_in_object);
  solver(io, frame.solver);
}

void account(auto& io, auto& whole) {
  io.plain(whole.kinetic_j);
  io.plain(whole.elastic_j);
  io.plain(whole.contact_j);
  io.plain(whole.gravitational_j);
  io.plain(whole.work_j);
  io.plain(whole.friction_loss_j);
  io.plain(whole.damping_loss_j);
  io.plain(whole.method_loss_j);
  each(io, whole.momentum_kg_m_s);
  each(io, whole.angular_momentum_kg_m2_s);
  each(io, whole.impulse_n_s);
  each(io, whole.angular_impulse_n_m_s);
  each(io, whole.method_angular_n_m_s);
  io.plain(whole.momentum_residual_n);
  io.plain(whole.angular_residual_n_m);
}

void state_fields(auto& io, auto& state) {
  auto& motion = state.motion;
  io.rows(motion.x);
  io.rows(motion.velocity_m_s);
  each(io, motion.object_velocity_m_s);
  all(io, motion.object_motion, [&](auto& of_object) {
    each(io, of_object.velocity_m_s);
    each(io, of_object.angular_momentum_kg_m2_s);
  });
  io.plain(motion.barrier_factor);
  io.history(motion.viscous_pa);
  matrices(io, state.world_from_body);
  io.rows(state.mount_n);
  all(io, state.held, [&](auto& body) { io.plain(body); });
  wrenches(io, state.on_others);
  wrenches(io, state.between);
  account(io, state.account);
  io.plain(state.time_s);
}

void fields(auto& io, auto& frame, auto& progress) {
  gel_frame_fields(io, frame);
  state_fields(io, progress.world);
  each(io, progress.object_shift_m);
}

void grasp_fields(auto& io, auto& frame, auto& progress) {
  io.plain(frame.time_s);
  io.plain(frame.phase);
  each(io, frame.world_from_hand);
  for (auto& pose : frame.world_from_finger) each(io, pose);
  for (auto& force : frame.force_on_finger_n) each(io, force);
  for (auto& drive : frame.drives) {
    io.plain(drive.force_n);
    io.plain(drive.closed_m);
    io.plain(drive.velocity_m_s);
  }
  each(io, frame.world_from_object);
  each(io, frame.velocity_m_s);
  each(io, frame.spin_rad_s);
  io.plain(frame.body_residual_n);
  io.plain(frame.body_load_n);
  io.plain(frame.grip_imbalance);
  io.plain(frame.slip_m);
  io.plain(frame.turn_rad);
  account(io, frame.whole);
  state_fields(io, progress.world);
  for (auto& drive : progress.hand.drives) {
    io.plain(drive.wanted_n);
    io.plain(drive.closed_m);
    io.plain(drive.velocity_m_s);
    io.plain(drive.last_step_m);
    io.plain(drive.last_grip_n);
    io.plain(drive.stiffness_n_m);
    io.plain(drive.let_go);
    io.plain(drive.by_way);
    io.plain(drive.wanted_closed_m);
  }
  each(io, progress.hand.world_from_hand);
  io.plain(progress.hand.grip_n);
}

void scene_fields(auto& io, auto& frame, auto& state) {
  io.plain(frame.time_s);
  io.plain(frame.phase_index);
  matrices(io, frame.world_from_body);
  matrices(io, frame.velocity_m_s);
  matrices(io, frame.spin_rad_s);
  all(io, frame.strain, [&](auto& strain) { io.plain(strain); });
  all(io, frame.soft_m, [&](auto& positions) { io.rows(positions); });
  wrenches(io, frame.between);
  io.plain(frame.min_gap_m);
  io.plain(frame.intersections);
  account(io, frame.whole);
  solver(io, frame.solver);
  state_fields(io, state);
}

void fields(auto& io, auto& frame, auto& gels, auto& progress) {
  all(io, gels, [&](auto& of_gel) { gel_frame_fields(io, of_gel); });
  if constexpr (requires { frame.world_from_hand; }) {
    grasp_fields(io, frame, progress);
  } else {
    scene_fields(io, frame, progress);
  }
}

template <typename... Parts>
std::string pack(const Parts&... parts) {
  Writer writer;
  fields(writer, parts...);
  return writer.take();
}

template <typename... Parts>
void unpack(std::string_view bytes, Parts&... parts) {
  Reader reader(bytes);
  fields(reader, parts...);
  if (!reader.at_end()) throw DataError("a saved frame has more bytes than a frame");
}

}  // namespace

std::string pack_frame(const Frame& frame, const PressProgress& progress) { return pack(frame, progress); }

void unpack_frame(std::string_view bytes, Frame& frame, PressProgress& progress) { unpack(bytes, frame, progress); }

std::string pack_frame(const GraspFrame& frame, const std::vector<Frame>& fingers, const GraspProgress& progress) {
  return pack(frame, fingers, progress);
}

void unpack_frame(std::string_view bytes, GraspFrame& frame, std::vector<Frame>& fingers, GraspProgress& progress) {
  unpack(bytes, frame, fingers, progress);
}

std::string pack_frame(const SceneFrame& frame, const std::vector<Frame>& gels, const WorldState& state) {
  return pack(frame, gels, state);
}

void unpack_frame(std::string_view bytes, SceneFrame& frame, std::vector<Frame>& gels, WorldState& state) {
  unpack(bytes, frame, gels, state);
}

}  // namespace tacipc
