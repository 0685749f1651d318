// Outcome of a scene for each rigid body that its gels hold: the body's motion relative to the gels, judged like that
// of a grasp. `press` computes it and stores it in the record as summary.held.
#pragma once

#include <filesystem>
#include <vector>

#include "common/sample/grasp_outcome.h"
#include "common/sample/held_path.h"
#include "common/sample/press_record.h"
#include "common/sample/scene_folder.h"

namespace tacipc {

/// Smallest force on a gel that counts as contact.
inline constexpr double kGelTouches_n = 1e-3;

/// Returns the force on a gel into its front, −f · z of its S, N.
double normal_force_n(const Matrix4& world_from_gel, const Vector3& force_n);

/// Returns the motion of a body since the frame `freed`, relative to a frame of all gels together. That frame has the
/// axes of the first gel and its origin in the mean of the gels' origins. The slip is the displacement of the body's
/// point in this origin at `freed`, including creep.
HeldMotion held_motion(const SceneBodies& scene, std::size_t body, std::size_t freed, std::size_t frame);

/// Contacts of the gels with all bodies, frame by frame.
struct HeldContacts {
  double slip_speed_m_s = 0.0;  // ε_v: slower contacts stick
  std::vector<HeldContact> per_frame = {};
};

/// Computes outcomes of rigid bodies that a gel touches. A body is free from its `freed_frame`, when nothing but gels
/// holds it and all gels that ever touch anything do. Its motion is taken from there to the last frame. Its outcome is
/// lifted, held (the hand does not rise), slipped, rotated or dropped; absent for a single gel, which cannot hold.
/// \param free_from for each body, the last frame in which a phase holds or moves it
/// \param contacts without frames, no creep is computed
/// \return bodies that are free before the last frame
std::vector<HeldBodyLines> held_bodies(const SceneBodies& scene, const std::vector<std::size_t>& free_from,
                                       const HeldContacts& contacts);

/// Reads the outcomes from a record; empty if it has none.
std::vector<HeldBodyLines> read_held(const std::filesystem::path& scene_folder);

}  // namespace tacipc
