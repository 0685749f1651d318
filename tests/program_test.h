// Fixture of tests that run a program as a user does.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tests/scratch_folder.h"

namespace tacipc {

class ProgramTest : public ::testing::Test {
 protected:
  /// Runs a command of the shell; what it says on standard error is in said_. Its exit code, −1 if a signal ended it.
  int run_command(const std::string& command) {
    const std::filesystem::path said = scratch_ / "said.txt";
    const int status = std::system((command + " 2> '" + said.string() + "'").c_str());
    said_ = read_file(said);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  ScratchFolder scratch_;
  std::string said_;
};

}  // namespace tacipc
