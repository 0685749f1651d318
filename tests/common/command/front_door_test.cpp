// The program tacipc as a user calls it.
#include "common/command/front_door.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <filesystem>

#include "tests/program_test.h"

namespace tacipc {
namespace front_door_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class FrontDoor : public ProgramTest {
 protected:
  void SetUp() override {
    // Stages of its own beside a copy: it finds them by where it is itself.
    std::filesystem::create_directories(scratch_ / "a b");
    std::filesystem::copy_file(std::filesystem::path(TACIPC_BIN_DIR) / "tacipc", scratch_ / "a b/tacipc");
  }
  void stage(const std::string& name, const std::string& script) {
    std::filesystem::permissions(scratch_.file("a b/" + name, "#!/bin/sh\n" + script + "\n"),
                                 std::filesystem::perms::owner_all);
  }
  int tacipc(const std::string& arguments) {
    const std::string printed = (scratch_ / "printed.txt").string();
    const int code = run_command(fmt::format("'{}' {} > '{}'", (scratch_ / "a b/tacipc").string(), arguments, printed));
    printed_ = read_file(printed);
    return code;
  }

  std::string printed_;
};

TEST_F(FrontDoor, PassesArgumentsThroughAndExitCodesBack) {
  stage("press", "printf '<%s>' \"$@\"; echo oops >&2; exit 7");
  EXPECT_EQ(tacipc("press --out 'x y' ''"), 7);
  EXPECT_EQ(printed_, "<--out><x y><>");
  EXPECT_EQ(said_, "oops\n");
  EXPECT_EQ(tacipc("help press"), 7);
  EXPECT_EQ(printed_, "<--help>");
}

TEST_F(FrontDoor, ListsCommandsAndStagesInGroups) {
  stage("press", "[ \"$*\" = --summary ] && echo 'Press hard.'");
  EXPECT_EQ(tacipc("help"), 0);
  EXPECT_THAT(printed_, HasSubstr("\nfiles\n  get            Values of a record"));
  EXPECT_THAT(printed_, HasSubstr("\ngel\n  tetmesh        not built (make -f Makefile.data build)\n"
                                  "  press          Press hard.\n"));
  EXPECT_EQ(said_, "");
  const std::string list = printed_;
  EXPECT_EQ(tacipc("--help"), 0);
  EXPECT_EQ(printed_, list);
  EXPECT_EQ(tacipc(""), 2);
  EXPECT_EQ(said_, list);
}

TEST_F(FrontDoor, UnknownAndMissingProgramsAreNamed) {
  EXPECT_EQ(tacipc("pres --out x"), 2);
  EXPECT_EQ(said_, "tacipc: error: there is no command 'pres', did you mean press? (see tacipc help)\n");
  EXPECT_EQ(tacipc("help something"), 2);
  EXPECT_EQ(said_, "tacipc: error: there is no command 'something' (see tacipc help)\n");
  EXPECT_EQ(tacipc("press"), 1);
  EXPECT_THAT(said_, HasSubstr("a b/press: not built (make -f Makefile.data build)\n"));
}

TEST_F(FrontDoor, VersionNamesLibrariesAndInstructionSet) {
  EXPECT_EQ(tacipc("--version"), 0);
  EXPECT_THAT(printed_, StartsWith("tacipc "));
  EXPECT_THAT(printed_, HasSubstr("\ninstruction set: compiled for x86-64"));
  for (const std::string library : {"Eigen 3.", "yaml-cpp 0.", "libpng 1.", "HDF5 1.", "OpenEXR 3.", "Embree 3."})
    EXPECT_THAT(printed_, HasSubstr("\n" + library));
}

TEST_F(FrontDoor, ManPageHasTheCommands) {
  stage("press", "echo 'Press hard.'");
  EXPECT_EQ(tacipc("--help-man"), 0);
  EXPECT_THAT(printed_, StartsWith(".TH \"TACIPC\" 1"));
  EXPECT_THAT(printed_, HasSubstr(".SH \"COMMANDS: gel\"\n"));
  EXPECT_THAT(printed_, HasSubstr("\npress: Press hard.\n"));
}

}  // namespace front_door_test
}  // namespace tacipc
