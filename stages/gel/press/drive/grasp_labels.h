// Labels of a grasp beside its outcome: when each finger's contact slips, and why the object was not held;
// docs/grasp.md.
#pragma once

#include <numbers>

#include "common/sample/held_path.h"
#include "stages/gel/press/drive/grasp_frame.h"

namespace tacipc {

/// Share of a finger's normal force on vertices that slip from which its contact has begun to slip; as a whole it does
/// from kGrossSlipShare on.
inline constexpr double kFirstSlipShare = 0.05;
/// By how much the object moves in the hand meanwhile, a tenth of what an outcome wants: more than it creeps, or than
/// the gels give when it is freed.
inline constexpr double kGrossSlip_m = 0.1e-3, kGrossTurn_rad = 0.5 * std::numbers::pi / 180.0;

/// Of both grips together, by which one may exceed the other.
inline constexpr double kUneven = 0.1;

/// Of a frame of a finger, with the normal forces nᵥ > 0 on the vertices of its front: Σ_slip nᵥ / Σ nᵥ, and
/// Σ nᵥ |xᵥ − c| / Σ nᵥ with c = Σ nᵥ xᵥ / Σ nᵥ in the plane x, y of S. Zeros where nothing touches.
FingerContact finger_contact(const FrontSurface& front, const Frame& frame);

/// Fills contacts, and of every frame up to the one that is judged its creep and what is slip without it.
/// \pre judged_frame and all else is there
void measure_creep(Grasp& grasp);

/// Fills friction_use, slips and reason. \pre all else is there
void add_labels(Grasp& grasp);

/// Fills judged_frame, creep and outcome, then the labels. \pre frames and fingers are complete, freed_frame is known
void judge_outcome(Grasp& grasp);

}  // namespace tacipc
