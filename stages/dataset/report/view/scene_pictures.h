// Draws a scene at a few instants, all from the viewpoint that shows the moving bodies best.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "stages/dataset/report/timeline.h"
#include "stages/dataset/report/view/raster.h"
#include "stages/dataset/report/view/scene_view.h"

namespace tacipc {

/// Instant that is shown, by its index among the frames of the view.
struct PicturedInstant {
  std::size_t shown = 0;
  std::string what;  // "start", "first contact", "end"; empty: in between
};

/// Instants of the pictures, without duplicates: the start, the first contact, two in between and the end.
/// \param first_contact frame of the scene; absent: no contact, and three in between
std::vector<PicturedInstant> pictured_instants(const SceneView& view, std::optional<int> first_contact);

/// Colours of the pictures, which captions name.
namespace picture_colors {
inline constexpr Color kGel{120, 190, 214}, kObject{232, 148, 72}, kSoft{140, 190, 170}, kFixed{214, 206, 192},
    kRobot{140, 148, 160};
}  // namespace picture_colors

/// Viewpoint across the direction in which the first gel looks, from somewhat above. It is so near that the gels, all
/// freely moving bodies, and the robot's parts next to them just fit at every instant.
/// \pre the view has a gel
Viewpoint scene_viewpoint(const SceneView& view, double aspect);

/// Pictures in a row, each with its label above it. `frames` are all frames of the scene.
ByteImage scene_pictures(const SceneView& view, const std::vector<PicturedInstant>& instants,
                         const std::vector<Instant>& frames, int width, int height);

}  // namespace tacipc
