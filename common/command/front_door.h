// The program tacipc: lists and runs the stages, which are programs next to it, and the commands on their files.
#pragma once

#include <string>
#include <vector>

namespace tacipc {

/// Facts about the build that CMake provides.
struct BuildFacts {
  struct StageName {
    std::string group;  // folder below stages/
    std::string name;
  };
  std::vector<StageName> stages;
  std::vector<std::string> libraries;  // names and versions
  std::string compiled_for;            // instruction set of TacIPC's own code
};

/// Runs the command that the arguments give; a stage replaces this process.
/// \return the exit code: 0 done, 1 a program is missing, 2 no such command; or the command's own code
int front_door(const std::vector<std::string>& arguments, const BuildFacts& facts);

}  // namespace tacipc
