#include "stages/image/shade/fit_place.h"

#include "common/optics/seen_membrane.h"

namespace tacipc {

Positions at_place(const Positions& front, const ImagePlace& place, const Sensor& sensor) {
  const Matrix4 pose = place_pose(place, sensor);
  return moved(front, pose(0, 3), pose(1, 3), place.yaw_rad);
}

FittedPlace fit_place(const FrontFrames& press, int frame, const ImagePlace& start, const PlaceFit& fit,
                      const ByteImage& photograph, const ByteImage& background, const LightField& light,
                      const Sensor& sensor) {
  return search_place(start, fit, photograph, [&](const ImagePlace& place) {
    const auto& front = press.frames[static_cast<std::size_t>(frame)];
    const MembraneView view = view_membrane(at_place(front, place, sensor), press.triangles, sensor);
    return add_change(background, code_change(light, view));
  });
}

}  // namespace tacipc
