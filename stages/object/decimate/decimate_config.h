// Content of configs/objects/decimate/*.yaml.
#pragma once

#include "common/config/config.h"
#include "stages/object/decimate/decimate.h"
#include "stages/object/decimate/hausdorff.h"
#include "stages/object/decimate/mesh_doctor.h"

namespace tacipc {

/// Configuration of decimate.
struct DecimateConfig {
  CollapseConfig collapse;
  DoctorConfig doctor;
  HausdorffConfig hausdorff;

  static DecimateConfig read(ConfigReader& in);
};

}  // namespace tacipc
