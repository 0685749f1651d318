#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "stages/decimate/decimate_object.h"
#include "stages/decimate/self_intersection.h"
#include "stages/decimate/surface_topology.h"
#include "tests/decimate/shapes.h"

namespace tacipc {
namespace {

TEST(DecimateLarge, HalfAMillionVerticesBecomeEightThousand) {
  const TriangleMesh torus = bumpy_torus(0.004, 0.0015, 0.05, 1000, 500);
  const auto config = read_config<DecimateConfig>(TACIPC_SOURCE_DIR "/configs/decimate/default.yaml");
  const auto started = std::chrono::steady_clock::now();
  const DecimatedObject object = decimate_object(torus, config);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  std::printf("500,000 vertices: %.1f s\n%s", seconds, to_yaml(object.summary).c_str());
  EXPECT_EQ(object.mesh.num_vertices(), 8000);
  EXPECT_TRUE(is_closed_manifold(object.mesh));
  EXPECT_TRUE(self_intersections(object.mesh).empty());
  EXPECT_LT(hausdorff_distance(torus, object.mesh, config.hausdorff).max_m(), 2e-5);
  EXPECT_LT(seconds, 120.0);
}

}  // namespace
}  // namespace tacipc
