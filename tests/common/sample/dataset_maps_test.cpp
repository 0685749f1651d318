#include "common/sample/dataset_maps.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace dataset_maps_test {

DatasetMaps read(const std::string& text) {
  ConfigReader in = ConfigReader::from_text(text, "d.yaml");
  DatasetMaps maps = DatasetMaps::read(in);
  in.finish();
  return maps;
}

TEST(DatasetMaps, ComeInOneOrderAndGoThroughTheFileOfThePlan) {
  using enum FrameFile;
  const DatasetMaps maps = read("maps: [segment, tactile, depth, normal_preview]\n");
  EXPECT_THAT(maps.files, ::testing::ElementsAre(depth, tactile, segment, normal_picture));
  EXPECT_TRUE(maps.has(segment));
  EXPECT_FALSE(maps.has(normal));
  EXPECT_EQ(maps.yaml(), "# Made by the stage plan.\nmaps: [depth, tactile, segment, normal_preview]\n");
  EXPECT_EQ(read(maps.yaml()).files, maps.files);
}

TEST(DatasetMaps, WithoutAChoiceHaveWhatIsPackedAndNoPreviews) {
  using enum FrameFile;
  EXPECT_THAT(read("{}").files, ::testing::ElementsAre(depth, normal, indentation, traction, tactile, marker, contact,
                                                       stick_slip, segment));
}

TEST(DatasetMaps, AreRefusedWithTheirPlace) {
  EXPECT_THAT(message_of<ConfigError>([] { read("maps:\n  - tactile\n  - contcat\n"); }),
              ::testing::AllOf(::testing::HasSubstr("d.yaml:3:5: maps[1]: 'contcat' is not one of "),
                               ::testing::HasSubstr("(did you mean contact?)")));
  EXPECT_THAT(message_of<ConfigError>([] { read("maps: [depth]"); }),
              ::testing::HasSubstr("d.yaml:1:7: maps: tactile must be among them"));
  EXPECT_THAT(message_of<ConfigError>([] { read("maps: [basis, tactile]"); }),
              ::testing::HasSubstr("'basis' is not one of "));
}

}  // namespace dataset_maps_test
}  // namespace tacipc
