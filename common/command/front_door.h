// The program tacipc: lists and runs the stages, which are programs beside it, and the commands on their files.
#pragma once

#include <string>
#include <vector>

namespace tacipc {

/// What CMake knows of the build.
struct BuildFacts {
  struct StageName {
    std::string group;  // the folder of stages/ it is in
    std::string name;
  };
  std::vector<StageName> stages;
  std::vector<std::string> libraries;  // name and version
  std::string compiled_for;            // instruction set of our code
};

/// Runs what the arguments say; a stage takes the place of this process. Returns the exit code: 0 done, 1 a program is
/// missing, 2 there is no such command, or what the command returns.
int front_door(const std::vector<std::string>& arguments, const BuildFacts& facts);

}  // namespace tacipc
