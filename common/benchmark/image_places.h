// Which frames of a press are pictured, where in the image; and how such a place is found on a photograph.
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

/// Where the object's centre line and its x axis appear.
struct ImagePlace {
  double x_px = 0.0;  // pixel whose middle it is
  double y_px = 0.0;
  double yaw_rad = 0.0;  // from x towards y
};

/// Where the contact of a ball appears, and how large.
struct ContactPlace {
  ImagePlace center;
  double radius_px = 0.0;
};

struct NamedFrame {
  std::string name;                     // of the image, and of the photograph without its ending
  int frame = 0;                        // of the press, or …
  std::optional<ContactPlace> contact;  // … between frames, as deep as this contact of a ball wants
};

/// The image the place is fitted to, and the part of it that counts.
struct PlaceFit {
  std::string image;
  std::array<int, 4> box_px{};  // x, y, width, height
  bool yaw = true;              // a ball has none
};

struct ImagePlaces {
  std::vector<NamedFrame> images;
  ImagePlace place;  // of all images, unless each has a contact
  std::optional<PlaceFit> fit;
  std::optional<double> ball_radius_m;  // images are told by their contacts

  static ImagePlaces read(ConfigReader& in);
};

/// The rigid motion from the origin to a place: Rz(yaw), then the translation. \throw DataError if the camera does not
/// see the front face there
Matrix4 place_pose(const ImagePlace& place, const Sensor& sensor);

struct FittedPlace {
  ImagePlace place;
  double rmse_before = 0.0;  // codes, in the box
  double rmse_after = 0.0;
  int views = 0;  // images computed

  /// As a record repeats it.
  Value to_value(const std::string& image) const;
};

/// Minimises over centre and yaw (if asked) the square sum, over the box, of the image made at a place − photograph
/// less each channel's mean difference outside the box. Pattern search: steps of 1 pixel and 1 degree both ways along
/// each parameter, halved when none improves it, until 1/32: the result does not depend on derivatives of a tessellated
/// surface.
FittedPlace search_place(const ImagePlace& start, const PlaceFit& fit, const ByteImage& photograph,
                         const std::function<ByteImage(const ImagePlace&)>& image_at);

}  // namespace tacipc
