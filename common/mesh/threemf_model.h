// Contents of one XML part of a 3MF file: objects with meshes or components, and the items of the build. [3MF Core 1.3,
// 3MF Production 1.2]
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/mesh/scene_parts.h"

namespace tacipc {

/// An item of the build, or a component of an object.
struct ThreeMfReference {
  int object = 0;
  std::optional<std::string> path;  // part that contains the object; absent: the same part
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();
};

/// An object: a mesh, or components.
struct ThreeMfObject {
  std::string type;    // model, surface, other; solidsupport and support are not part of the printed object
  std::string unread;  // reason why its shape cannot be read; empty if it can
  PartMesh mesh;
  std::vector<ThreeMfReference> components;  // replace the mesh
};

/// Contents of a part.
struct ThreeMfModel {
  std::optional<std::string> unit;  // m, cm, mm, um, in, ft; absent if not stated
  std::map<int, ThreeMfObject> objects;
  std::vector<ThreeMfReference> items;
};

/// Returns the part that holds the root model, from the relationships of a package.
/// \param place file and part, for messages
/// \throw DataError `PLACE: …` if there is no root model
std::string root_part_of(std::string relationships, const std::string& place);

/// Whether to read the build; only the root model's build is used.
enum class ThreeMfBuild { read, ignore };

/// Reads a model. An object whose shape needs an unsupported extension states that in `unread`.
/// \throw DataError `PLACE: …` if the text is not XML or not a 3MF model, or violates the format
ThreeMfModel read_threemf_model(std::string xml, const std::string& place, ThreeMfBuild build);

/// Returns the kinds of volumes that are not parts, such as ParameterModifier, which the settings of a slicer
/// (PrusaSlicer and others of its family) assign to triangles of meshes; empty if there are none.
std::string volumes_that_are_no_parts(std::string settings, const std::string& place);

}  // namespace tacipc
