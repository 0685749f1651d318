// Presses of known objects, which calibrate in addition to the balls: their walls and shadows add information.
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

/// One entry of the file in `--objects`, which the stage cases makes.
struct KnownObjectConfig {
  std::string name;
  std::string photograph;  // file below --photographs
  int frame = 0;           // frame of the object's press
  std::array<double, 2> center_px{};
  std::array<int, 4> box_px{};  // x, y, width, height: pixels inside enter the fit, pixels outside determine the drift
  bool fit_yaw = false;

  bool inside(int x, int y) const {
    return x >= box_px[0] && x < box_px[0] + box_px[2] && y >= box_px[1] && y < box_px[1] + box_px[3];
  }
  /// Copy with a box that is wider by the margin on each side, because shadows reach beyond a box around the contact.
  KnownObjectConfig grown(int margin_px) const;
};

/// Samples of the pixels in the object's box, minus the drift of the pixels outside.
Samples object_samples(const KnownObjectConfig& known, const ByteImage& photograph, const ByteImage& background,
                       int stride);

/// File made by the stage cases: `objects: [{name, photograph, frame, center_px, box_px, yaw}]`.
struct KnownObjectsConfig {
  std::vector<KnownObjectConfig> objects;
  static KnownObjectsConfig read(ConfigReader& in);
};

/// A simulated press above the origin of S, its position on the photograph, and its visible samples.
struct KnownObject : Contact {
  KnownObjectConfig known;
  Triangles triangles;          // empty: the view is given and stays
  Positions front;              // positions of the front
  Positions front_before = {};  // positions in the previous frame, if that is already a press
  double origin_z_m = 0.0;      // height of the object's origin, in this frame and the previous one
  double origin_z_before_m = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;              // rotation about z, from x towards y
  double left_out_rmse_codes = 0.0;  // error under the light of all other photographs
  double left_out_blocks_rmse_codes =
      0.0;  // error of blocks of its pixels under the light of all other data, including its other pixels
};

/// Membrane of the object at its position.
MembraneView view_object(const KnownObject& object, const Sensor& sensor);

/// Fits the centre and, if requested, the yaw to the photograph by Gauss–Newton; the light stays.
void fit_object(KnownObject& object, const Sensor& sensor, const LightField& light);

}  // namespace tacipc
