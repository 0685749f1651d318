// Outcome of a scene for the rigid bodies that its gels hold: each body's motion as seen from the gels, judged like
// that of a grasp. `press` decides it and the record keeps it, as summary.held.
#pragma once

#include <filesystem>
#include <vector>

#include "common/sample/grasp_outcome.h"
#include "common/sample/held_path.h"
#include "common/sample/press_record.h"
#include "common/sample/scene_folder.h"

namespace tacipc {

/// A gel that is pressed with less does not touch.
inline constexpr double kGelTouches_n = 1e-3;

/// Force (N) on a gel into it, −f · z of its S.
double normal_force_n(const Matrix4& world_from_gel, const Vector3& force_n);

/// Motion of a body since the frame `freed`, as seen from all gels together: their frame has the axes of the first gel
/// and its origin in the middle of theirs. Slip is that of the body's point in this origin at `freed`, creep included.
HeldMotion held_motion(const SceneBodies& scene, std::size_t body, std::size_t freed, std::size_t frame);

/// Contact of the gels with all that they touch, frame by frame.
struct HeldContacts {
  double slip_speed_m_s = 0.0;  // ε_v: slower contacts stick
  std::vector<HeldContact> per_frame = {};
};

/// Rigid bodies that a gel touches. Each is free from its `freed_frame` on: nothing else holds it, and all gels touch
/// that ever do. Its motion is that from there to the last frame; its outcome is lifted, held (the hand does not rise),
/// slipped, rotated or dropped, and absent for a single gel, which holds nothing.
/// \param free_from for each body the last frame in which a phase holds or moves it
/// \param contacts without frames nothing is told of creep
/// \return those that are free before the last frame
std::vector<HeldBodyLines> held_bodies(const SceneBodies& scene, const std::vector<std::size_t>& free_from,
                                       const HeldContacts& contacts);

/// What a record keeps of them; empty if it has none.
std::vector<HeldBodyLines> read_held(const std::filesystem::path& scene_folder);

}  // namespace tacipc
