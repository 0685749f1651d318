// An object as one file: the unit of its mesh and which side is up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/placement.h"

namespace tacipc {

/// configs/objects/*.yaml
struct ObjectSpec {
  std::string unit;               // of the mesh file: m, cm, mm, um or in
  std::optional<std::string> up;  // side of the mesh that looks away from the gel: +x -x +y -y +z -z

  static ObjectSpec read(ConfigReader& in) {
    ObjectSpec spec;
    spec.unit = in.choice("unit", {"m", "cm", "mm", "um", "in"});
    if (in.has("up")) spec.up = in.choice("up", face_names());
    return spec;
  }
};

}  // namespace tacipc
