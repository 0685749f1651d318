// What shade is to picture: named frames of a press at a place of the image.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"

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

struct ShadeConfig {
  std::vector<NamedFrame> images;
  ImagePlace place;  // of all images, unless each has a contact
  std::optional<PlaceFit> fit;
  std::optional<double> ball_radius_m;  // images are told by their contacts

  static ShadeConfig read(ConfigReader& in);
};

}  // namespace tacipc
