// One XML part of a 3MF file as it is written: objects with meshes or components, and the items of the build.
// [3MF Core 1.3, 3MF Production 1.2]
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
  std::optional<std::string> path;  // the part that has the object; its own if there is none
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();
};

struct ThreeMfObject {
  std::string type;    // model, surface, other; solidsupport and support are not part of what is built
  std::string unread;  // why its shape cannot be read, if it cannot
  PartMesh mesh;
  std::vector<ThreeMfReference> components;  // instead of a mesh
};

struct ThreeMfModel {
  std::optional<std::string> unit;  // m, cm, mm, um, in, ft, if it says
  std::map<int, ThreeMfObject> objects;
  std::vector<ThreeMfReference> items;
};

/// The part that holds the root model, by the relationships of a package. `place` is the file and the part, for
/// messages. \throw DataError `PLACE: …`
std::string root_part_of(std::string relationships, const std::string& place);

enum class ThreeMfBuild { read, ignore };

/// A model; the build counts in the root model alone. \throw DataError `PLACE: …` for what is no XML, no 3MF model, or
/// breaks its rules; an object whose shape takes an extension that is not read says so in `unread`.
ThreeMfModel read_threemf_model(std::string xml, const std::string& place, ThreeMfBuild build);

/// Kinds of volumes other than parts, such as ParameterModifier, that the settings of a slicer (PrusaSlicer and others
/// of its family) find among the triangles of meshes; empty if there are none.
std::string volumes_that_are_no_parts(std::string settings, const std::string& place);

}  // namespace tacipc
