// Readers on valid files, on what fuzzing found before, and on some thousand mutations that are the same every time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <stdexcept>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/common/memory_limit.h"
#include "tests/fuzz/fuzzed_readers.h"
#include "tests/fuzz/mutation.h"

namespace tacipc {
namespace fuzz_test {

namespace fs = std::filesystem;
constexpr int kMutations = 1500;             // per reader
constexpr std::size_t kMemory = 1ULL << 30;  // bytes
constexpr unsigned kMostSeconds = 25;        // per input; then the alarm ends the process, and the input stays

const fs::path kFolder = fs::path(TACIPC_SOURCE_DIR) / "tests/fuzz";

/// In the order of their names; none if there is no such folder.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> seeds_of(const FuzzedReader& reader) { return files_in(kFolder / "corpus" / reader.name); }

bool out_of_memory = false;

/// While it lives, an input that wants more than a GiB is noticed, even where a library's caller turns that into a
/// refusal; one that takes too long ends the process.
class Limits {
 public:
  Limits() : memory_(kMemory), before_(std::set_new_handler(&fail)) {
    out_of_memory = false;
    ::alarm(kMostSeconds);
  }
  ~Limits() {
    ::alarm(0);
    std::set_new_handler(before_);
  }
  Limits(const Limits&) = delete;
  Limits& operator=(const Limits&) = delete;

 private:
  [[noreturn]] static void fail() {
    out_of_memory = true;
    throw std::bad_alloc();
  }
  MemoryLimit memory_;
  std::new_handler before_;
};

class Fuzz : public ::testing::TestWithParam<FuzzedReader> {};

TEST_P(Fuzz, SeedsAreRead) {
  const std::vector<fs::path> seeds = seeds_of(GetParam());
  EXPECT_FALSE(seeds.empty());
  for (const fs::path& seed : seeds) EXPECT_TRUE(read_input(GetParam(), read_file(seed))) << seed;
}

TEST_P(Fuzz, EarlierFindsStayMended) {
  for (const fs::path& find : files_in(kFolder / "finds" / GetParam().name)) {
    const std::string bytes = read_file(find);
    const Limits limits;
    EXPECT_NO_THROW(read_input(GetParam(), bytes)) << find;
    EXPECT_FALSE(out_of_memory) << find;
  }
}

TEST_P(Fuzz, MutationsAreReadOrRefused) {
  std::vector<std::string> seeds;
  for (const fs::path& seed : seeds_of(GetParam())) seeds.push_back(read_file(seed));
  Mutation mutation(seeds, kLongestInput);
  int refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::string bytes = mutation.next();
    const Limits limits;
    try {
      refused += read_input(GetParam(), bytes) ? 0 : 1;
    } catch (const std::exception& error) {
      FAIL() << "mutation " << i << ", left in " << input_file(GetParam()) << ": " << typeid(error).name() << ": "
             << error.what();
    }
    ASSERT_FALSE(out_of_memory) << "mutation " << i;
  }
  EXPECT_GT(refused, kMutations / 20);
  EXPECT_LT(refused, kMutations);
}

INSTANTIATE_TEST_SUITE_P(Readers, Fuzz, ::testing::ValuesIn(fuzzed_readers().begin(), fuzzed_readers().end()),
                         [](const auto& tested) { return tested.param.name; });

FuzzedReader reader_that(const std::function<void(const fs::path&)>& read) { return {"of_the_test", ".bin", read}; }

TEST(FuzzHarness, EveryReaderHasSeedsAndEveryFolderAReader) {
  std::vector<std::string> names, folders;
  for (const FuzzedReader& reader : fuzzed_readers()) names.push_back(reader.name);
  for (const fs::path& folder : files_in(kFolder / "corpus")) folders.push_back(folder.filename().string());
  EXPECT_THAT(folders, ::testing::UnorderedElementsAreArray(names));
  for (const fs::path& folder : files_in(kFolder / "finds"))
    EXPECT_NO_THROW(fuzzed_reader(folder.filename().string())) << folder;
}

TEST(FuzzHarness, OnlyClearRefusalsOfOurOwnPass) {
  const auto refusal = [](const std::string& reason) {
    return reader_that([reason](const fs::path& file) { throw DataError("{}: {}", file.string(), reason); });
  };
  EXPECT_TRUE(read_input(reader_that([](const fs::path& file) { read_file(file); }), "bytes"));
  EXPECT_FALSE(read_input(refusal("is too short"), "bytes"));
  EXPECT_THROW(read_input(refusal(std::string(2000, 'a')), "bytes"), std::logic_error);
  EXPECT_THROW(read_input(reader_that([](const fs::path&) { throw DataError("no file named"); }), ""),
               std::logic_error);
  EXPECT_THROW(read_input(reader_that([](const fs::path&) { throw SolverError("no reader's"); }), ""), SolverError);
  EXPECT_THROW(read_input(reader_that([](const fs::path&) { throw std::bad_alloc(); }), ""), std::bad_alloc);
}

TEST(FuzzHarness, TheFuzzersEntryReads) {  // of OBJ files, as this program is compiled
  const std::string valid = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", wrong = "f 1 2 3\n";
  for (const std::string& text : {valid, wrong})
    EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), 0);
}

TEST(FuzzHarness, ReadersSeeWhatTheFuzzerGives) {
  std::string seen;
  const std::string bytes("a\0b\r\n\xff", 6);
  read_input(reader_that([&](const fs::path& file) { seen = read_file(file); }), bytes);
  EXPECT_EQ(seen, bytes);
}

TEST(FuzzHarness, ExrTilesAreCountedBeforeTheLibraryMakesRoomForThem) {
  const FuzzedReader& exr = fuzzed_reader("exr");
  const fs::path tiles = kFolder / "finds/exr/tiles_4e6.exr";
  EXPECT_THAT([&] { exr.read(tiles); }, ::testing::ThrowsMessage<DataError>(::testing::HasSubstr("4000000 tiles")));
}

TEST(FuzzHarness, ChecksumsAreMadeRight) {
  const FuzzedReader& png = fuzzed_reader("png");
  const std::vector<fs::path> seeds = seeds_of(png);
  ASSERT_FALSE(seeds.empty());
  const std::string valid = read_file(seeds.front());
  std::string broken = valid;
  const std::size_t checksum_of_header = 8 + 8 + 13;
  broken[checksum_of_header] = static_cast<char>(broken[checksum_of_header] ^ 1);
  EXPECT_EQ(png.with_checksums(broken), valid);
  for (std::size_t size = 0; size < valid.size(); ++size) png.with_checksums(valid.substr(0, size));
}

TEST(FuzzHarness, MutationsAreTheSameEveryTime) {
  const std::vector<std::string> seeds{"solid a\nendsolid\n", "v 1 2 3\n"};
  Mutation once(seeds, 64), again(seeds, 64);
  int changed = 0;
  for (int i = 0; i < 200; ++i) {
    const std::string bytes = once.next();
    EXPECT_EQ(again.next(), bytes);
    EXPECT_LE(bytes.size(), 64u);
    changed += std::find(seeds.begin(), seeds.end(), bytes) == seeds.end() ? 1 : 0;
  }
  EXPECT_GT(changed, 180);
}

}  // namespace fuzz_test
}  // namespace tacipc
