// Labels of a grasp in addition to its outcome: when each finger's contact slips, and why the object was not held;
// docs/grasp.md.
#pragma once

#include <numbers>

#include "common/sample/held_path.h"
#include "stages/gel/press/drive/grasp_frame.h"

namespace tacipc {

/// Fraction of a finger's normal force on slipping vertices at which slip begins. kGrossSlipShare is the fraction at
/// which the contact slips as a whole.
inline constexpr double kFirstSlipShare = 0.05;
/// Smallest displacement and rotation of the object in the hand during gross slip. They are a tenth of the limits of an
/// outcome, and larger than creep or the deformation of the gels when the object is freed.
inline constexpr double kGrossSlip_m = 0.1e-3, kGrossTurn_rad = 0.5 * std::numbers::pi / 180.0;

/// Grip forces are uneven if their difference exceeds this fraction of their sum.
inline constexpr double kUneven = 0.1;

/// Contact of a finger in one frame. With the normal forces nᵥ > 0 on the vertices of its front and c = Σ nᵥ xᵥ / Σ nᵥ
/// in the plane x, y of S:
/// - slip_share is Σ_slip nᵥ / Σ nᵥ,
/// - friction_radius_m is Σ nᵥ |xᵥ − c| / Σ nᵥ.
/// Both are zero without contact.
FingerContact finger_contact(const FrontSurface& front, const Frame& frame);

/// Fills contacts, and for every frame up to judged_frame its creep and its slip without creep.
/// \pre judged_frame and all other members are filled
void measure_creep(Grasp& grasp);

/// Fills friction_use, slips and reason. \pre all other members are filled
void add_labels(Grasp& grasp);

/// Fills judged_frame, creep and outcome, then the labels. \pre frames and fingers are complete, freed_frame is known
void judge_outcome(Grasp& grasp);

}  // namespace tacipc
