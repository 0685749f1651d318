#include "stages/dataset/plan/plan_checks.h"

#include <fmt/core.h>

#include "common/base/sobol.h"

namespace tacipc {
namespace {

constexpr long long kMaxSamples = 999999;  // an index has six digits

/// True if the centre of an object always lies on the gel.
bool on_gel(const MotionTemplate& motion, const GelShape& gel) {
  for (const double x : {motion.center_x_mm.low, motion.center_x_mm.high})
    for (const double y : {motion.center_y_mm.low, motion.center_y_mm.high})
      if (!gel.contains(1e-3 * x, 1e-3 * y)) return false;
  return true;
}

}  // namespace

std::vector<std::string> faults_of_plan(const DatasetConfig& config, const std::vector<Sensor>& sensors,
                                        const std::string& file) {
  std::vector<std::string> faults;
  long long of_an_object = 0;
  for (const MotionChoice& choice : config.motions) {
    of_an_object += (choice.motion.fingers ? 2 : 1) * static_cast<long long>(choice.samples);
    const int ranges = choice.motion.dimensions();
    if (config.low_discrepancy && ranges > kSobolDimensions)
      faults.push_back(fmt::format("{}: motion {}: {} ranges; sampling: low_discrepancy has at most {}", file,
                                   choice.name, ranges, kSobolDimensions));
    const double depth_mm = choice.motion.max_depth_mm();
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      const GelShape& gel = sensors[s].gel;
      if (depth_mm >= 1e3 * gel.thickness_m)
        faults.push_back(
            fmt::format("{}: motion {}: a press to {} mm is not possible in the gel of {}, {:.4g} mm thick", file,
                        choice.name, depth_mm, config.sensors[s].name, 1e3 * gel.thickness_m));
      if (!on_gel(choice.motion, gel))
        faults.push_back(fmt::format("{}: motion {}: some places of center_mm lie beside the gel of {}", file,
                                     choice.name, config.sensors[s].name));
    }
  }
  const auto all = of_an_object * static_cast<long long>(config.objects.size() * config.sensors.size());
  if (all > kMaxSamples)
    faults.push_back(fmt::format("{}: {} samples; a dataset has at most {}", file, all, kMaxSamples));
  return faults;
}

}  // namespace tacipc
