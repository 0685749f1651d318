// Presses of known objects that calibrate beside the balls: their walls and shadows show what balls do not.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"
#include "common/sample/front_frames.h"
#include "common/sensor/sensor.h"
#include "stages/image/calibrate/samples.h"

namespace tacipc {

/// One entry of the file that `--objects` names (made by the stage cases).
struct KnownObjectConfig {
  std::string name;
  std::string photograph;  // file below --photographs
  int frame = 0;           // of the object's press
  std::array<double, 2> center_px{};
  std::array<int, 4> box_px{};  // x, y, width, height: these pixels enter the fit, those outside tell the drift
  bool fit_yaw = false;

  bool inside(int x, int y) const {
    return x >= box_px[0] && x < box_px[0] + box_px[2] && y >= box_px[1] && y < box_px[1] + box_px[3];
  }
  /// The same with a box wider by the margin on each side: shadows reach beyond a box about the contact.
  KnownObjectConfig grown(int margin_px) const;
};

/// The pixels in its box, less the drift that those outside tell.
Samples object_samples(const KnownObjectConfig& known, const ByteImage& photograph, const ByteImage& background,
                       int stride);

/// configs made by the stage cases: `objects: [{name, photograph, frame, center_px, box_px, yaw}]`
struct KnownObjectsConfig {
  std::vector<KnownObjectConfig> objects;
  static KnownObjectsConfig read(ConfigReader& in);
};

/// A simulated press over the origin of S, where it is on its photograph, and what is seen of it.
struct KnownObject : Contact {
  KnownObjectConfig known;
  Triangles triangles;          // none: the view is given and stays
  Positions front;              // m
  Positions front_before = {};  // of the frame before, if that is a press already
  double origin_z_m = 0.0;      // of the object, in both frames
  double origin_z_before_m = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;                     // about z, from x towards y
  double left_out_rmse_codes = 0.0;         // under the light of all other photographs
  double left_out_blocks_rmse_codes = 0.0;  // of blocks of its pixels under the light of all else, its others included
};

/// Its membrane where it is.
MembraneView view_object(const KnownObject& object, const Sensor& sensor);

/// Centre and, if asked, yaw by Gauss–Newton on the photograph under the light as it is.
void fit_object(KnownObject& object, const Sensor& sensor, const LightField& light);

}  // namespace tacipc
