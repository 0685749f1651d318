#include "common/sample/pose_file.h"

#include "common/base/error.h"
#include "common/format/npy_pose.h"

namespace tacipc {

const NpyField& image_poses_field() {
  static const NpyField kField{.file = "object_pose.npy",
                               .type = NpyType::f8,
                               .shape = {"images", 4, 4},
                               .unit = "m",
                               .meaning = "`gel_from_object` at the place in the image"};
  return kField;
}

const NpyField& ball_poses_field() {
  static const NpyField kField{.file = "ball_poses.npy",
                               .type = NpyType::f8,
                               .shape = {"balls", 4, 4},
                               .unit = "m",
                               .meaning = "`gel_from_object` of each ball"};
  return kField;
}

void write_poses(Stage& stage, const NpyField& field, const std::vector<Matrix4>& gel_from_object) {
  std::vector<double> values;
  for (const Matrix4& pose : gel_from_object) append_pose(values, pose);
  write_field(field, stage.output(field.file), {{std::get<std::string_view>(field.shape[0]), gel_from_object.size()}},
              values);
}

std::vector<Matrix4> read_poses(const std::filesystem::path& path) {
  const NpyArray array = read_npy(path);
  const auto& shape = array.shape;
  const bool stacked = shape.size() == 3, single = shape.size() == 2;
  if (!(stacked || single) || shape.back() != 4 || shape[shape.size() - 2] != 4)
    throw DataError("{}: holds no 4 x 4 poses", path.string());
  std::vector<Matrix4> poses;
  for (std::size_t frame = 0; frame < array.data.size() / 16; ++frame) {
    const Matrix4 pose = pose_of(&array.data[16 * frame]);
    const Matrix3 rotation = pose.topLeftCorner<3, 3>();
    const bool rigid = pose.allFinite() && (rotation.transpose() * rotation - Matrix3::Identity()).norm() < 1e-6 &&
                       rotation.determinant() > 0.0 && pose.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), 1e-12);
    if (!rigid) throw DataError("{}: pose {} is not a rigid motion", path.string(), frame);
    poses.push_back(pose);
  }
  if (poses.empty()) throw DataError("{}: holds no pose", path.string());
  return poses;
}

}  // namespace tacipc
