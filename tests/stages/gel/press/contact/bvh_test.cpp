#include "stages/gel/press/contact/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/stages/gel/press/contact/random_points.h"

namespace tacipc {
namespace {

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
    EXPECT_EQ(bvh.num_boxes(), count);
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
  for (int part = 0; part < Bvh::kParts; ++part) a.overlaps(b, part, [&](int i, int j) { found.push_back({i, j}); });
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

TEST(Bvh, SameBoxesGiveTheSameOrder) {
  std::mt19937 random(10);
  const std::vector<Box> boxes = random_boxes(random, 500);
  const Box all(Vector3(-9, -9, -9), Vector3(9, 9, 9));
  EXPECT_EQ(found(Bvh(boxes), all), found(Bvh(boxes), all));
}

}  // namespace
}  // namespace tacipc
