#include "common/stage/vouched.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace vouched_test {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class Vouched : public ::testing::Test {
 protected:
  void SetUp() override {
    write_file(root_ / "gel/mesh.msh", "mesh");
    write_file(root_ / "gel/maps/depth.exr", "depth");
    write_file(root_ / "gel/times.csv", "1 s");
    write_file(root_ / "gel/cut.yaml", "stage: cut\noutputs:\n  mesh.msh: " + content_hash(root_ / "gel/mesh.msh") +
                                           "\n  maps/depth.exr: " + content_hash(root_ / "gel/maps/depth.exr") +
                                           "\n  times.csv: varies\n  gone.csv: 00\n");
  }
  auto refused(const fs::path& input, const std::string& file) const {
    return std::pair([this, input] { refuse_changed_outputs(root_ / input, root_ / "out/copy.yaml"); },
                     ThrowsMessage<DataError>(AllOf(HasSubstr(file), HasSubstr("has changed since"),
                                                    HasSubstr("cut.yaml"), HasSubstr("copy it to another folder"))));
  }
  void accept(const fs::path& input) const { refuse_changed_outputs(root_ / input, root_ / "out/copy.yaml"); }

  ScratchFolder root_;
};

TEST_F(Vouched, WhatTheStageWrotePasses) {
  for (const char* input : {"gel", "gel/mesh.msh", "gel/maps", "gel/maps/depth.exr", "gel/times.csv"}) accept(input);
}

TEST_F(Vouched, AChangedFileIsNamedWithItsRecord) {
  write_file(root_ / "gel/mesh.msh", "mash");
  for (const char* input : {"gel", "gel/mesh.msh"}) {
    const auto [call, why] = refused(input, "mesh.msh");
    EXPECT_THAT(call, why) << input;
  }
  accept("gel/maps");
}

TEST_F(Vouched, ARecordOneFolderUpCounts) {
  write_file(root_ / "gel/maps/depth.exr", "dep");
  for (const char* input : {"gel", "gel/maps", "gel/maps/depth.exr"}) {
    const auto [call, why] = refused(input, "depth.exr");
    EXPECT_THAT(call, why) << input;
  }
  accept("gel/mesh.msh");
}

TEST_F(Vouched, WhatVariesOrNoRecordListsPasses) {
  write_file(root_ / "gel/times.csv", "2 s");
  write_file(root_ / "gel/notes.txt", "mine");
  for (const char* input : {"gel", "gel/times.csv", "gel/notes.txt", "gel/cut.yaml"}) accept(input);
}

TEST_F(Vouched, OnlyRecordsCount) {
  write_file(root_ / "gel/mesh.msh", "mash");
  fs::rename(root_ / "gel/cut.yaml", root_ / "gel/other.yaml");  // of another name than its stage
  accept("gel");
  fs::rename(root_ / "gel/other.yaml", root_ / "gel/cut.yaml");
  refuse_changed_outputs(root_ / "gel", root_ / "gel/cut.yaml");  // the asker's own
}

}  // namespace vouched_test
}  // namespace tacipc
