// An input file with its name: NAME=PATH on the command line.
#pragma once

#include <filesystem>
#include <string>

namespace tacipc {

/// A path and its name.
struct NamedPath {
  std::string name;
  std::filesystem::path path;
};

}  // namespace tacipc
