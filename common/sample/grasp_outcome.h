// Outcome of a grasp, decided by the object's motion in the hand and by contact alone. All callers use this definition.
#pragma once

#include <array>
#include <numbers>

namespace tacipc {

/// Outcome: the first that applies in the order untouched, dropped, slipped, rotated, lifted; see docs/grasp.md.
enum class GraspOutcome { lifted, slipped, rotated, dropped, untouched };
inline constexpr std::array kGraspOutcomes{"lifted", "slipped", "rotated", "dropped", "untouched"};

// Thresholds: slip, rotation, and the object's rise over the hand's rise, below which the object is dropped.
inline constexpr double kSlipped_m = 1e-3, kTurned_rad = 5.0 * std::numbers::pi / 180.0, kDroppedPart = 0.2;

/// Motion of an object since it was freed.
struct HeldMotion {
  bool ever_touched = true;             // whether any finger touched it in any frame
  bool touched = true;                  // whether all fingers touch it at the end
  double slip_m = 0.0, turn_rad = 0.0;  // displacement of its grip point and its rotation, in the hand, without creep
  double rise_m = 0.0, hand_rise_m = 0.0;  // heights gained by the object and the hand
};

/// Returns the outcome.
inline GraspOutcome outcome_of(const HeldMotion& held) {
  const bool left_behind = held.hand_rise_m >= kSlipped_m && held.rise_m < kDroppedPart * held.hand_rise_m;
  return !held.ever_touched             ? GraspOutcome::untouched
         : !held.touched || left_behind ? GraspOutcome::dropped
         : held.slip_m >= kSlipped_m    ? GraspOutcome::slipped
         : held.turn_rad >= kTurned_rad ? GraspOutcome::rotated
                                        : GraspOutcome::lifted;
}

}  // namespace tacipc
