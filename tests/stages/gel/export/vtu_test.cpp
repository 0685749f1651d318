#include "stages/gel/export/vtu.h"

#include <gmock/gmock.h>

#include "tests/stages/gel/export/vtu_reader.h"

namespace tacipc {
namespace vtu_test {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

TEST(Vtu, TrianglesComeBackBitByBit) {
  const VtuGrid grid{.points = Positions{{0.1, 0, 1e-310}, {1, 0, 0}, {0, 1, 0}, {-1e300, 1, 0}},
                     .cells = Triangles{{0, 1, 2}, {1, 3, 2}},
                     .point_data = {{"force", 3, std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0.1}},
                                    {"state", 1, std::vector<std::uint8_t>{0, 1, 2, 255}}},
                     .cell_data = {{"ratio", 1, std::vector<double>{0.5, -0.25}}}};
  const VtuFile file = parse_vtu(vtu_bytes(grid));
  EXPECT_EQ(file.points, 4u);
  EXPECT_EQ(file.cells, 2u);
  EXPECT_EQ(file.arrays.size(), 7u);
  EXPECT_THAT(file.arrays.at("Points").values, ElementsAre(0.1, 0, 1e-310, 1, 0, 0, 0, 1, 0, -1e300, 1, 0));
  EXPECT_THAT(file.arrays.at("connectivity").values, ElementsAre(0, 1, 2, 1, 3, 2));
  EXPECT_THAT(file.arrays.at("offsets").values, ElementsAre(3, 6));
  EXPECT_THAT(file.arrays.at("types").values, ElementsAre(5, 5));
  EXPECT_THAT(file.arrays.at("force").values, ElementsAreArray({1., 2., 3., 4., 5., 6., 7., 8., 9., 10., 11., 0.1}));
  EXPECT_EQ(file.arrays.at("force").section, "PointData");
  EXPECT_EQ(file.arrays.at("force").components, 3u);
  EXPECT_THAT(file.arrays.at("state").values, ElementsAre(0, 1, 2, 255));
  EXPECT_THAT(file.arrays.at("ratio").values, ElementsAre(0.5, -0.25));
  EXPECT_EQ(file.arrays.at("ratio").section, "CellData");
}

TEST(Vtu, TetrahedraHaveTheirType) {
  const VtuGrid grid{.points = Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                     .cells = Tetrahedra{{0, 1, 2, 3}}};
  const VtuFile file = parse_vtu(vtu_bytes(grid));
  EXPECT_THAT(file.arrays.at("connectivity").values, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(file.arrays.at("offsets").values, ElementsAre(4));
  EXPECT_THAT(file.arrays.at("types").values, ElementsAre(10));
}

TEST(Pvd, ListsFilesWithTheirTimes) {
  EXPECT_EQ(pvd_text({{0.0, "surface_0000.vtu"}, {0.01, "surface_0001.vtu", 1}}),
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
            "  <Collection>\n"
            "    <DataSet timestep=\"0\" part=\"0\" file=\"surface_0000.vtu\"/>\n"
            "    <DataSet timestep=\"0.01\" part=\"1\" file=\"surface_0001.vtu\"/>\n"
            "  </Collection>\n</VTKFile>\n");
}

}  // namespace vtu_test
}  // namespace tacipc
