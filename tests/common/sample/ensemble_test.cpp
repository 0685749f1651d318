#include "common/sample/ensemble.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace ensemble_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kMembers =
    "members:\n"
    "  - name: m00\n"
    "    set:\n"
    "      material.youngs_modulus_pa: 4.1e5\n"
    "      gel.thickness_mm: 4.2\n"
    "  - name: m01\n"
    "    set:\n"
    "      material.poissons_ratio: 0.478\n";

class EnsembleFile : public ::testing::Test {
 protected:
  EnsembleFile() {
    scratch_.file("sensor.yaml", read_file(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/mctac.yaml"));
  }
  Ensemble read(const std::string& members) {
    return read_config<Ensemble>(scratch_.file("e.yaml", "title: of a test\nsensor: sensor.yaml\n" + members));
  }
  ScratchFolder scratch_;
};

TEST_F(EnsembleFile, IsWrittenAsItIsRead) {
  const Ensemble ensemble = read(kMembers);
  EXPECT_EQ(ensemble.title, "of a test");
  EXPECT_EQ(ensemble.sensor, (scratch_ / "sensor.yaml").lexically_normal());
  ASSERT_EQ(ensemble.members.size(), 2u);
  EXPECT_EQ(ensemble.members[0].name, "m00");
  EXPECT_THAT(ensemble.members[0].set,
              ElementsAre(std::pair("material.youngs_modulus_pa", "4.1e5"), std::pair("gel.thickness_mm", "4.2")));
  EXPECT_EQ(ensemble.yaml(scratch_ / "."), "title: of a test\nsensor: sensor.yaml\n" + kMembers);
}

TEST_F(EnsembleFile, MembersAreTheSensorWithTheirChanges) {
  const Ensemble ensemble = read(kMembers);
  const std::string sensor = read_file(scratch_ / "sensor.yaml"), changed = sensor_of(ensemble, ensemble.members[0]);
  EXPECT_THAT(changed, HasSubstr("  youngs_modulus_pa: 4.1e5  # paper\n"));
  EXPECT_THAT(changed, HasSubstr("  thickness_mm: 4.2       # paper\n"));
  EXPECT_THAT(sensor_of(ensemble, ensemble.members[1]), HasSubstr("  poissons_ratio: 0.478    # paper\n"));
}

TEST_F(EnsembleFile, KeysThatTheSensorHasNotAndValuesThatMakeNoneAreRefused) {
  const auto why = [&](const std::string& set) {
    const Ensemble ensemble = read("members:\n  - {name: a, set: {" + set + "}}\n  - {name: b, set: {}}\n");
    return message_of<ConfigError>([&] { sensor_of(ensemble, ensemble.members[0]); });
  };
  EXPECT_THAT(why("mount.compliance_mm_per_n: 0.1"),
              HasSubstr("member a:1:1: mount.compliance_mm_per_n: there is no such key"));
  EXPECT_THAT(why("material.poissons_ratio: 0.6"), HasSubstr("material.poissons_ratio: 0.6 is outside [0, 0.4999]"));
}

TEST_F(EnsembleFile, NamesMustBeOfFoldersAndTwoAreTheLeast) {
  EXPECT_THAT(
      faults_in<Ensemble>("title: t\nsensor: s.yaml\nmembers: [{name: nominal, set: {}}, {name: a/b, set: {}}, "
                          "{name: c, set: {}}, {name: c, set: {}}]\n",
                          "e.yaml"),
      ElementsAre(HasSubstr("members[0].name: nominal is the sensor"), HasSubstr("members[1].name: 'a/b': a name has"),
                  HasSubstr("members[3].name: is given twice")));
  EXPECT_THAT(faults_in<Ensemble>("title: t\nsensor: s.yaml\nmembers: [{name: a, set: {}}]\n", "e.yaml"),
              ElementsAre(HasSubstr("at least two")));
}

TEST(DatasetEnsemble, IsWrittenAsItIsReadAndPressesTheSensorItselfInAnotherMesh) {
  const DatasetEnsemble own{.title = "t", .sensor = "mctac", .members = {"a", "b"}};
  EXPECT_THAT(own.presses(), ElementsAre("a", "b"));
  DatasetEnsemble coarse = own;
  coarse.mesh = "tiny";
  EXPECT_THAT(coarse.presses(), ElementsAre("nominal", "a", "b"));
  for (const DatasetEnsemble& written : {own, coarse}) {
    const auto read = config_from_text<DatasetEnsemble>(written.yaml(), "e.yaml");
    EXPECT_EQ(read.title, "t");
    EXPECT_EQ(read.sensor, "mctac");
    EXPECT_EQ(read.mesh, written.mesh);
    EXPECT_EQ(read.members, written.members);
  }
}

}  // namespace ensemble_test
}  // namespace tacipc
