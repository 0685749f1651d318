#include "stages/image/shade/fit_place.h"

#include "common/optics/seen_membrane.h"

namespace tacipc {

Positions at_place(const Positions& front, const ImagePlace& place, const Sensor& sensor) {
  const Matrix4 pose = place_pose(place, sensor);
  return moved(front, pose(0, 3), pose(1, 3), place.yaw_rad);
}

MembraneView view_at(const FrontFrames& press, int frame, const ImagePlace& place, const PrintRelief* relief,
                     const Sensor& sensor) {
  MembraneView view = view_membrane(at_place(press.frames[frame], place, sensor), press.triangles, sensor);
  if (!relief) return view;
  const Matrix4 pose = place_pose(place, sensor);
  apply_relief(*relief, {pose(0, 3), pose(1, 3), place.yaw_rad, press.gel_from_object[frame](2, 3)}, view);
  return view;
}

FittedPlace fit_place(const FrontFrames& press, int frame, const ImagePlace& start, const PlaceFit& fit,
                      const ByteImage& photograph, const ByteImage& background, const LightField& light,
                      const Sensor& sensor, const PrintRelief* relief) {
  return search_place(start, fit, photograph, [&](const ImagePlace& place) {
    return add_change(background, code_change(light, view_at(press, frame, place, relief, sensor)));
  });
}

}  // namespace tacipc
