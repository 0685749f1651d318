#include "common/sample/body_keys.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/config_text.h"

namespace tacipc {
namespace body_keys_test {

using ::testing::ElementsAre;

struct Body {
  std::string name;
  BodyMass mass;
  Vector3 at_m, turn_rad;

  static Body read(ConfigReader& in) {
    return {read_body_name(in, "name"), read_body_mass(in), read_triple(in, "at_mm", 1e-3), read_turn(in, "turn_deg")};
  }
};

TEST(BodyKeys, AreInSi) {
  const Body body =
      config_from_text<Body>("{name: a_B-1, mass_g: 30, at_mm: [1, 2, 3], turn_deg: [0, 90, 0]}", "b.yaml");
  EXPECT_EQ(body.name, "a_B-1");
  EXPECT_EQ(body.mass.mass_of(1e-5), 0.03);
  EXPECT_DOUBLE_EQ(body.mass.density_of(1e-5), 3000.0);
  EXPECT_LT((body.at_m - Vector3(1e-3, 2e-3, 3e-3)).norm(), 1e-18);
  EXPECT_DOUBLE_EQ(body.turn_rad.y(), 0.5 * std::numbers::pi);
  const Body dense = config_from_text<Body>("{name: a, density_kg_m3: 2000}", "b.yaml");
  EXPECT_DOUBLE_EQ(dense.mass.mass_of(1e-5), 0.02);
  EXPECT_EQ(dense.mass.density_of(1e-5), 2000.0);
  EXPECT_EQ(dense.at_m, Vector3::Zero());
}

TEST(BodyKeys, NamesAndMassesThatAreNoneAreSaid) {
  EXPECT_THAT(faults_in<Body>("{name: a/b, mass_g: 1, density_kg_m3: 2}", "b.yaml"),
              ElementsAre("b.yaml:1:8: name: a name has letters, digits, _ and - alone",
                          "b.yaml:1:39: density_kg_m3: give mass_g or density_kg_m3, not both"));
  EXPECT_THAT(faults_in<Body>("{name: a}", "b.yaml"), ElementsAre(testing::HasSubstr("density_kg_m3")));
}

}  // namespace body_keys_test
}  // namespace tacipc
