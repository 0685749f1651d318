// Positions in the image at which frames of a press run are pictured, and the fit of such a position to a photograph.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"
#include "common/image/image.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Position of the object's axis, and direction of its x axis, in the image.
struct ImagePlace {
  double x_px = 0.0;  // pixel coordinates; a pixel's middle is a whole number
  double y_px = 0.0;
  double yaw_rad = 0.0;  // angle from x towards y
};

/// Position and radius of a ball's contact in the image.
struct ContactPlace {
  ImagePlace center;
  double radius_px = 0.0;
};

/// An image to make.
struct NamedFrame {
  std::string name;                     // name of the image, and of the photograph without its suffix
  int frame = 0;                        // frame of the press run, if there is no contact
  std::optional<ContactPlace> contact;  // contact of a ball, whose radius gives the depth (between frames)
};

/// Fit of the position to one image, within a box.
struct PlaceFit {
  std::string image;
  std::array<int, 4> box_px{};  // x, y, width, height
  bool yaw = true;              // fit the yaw; false for a ball
};

/// Contents of the file.
struct ImagePlaces {
  std::vector<NamedFrame> images;
  ImagePlace place;  // position of all images, unless each has a contact
  std::optional<PlaceFit> fit;
  std::optional<double> ball_radius_m;  // set if images are defined by contacts

  static ImagePlaces read(ConfigReader& in);
};

/// Returns the rigid motion from the origin to a position: Rz(yaw), then the translation.
/// \throw DataError if the camera does not see the front face there
Matrix4 place_pose(const ImagePlace& place, const Sensor& sensor);

/// Result of a fit.
struct FittedPlace {
  ImagePlace place;
  double rmse_before = 0.0;  // 8-bit levels, in the box
  double rmse_after = 0.0;
  int views = 0;  // number of images computed

  /// Returns the lines of a record.
  Value to_value(const std::string& image) const;
};

/// Fits centre and yaw (if asked). Minimises the sum of squares, over the box, of the difference between image and
/// photograph, minus each channel's mean difference outside the box. Uses pattern search, which needs no derivatives of
/// a tessellated surface: steps of 1 pixel and 1 degree both ways along each parameter, halved when none improves, down
/// to 1/32.
FittedPlace search_place(const ImagePlace& start, const PlaceFit& fit, const ByteImage& photograph,
                         const std::function<ByteImage(const ImagePlace&)>& image_at);

}  // namespace tacipc
