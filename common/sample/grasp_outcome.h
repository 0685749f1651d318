// What became of a gripped object, told from its motion in the hand and from contact alone: one definition for all who
// ask.
#pragma once

#include <array>
#include <numbers>

namespace tacipc {

/// The first that holds: untouched, dropped, slipped, rotated, lifted; docs/grasp.md.
enum class GraspOutcome { lifted, slipped, rotated, dropped, untouched };
inline constexpr std::array kGraspOutcomes{"lifted", "slipped", "rotated", "dropped", "untouched"};

// A held object has slipped or turned from here on; one that rose by less than a part of the hand's way is dropped.
inline constexpr double kSlipped_m = 1e-3, kTurned_rad = 5.0 * std::numbers::pi / 180.0, kDroppedPart = 0.2;

/// Since it was freed.
struct HeldMotion {
  bool ever_touched = true;             // by any finger, in any frame
  bool touched = true;                  // by all fingers, at the end
  double slip_m = 0.0, turn_rad = 0.0;  // in the hand without creep: of its point at the grip, and of the object
  double rise_m = 0.0, hand_rise_m = 0.0;
};

inline GraspOutcome outcome_of(const HeldMotion& held) {
  const bool left_behind = held.hand_rise_m >= kSlipped_m && held.rise_m < kDroppedPart * held.hand_rise_m;
  return !held.ever_touched             ? GraspOutcome::untouched
         : !held.touched || left_behind ? GraspOutcome::dropped
         : held.slip_m >= kSlipped_m    ? GraspOutcome::slipped
         : held.turn_rad >= kTurned_rad ? GraspOutcome::rotated
                                        : GraspOutcome::lifted;
}

}  // namespace tacipc
