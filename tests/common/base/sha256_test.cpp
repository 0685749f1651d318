#include "common/base/sha256.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace sha256_test {

TEST(Sha256, AgreesWithTheStandardsExamples) {
  // FIPS 180-4's own: one block, two blocks, a million letters.
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256, OfAFile) {
  const ScratchFolder scratch;
  const std::string bytes(200'000, 'x');
  EXPECT_EQ(sha256_of_file(scratch.file("x", bytes)), sha256(bytes)) << "read in parts";
  EXPECT_EQ(sha256_of_file(scratch.file("empty", "")), sha256(""));
  EXPECT_THROW(sha256_of_file(scratch / "nowhere"), DataError);
}

TEST(Sha256, BesideAFileTellsWhetherItIsWhole) {
  const ScratchFolder scratch;
  const auto file = scratch.file("a shard.h5", "abc");
  const std::string name = file.string(), make = " > 'a shard.h5.sha256')";
  EXPECT_EQ(message_of<DataError>([&] { checked_sha256(file); }),
            name + ": there is no a shard.h5.sha256 beside it to tell whether it is whole; if you trust it: (cd '" +
                file.parent_path().string() + "' && sha256sum 'a shard.h5'" + make);
  ASSERT_EQ(
      std::system(("cd '" + file.parent_path().string() + "' && sha256sum 'a shard.h5' > 'a shard.h5.sha256'").c_str()),
      0);
  EXPECT_EQ(checked_sha256(file), sha256("abc"));
  const std::string good = read_file(name + ".sha256");
  for (const std::string& told :
       {std::string(), good.substr(0, 40), "0" + good.substr(1), sha256("abc") + "  other\n"}) {
    scratch.file("a shard.h5.sha256", told);
    EXPECT_EQ(message_of<DataError>([&] { checked_sha256(file); }),
              name + ": is damaged, or not the file that a shard.h5.sha256 is of: its SHA-256 is " + sha256("abc"))
        << told;
  }
  scratch.file("a shard.h5.sha256", good);
  scratch.file("a shard.h5", "abd");
  EXPECT_THROW(checked_sha256(file), DataError);
  std::filesystem::remove(file);
  EXPECT_EQ(message_of<DataError>([&] { checked_sha256(file); }), name + ": does not exist");
}

}  // namespace sha256_test
}  // namespace tacipc
