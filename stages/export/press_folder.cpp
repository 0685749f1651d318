#include "stages/export/press_folder.h"

#include <fmt/ranges.h>

#include "common/config.h"
#include "common/error.h"
#include "common/files.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;
using Shape = std::vector<std::size_t>;

NpyArray read_shaped(const fs::path& path, const Shape& shape) {
  NpyArray array = read_npy(path);
  if (array.shape != shape)
    throw DataError("{}: has shape ({}), expected ({})", path.string(), fmt::join(array.shape, ", "),
                    fmt::join(shape, ", "));
  return array;
}

/// \throw DataError if `path` is not the file that the record names under this input.
void check_input(const fs::path& record_path, const ConfigReader& record, const char* input, const fs::path& path) {
  ConfigReader in = record;
  const std::string hash = in.section("inputs").section(input).text("hash");
  if (hash != content_hash(path))
    throw DataError("{}: is not the {} that {} was made with", path.string(), input, record_path.string());
}

}  // namespace

Positions PressArrays::positions_of(std::size_t frame) const {
  const auto vertices = static_cast<Eigen::Index>(positions.shape[1]);
  return Eigen::Map<const Positions>(&positions.data[frame * positions.shape[1] * 3], vertices, 3);
}

Matrix4 PressArrays::pose_of(std::size_t frame) const {
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(&object_pose.data[frame * 16]);
}

PressArrays read_press(const fs::path& folder, const fs::path& gel_path, const TetMesh& gel,
                       const fs::path& object_path) {
  const fs::path record_path = folder / "press.yaml";
  if (!fs::exists(record_path)) throw DataError("{}: has no press.yaml, so the press did not finish", folder.string());
  const ConfigReader record = ConfigReader::from_file(record_path);
  check_input(record_path, record, "gel", gel_path);
  check_input(record_path, record, "object", object_path);

  PressArrays press;
  press.front_vertices = gel.vertices(BoundaryTag::front);
  const std::size_t front = press.front_vertices.size();
  const NpyArray listed = read_shaped(folder / "front_vertices.npy", {front});
  if (listed.data != std::vector<double>(press.front_vertices.begin(), press.front_vertices.end()))
    throw DataError("{}: does not list the front of {}", (folder / "front_vertices.npy").string(), gel_path.string());
  press.positions = read_npy(folder / "positions.npy");
  press.frames = press.positions.shape.empty() ? 0 : press.positions.shape[0];
  const Shape wanted{press.frames, static_cast<std::size_t>(gel.num_vertices()), 3};
  if (press.frames == 0 || press.positions.shape != wanted)
    throw DataError("{}: has shape ({}), expected at least one frame of ({}, 3)", (folder / "positions.npy").string(),
                    fmt::join(press.positions.shape, ", "), gel.num_vertices());
  press.time_s = read_shaped(folder / "time.npy", {press.frames}).data;
  press.object_pose = read_shaped(folder / "object_pose.npy", {press.frames, 4, 4});
  press.contact_force = read_shaped(folder / "contact_force.npy", {press.frames, front, 2, 3});
  press.contact_state = read_shaped(folder / "contact_state.npy", {press.frames, front});
  return press;
}

}  // namespace tacipc
