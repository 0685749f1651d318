#include "stages/gel/press/contact/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/stages/gel/press/contact/random_points.h"

namespace tacipc {
namespace bvh_test {

Box random_box(std::mt19937& random, double size) {
  const Vector3 corner = random_vector(random);
  const Vector3 extent = size * random_vector(random).cwiseAbs();
  return {corner, corner + extent};
}

std::vector<Box> random_boxes(std::mt19937& random, int count) {
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i) boxes.push_back(random_box(random, i % 10 == 0 ? 1.0 : 0.1));
  return boxes;
}

const Box kEverywhere(Vector3(-99, -99, -99), Vector3(99, 99, 99));

std::vector<int> found(const Bvh& bvh, const Box& box) {
  std::vector<int> hits;
  bvh.query(box, [&](int i) { hits.push_back(i); });
  return hits;
}

std::vector<int> expected(const std::vector<Box>& boxes, const Box& box) {
  std::vector<int> hits;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    if (boxes[i].intersects(box)) hits.push_back(i);
  return hits;
}

void expect_same_as_brute_force(const Bvh& bvh, const std::vector<Box>& boxes, std::mt19937& random) {
  for (int i = 0; i < 100; ++i) {
    const Box box = random_box(random, i % 2 == 0 ? 0.5 : 0.01);
    std::vector<int> hits = found(bvh, box);
    std::sort(hits.begin(), hits.end());
    EXPECT_EQ(hits, expected(boxes, box)) << boxes.size() << " boxes";
  }
}

TEST(Bvh, FindsWhatBruteForceFinds) {
  std::mt19937 random(8);
  for (const int count : {0, 1, 2, 4, 5, 9, 100, 1000}) {
    const std::vector<Box> boxes = random_boxes(random, count);
    const Bvh bvh(boxes);
    expect_same_as_brute_force(bvh, boxes, random);
  }
}

TEST(Bvh, FindsWhatBruteForceFindsAfterRefit) {
  std::mt19937 random(9);
  Bvh bvh(random_boxes(random, 777));
  for (int round = 0; round < 3; ++round) {
    const std::vector<Box> boxes = random_boxes(random, 777);
    bvh.refit(boxes);
    expect_same_as_brute_force(bvh, boxes, random);
  }
}

std::vector<std::array<int, 2>> overlaps(const Bvh& a, const Bvh& b) {
  std::vector<std::array<int, 2>> found;
  const Bvh::NodePairs nodes = a.split(b);
  const std::size_t middle = nodes.size() / 3;
  const auto add = [&](int i, int j) { found.push_back({i, j}); };
  a.overlaps(b, nodes, middle, nodes.size(), add);
  a.overlaps(b, nodes, 0, middle, add);
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Bvh, OverlapsOfTwoTreesAreThoseOfAllTheirBoxes) {
  std::mt19937 random(10);
  for (const int count : {0, 1, 3, 20, 500}) {
    const std::vector<Box> first = random_boxes(random, count), second = random_boxes(random, 300);
    std::vector<std::array<int, 2>> expected;
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < 300; ++j)
        if (first[i].intersects(second[j])) expected.push_back({i, j});
    }
    EXPECT_EQ(overlaps(Bvh(first), Bvh(second)), expected);
  }
}

TEST(Bvh, OverlapsOfATreeWithItselfCountEachPairOnce) {
  std::mt19937 random(11);
  for (const int count : {0, 1, 2, 5, 400}) {
    const std::vector<Box> boxes = random_boxes(random, count);
    std::vector<std::array<int, 2>> expected;
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j)
        if (boxes[i].intersects(boxes[j])) expected.push_back({i, j});
    }
    const Bvh bvh(boxes);
    std::vector<std::array<int, 2>> found = overlaps(bvh, bvh);
    for (auto& pair : found) pair = {std::min(pair[0], pair[1]), std::max(pair[0], pair[1])};
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(Bvh, SharedFacesCountAndGapsDoNot) {
  const Box unit(Vector3(0, 0, 0), Vector3(1, 1, 1));
  const Bvh bvh(std::vector<Box>{unit});
  EXPECT_EQ(found(bvh, Box(Vector3(1, 0, 0), Vector3(2, 1, 1))).size(), 1u);
  EXPECT_EQ(found(bvh, Box(Vector3(1 + 1e-15, 0, 0), Vector3(2, 1, 1))).size(), 0u);
}

TEST(Bvh, SplitsManyEqualBoxes) {
  const std::vector<Box> boxes(100, Box(Vector3(0, 0, 0), Vector3(1, 1, 1)));
  EXPECT_EQ(found(Bvh(boxes), boxes[0]).size(), 100u);
}

/// Split at the median along the widest axis down to four, left before right, each leaf in the order of its boxes.
TEST(Bvh, OrderIsThatOfTheTreeByHand) {
  std::mt19937 random(10);
  std::vector<int> place(16);
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), random);
  for (int axis = 0; axis < 3; ++axis) {
    // Also side by side along another axis, but not as far.
    std::vector<Box> boxes;
    for (int i = 0; i < 16; ++i) {
      Vector3 corner = Vector3::Zero();
      corner[axis] = 3.0 * place[i];
      corner[(axis + 1) % 3] = 2.0 * (i % 5);
      boxes.emplace_back(corner, corner + Vector3(1, 1, 1));
    }
    std::vector<int> expected;
    for (int leaf = 0; leaf < 4; ++leaf) {
      for (int i = 0; i < 16; ++i)
        if (place[i] / 4 == leaf) expected.push_back(i);
    }
    EXPECT_EQ(found(Bvh(boxes), kEverywhere), expected) << "axis " << axis;
  }
  // Equal boxes are split by number.
  std::vector<int> in_order(100);
  std::iota(in_order.begin(), in_order.end(), 0);
  EXPECT_EQ(found(Bvh(std::vector<Box>(100, Box(Vector3(0, 0, 0), Vector3(1, 1, 1)))), kEverywhere), in_order);
}

TEST(Bvh, OrderDependsNeitherOnTheQueryNorOnWhereBoxesHaveMoved) {
  std::mt19937 random(10);
  const std::vector<Box> boxes = random_boxes(random, 500);
  Bvh bvh(boxes);
  const std::vector<int> order = found(bvh, kEverywhere);
  std::vector<int> some = order;
  const Box part = random_box(random, 1.0);
  std::erase_if(some, [&](int i) { return !boxes[i].intersects(part); });
  EXPECT_GT(some.size(), 10u);
  EXPECT_EQ(found(bvh, part), some);
  bvh.refit(random_boxes(random, 500));
  EXPECT_EQ(found(bvh, kEverywhere), order);
}

}  // namespace bvh_test
}  // namespace tacipc
