#include "stages/rival/baseline/simulator.h"

#include <gtest/gtest.h>

#include "common/config/config.h"
#include "stages/rival/baseline/kernel.h"

namespace tacipc {
namespace simulator_test {

constexpr double kFrontM = 30e-3;

/// Code of a grey photograph of 200 beside one deep pixel in the middle, without lights; x pixels from it.
std::uint8_t code_beside(const std::string& configuration, int x) {
  auto config = read_config<BaselineConfig>(std::string(TACIPC_SOURCE_DIR) + "/configs/rivals/baseline/" +
                                            configuration + ".yaml");
  config.texture_sigma_m = 0.0;
  config.phong.value().lights.clear();
  Sensor sensor;
  sensor.camera = {.position_m = {0.0, 0.0, -kFrontM},
                   .width_px = 40,
                   .height_px = 30,
                   .window_width_m = 8e-3,
                   .window_height_m = 6e-3};
  const BaselineSimulator simulator(config, sensor, ByteImage(40, 30, 3, 200), std::nullopt);
  SeenObject seen{.depth = Raster(40, 30, kFrontM)};
  seen.depth.at(20, 15) = kFrontM - 40e-3 * 0.5;  // half of the gel's 4 mm times ten: darker than black
  return simulator.frame(seen).tactile.value().at(20 + x, 15, 0);
}

TEST(Darkening, OfTheOlderKernelIsByTheMembraneOfTheOthersByTheObject) {
  // 0.8 · 200 = 160 fades over 4 mm by 20 mm times the kernel's weight, 201 / (200 + e^3) / Σ at three pixels.
  const double weight = exponential_kernel().at(9, 6);
  EXPECT_EQ(code_beside("exponential_13", 3), static_cast<int>(160.0 * (1.0 - 5.0 * weight)));
  EXPECT_EQ(code_beside("exponential_13", 8), 160) << "beyond the kernel";
  EXPECT_EQ(code_beside("tacchi", 3), 160);
  EXPECT_EQ(code_beside("tacchi", 0), 0);
}

}  // namespace simulator_test
}  // namespace tacipc
