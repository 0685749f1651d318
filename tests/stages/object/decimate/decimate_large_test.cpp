#include <gtest/gtest.h>

#include "stages/object/decimate/decimate_object.h"
#include "stages/object/decimate/self_intersection.h"
#include "stages/object/decimate/surface_topology.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace decimate_large_test {

TEST(DecimateLarge, HalfAMillionVerticesBecomeEightThousand) {
  const TriangleMesh torus = bumpy_torus(0.004, 0.0015, 0.05, 1000, 500);
  const auto config = read_config<DecimateConfig>(TACIPC_SOURCE_DIR "/configs/objects/decimate/default.yaml");
  const DecimatedObject object = decimate_object(torus, config);
  EXPECT_EQ(object.mesh.num_vertices(), 8000);
  EXPECT_TRUE(is_closed_manifold(object.mesh));
  EXPECT_TRUE(self_intersections(object.mesh).empty());
  EXPECT_LT(hausdorff_distance(torus, object.mesh, config.hausdorff).max_m(), 2e-5);
}

}  // namespace decimate_large_test
}  // namespace tacipc
