// configs/decimate/*.yaml
#pragma once

#include "common/config.h"
#include "stages/decimate/decimate.h"
#include "stages/decimate/hausdorff.h"
#include "stages/decimate/mesh_doctor.h"

namespace tacipc {

struct DecimateConfig {
  CollapseConfig collapse;
  DoctorConfig doctor;
  HausdorffConfig hausdorff;

  static DecimateConfig read(ConfigReader& in);
};

}  // namespace tacipc
