// An object as one file: the unit of its mesh, its scale and which side is up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/placement.h"

namespace tacipc {

/// configs/objects/*.yaml
struct ObjectSpec {
  static constexpr const char* kAutoUnit = "auto";  // what the file, else its name, else millimetres say

  std::string unit;               // of the mesh file: m, cm, mm, um, in or auto
  std::optional<std::string> up;  // side of the mesh that looks away from the gel: +x -x +y -y +z -z
  double scale = 1.0;             // of the mesh, after its unit
  bool fit_window = false;        // `scale: fit`: to the sensor's window

  static ObjectSpec read(ConfigReader& in) {
    ObjectSpec spec;
    spec.unit = in.choice("unit", {"m", "cm", "mm", "um", "in", kAutoUnit});
    if (in.has("up")) spec.up = in.choice("up", face_names());
    if (in.text_or("scale", "1") == "fit")
      spec.fit_window = true;
    else
      spec.scale = in.number_or("scale", spec.scale, Range::positive());
    return spec;
  }
};

}  // namespace tacipc
