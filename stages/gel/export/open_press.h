// A finished press, checked against the gel and the object that it is exported with.
#pragma once

#include <filesystem>

#include "common/mesh/tet_mesh.h"
#include "common/sample/press_folder.h"

namespace tacipc {

/// \throw DataError if the press did not finish, was of another gel or object (by content hash), or an array does not
/// fit the gel or the others
PressFolder open_press(const std::filesystem::path& folder, const std::filesystem::path& gel_path, const TetMesh& gel,
                       const std::filesystem::path& object_path);

}  // namespace tacipc
