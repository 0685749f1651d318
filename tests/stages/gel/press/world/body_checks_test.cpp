#include "stages/gel/press/world/body_checks.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/make_mesh.h"

namespace tacipc {
namespace body_checks_test {

using ::testing::HasSubstr;

/// Two boxes as one surface, the second shifted by `by`.
TriangleMesh pair_of_boxes(const Vector3& by) {
  const TriangleMesh one = make_box({0, 0, 0}, {1, 1, 1});
  TriangleMesh both{Positions(16, 3), Triangles(24, 3)};
  both.positions << one.positions, one.positions.rowwise() + by.transpose();
  both.triangles << one.triangles, one.triangles.array() + 8;
  return both;
}

class BodyChecks : public ::testing::Test {
 protected:
  void add(const std::string& name, const TriangleMesh& mesh, bool deformable = false, bool fixed = false) {
    names_.push_back(std::make_unique<std::string>(name));
    meshes_.push_back(std::make_unique<TriangleMesh>(mesh));
    bodies_.push_back({*names_.back(), mesh.positions, meshes_.back()->triangles, deformable, fixed});
  }
  std::string verdict() const {
    try {
      EXPECT_EQ(judge_bodies(7, bodies_), 0);
    } catch (const VerdictError& error) {
      return error.what();
    }
    return "pass";
  }
  std::string start(double d_hat) const {
    try {
      require_apart(bodies_, ContactLaws({.d_hat_m = d_hat}));
    } catch (const DataError& error) {
      return error.what();
    }
    return "apart";
  }

 private:
  std::vector<std::unique_ptr<std::string>> names_;
  std::vector<std::unique_ptr<TriangleMesh>> meshes_;
  std::vector<BodyShape> bodies_;
};

TEST_F(BodyChecks, BodiesThatAreApartPass) {
  add("low", make_box({0, 0, 0}, {1, 1, 1}), true);
  add("high", make_box({0, 0, 1.5}, {1, 1, 2}));
  EXPECT_EQ(verdict(), "pass");
  EXPECT_EQ(start(0.4), "apart");
  EXPECT_EQ(start(0.6), "bodies low and high are 500 mm apart in frame 0: contact would begin at 600 mm already");
}

TEST_F(BodyChecks, IntersectingBodiesAreNamed) {
  add("low", make_box({0, 0, 0}, {1, 1, 1}));
  add("high", make_box({0.2, 0.3, 0.5}, {1.1, 1.2, 2}));
  EXPECT_THAT(verdict(), HasSubstr("frame 7: "));
  EXPECT_THAT(verdict(), HasSubstr("of low and high intersect"));
  EXPECT_EQ(start(0.01), "bodies low and high intersect where they begin");
}

TEST_F(BodyChecks, EveryDeformableBodyIsJudgedWithItselfTheLastOneToo) {
  add("sound", pair_of_boxes({3, 0, 0}), true);
  EXPECT_EQ(verdict(), "pass");
  add("crossed", pair_of_boxes({0.5, 0.4, 0.3}), true);
  for (int i = 0; i < 3; ++i) EXPECT_THAT(verdict(), HasSubstr("of crossed intersect"));
}

TEST_F(BodyChecks, ABodyInsideAnotherIsNamedWhicheverComesFirst) {
  add("inner", make_box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}));
  add("outer", make_box({0, 0, 0}, {1, 1, 1}));
  EXPECT_THAT(verdict(), HasSubstr("inner is inside outer"));
}

TEST_F(BodyChecks, TwoThatAreFixedMayDoWhatTheyLike) {
  add("inner", make_box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}), false, true);
  add("outer", make_box({0, 0, 0}, {1, 1, 1}), false, true);
  add("across", make_box({0.5, 0.5, 0.5}, {2, 2, 2}), false, true);
  EXPECT_EQ(verdict(), "pass");
  EXPECT_EQ(start(0.1), "apart");
}

}  // namespace body_checks_test
}  // namespace tacipc
