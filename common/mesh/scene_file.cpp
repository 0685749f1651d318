#include "common/mesh/scene_file.h"

#include <archive.h>
#include <archive_entry.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <memory>
#include <regex>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/text_reader.h"

namespace tacipc {
namespace {

std::string suffix_of(const std::filesystem::path& path) { return lower_case(path.extension().string()); }

/// The first part of the model inside a 3MF file, a ZIP archive: its root element states the unit.
std::string head_of_model(const std::string& bytes, const std::string& name) {
  const std::unique_ptr<archive, decltype(&archive_read_free)> zip(archive_read_new(), archive_read_free);
  archive_read_support_format_zip(zip.get());
  if (archive_read_open_memory(zip.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
    throw DataError("{}: not a 3MF file ({})", name, shown(archive_error_string(zip.get())));
  for (archive_entry* entry = nullptr; archive_read_next_header(zip.get(), &entry) == ARCHIVE_OK;) {
    const char* inside = archive_entry_pathname(entry);
    if (inside == nullptr || suffix_of(inside) != ".model") continue;
    std::string head(1 << 14, '\0');
    const auto size = archive_read_data(zip.get(), head.data(), head.size());
    if (size < 0) throw DataError("{}: not a 3MF file ({})", name, shown(archive_error_string(zip.get())));
    head.resize(size);
    return head;
  }
  throw DataError("{}: not a 3MF file (there is no model in it)", name);
}

std::string unit_of_3mf(const std::string& bytes, const std::string& name) {
  const std::string head = head_of_model(bytes, name);
  std::smatch found;
  static const std::regex kUnit("<model[^>]*\\sunit\\s*=\\s*[\"']([a-z]*)[\"']");
  if (!std::regex_search(head, found, kUnit)) return "mm";  // the format's default
  const std::string word = found[1];
  if (word == "millimeter") return "mm";
  if (word == "centimeter") return "cm";
  if (word == "meter") return "m";
  if (word == "micron") return "um";
  if (word == "inch") return "in";
  throw DataError("{}: unit '{}' of the model is none of micron, millimeter, centimeter, inch, meter", name,
                  shown(word));
}

}  // namespace

bool is_scene_file(const std::filesystem::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".glb" || suffix == ".gltf" || suffix == ".3mf";
}

SceneMesh read_scene_file(const std::filesystem::path& path) {
  const std::string name = path.string(), bytes = read_file(path), suffix = suffix_of(path);
  if (bytes.empty()) throw DataError("{}: the file is empty", name);
  SceneMesh read{.mesh = {}, .unit = suffix == ".3mf" ? unit_of_3mf(bytes, name) : "m"};

  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  // From memory: what the record hashes is what is read, and no other file beside it.
  const aiScene* scene = importer.ReadFileFromMemory(
      bytes.data(), bytes.size(), aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices,
      suffix.c_str() + 1);
  if (scene == nullptr)
    throw DataError("{}: cannot be read ({}); buffers must be inside the file", name, shown(importer.GetErrorString()));

  Eigen::Index vertices = 0, triangles = 0;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    vertices += scene->mMeshes[m]->mNumVertices;
    triangles += scene->mMeshes[m]->mNumFaces;
  }
  if (triangles == 0) throw DataError("{}: has no triangles", name);
  read.mesh.positions.resize(vertices, 3);
  read.mesh.triangles.resize(triangles, 3);
  Eigen::Index v = 0, f = 0;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    for (unsigned i = 0; i < part.mNumFaces; ++i, ++f) {
      if (part.mFaces[i].mNumIndices != 3) throw DataError("{}: face {} has no triangles", name, i);
      for (int corner = 0; corner < 3; ++corner)
        read.mesh.triangles(f, corner) = static_cast<int>(v + part.mFaces[i].mIndices[corner]);
    }
    for (unsigned i = 0; i < part.mNumVertices; ++i, ++v) {
      const aiVector3D& point = part.mVertices[i];
      read.mesh.positions.row(v) << point.x, point.y, point.z;
      if (!read.mesh.positions.row(v).allFinite()) throw DataError("{}: vertex {} is not finite", name, v);
    }
  }
  return read;
}

}  // namespace tacipc
