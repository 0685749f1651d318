#include "stages/study/metrics/image_pairs.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace image_pairs_test {

namespace fs = std::filesystem;

TEST(PairImages, FoldersPairByRelativeNameInOrder) {
  const ScratchFolder folder;
  for (const char* name : {"a/z.png", "a/sub/b.png", "a/note.txt", "a/.partial-render/c.png", "b/z.png", "b/sub/b.png"})
    folder.file(name, "");
  const auto pairs = pair_images({folder / "a"}, {folder / "b"}, ".png");
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].name, "sub/b.png");
  EXPECT_EQ(pairs[1].name, "z.png");
  EXPECT_EQ(pairs[1].image, folder / "a/z.png");
  EXPECT_EQ(pairs[1].reference, folder / "b/z.png");
  EXPECT_EQ(pair_images({(folder / "a").string() + "/"}, {folder / "b"}, "z.png").size(), 1u);
}

TEST(PairImages, MissingCounterpartsAreNamedEitherWay) {
  const ScratchFolder folder;
  for (const char* name : {"a/1.png", "a/2.png", "a/3.png", "b/2.png"}) folder.file(name, "");
  const std::string a = (folder / "a").string(), b = (folder / "b").string();
  EXPECT_EQ(message_of<DataError>([&] { pair_images({a}, {b}, ".png"); }),
            a + "/1.png has no counterpart in " + b + " and 1 more");
  EXPECT_EQ(message_of<DataError>([&] { pair_images({b}, {a}, "3.png"); }),
            b + ": holds no file whose name ends with 3.png");
  fs::remove(folder / "a/3.png");
  EXPECT_EQ(message_of<DataError>([&] { pair_images({b}, {a}, ".png"); }), a + "/1.png has no counterpart in " + b);
}

TEST(PairImages, EmptyFolder) {
  const ScratchFolder folder;
  fs::create_directories(folder / "a");
  folder.file("b/1.png", "");
  EXPECT_EQ(message_of<DataError>([&] { pair_images({folder / "a"}, {folder / "b"}, ".png"); }),
            (folder / "a").string() + ": holds no file whose name ends with .png");
}

TEST(PairImages, ListsPairInOrderAndAreNamedBelowTheirCommonFolder) {
  const auto pairs = pair_images({"out/star/t.png", "out/./gear/t.png"}, {"real/9.png", "real/7.png"}, ".png");
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].name, "star/t.png");
  EXPECT_EQ(pairs[1].name, "gear/t.png");
  EXPECT_EQ(pairs[1].reference, "real/7.png");
  EXPECT_EQ(pair_images({"only.png"}, {"real/1.png"}, ".png")[0].name, "only.png");
  EXPECT_EQ(pair_images({"a/b/only.png"}, {"real/1.png"}, ".png")[0].name, "only.png");
}

TEST(PairImages, ListsOfDifferentLengthOrWithFoldersAreRefused) {
  const ScratchFolder folder;
  EXPECT_EQ(message_of<UsageError>([] {
              pair_images({"a.png", "b.png"}, {"c.png"}, ".png");
            }),
            "2 images but 1 references: lists are compared pair by pair");
  const std::string root = (folder / "").string();
  EXPECT_EQ(message_of<UsageError>([&] { pair_images({root}, {"c.png"}, ".png"); }),
            root + ": give one folder each, or files only");
}

}  // namespace image_pairs_test
}  // namespace tacipc
