#include "stages/baseline/simulate_depth.h"

#include "common/error.h"
#include "common/npy.h"
#include "stages/baseline/deformation.h"
#include "stages/baseline/phong.h"

namespace tacipc {
namespace {

FloatImage to_image(const Raster& raster) {
  FloatImage image(raster.width, raster.height, 1);
  for (std::size_t i = 0; i < raster.values.size(); ++i) image.pixels[i] = static_cast<float>(raster.values[i]);
  return image;
}

}  // namespace

BaselineFrame simulate_depth(const Raster& depth_m, const Raster& front_depth_m, const BaselineConfig& config,
                             const std::optional<ByteImage>& background) {
  const Raster h = protrusion(depth_m, front_depth_m);
  const Raster indentation = membrane_indentation(h, config.deformation.scaled_to(depth_m.width));
  Raster membrane = front_depth_m;
  for (std::size_t i = 0; i < membrane.values.size(); ++i) membrane.values[i] -= indentation.values[i];
  add_texture(membrane, config.texture_sigma_m, config.seed);
  BaselineFrame frame{.indentation = to_image(indentation), .depth = to_image(membrane), .tactile = std::nullopt};
  if (config.shading) frame.tactile = phong_image(*background, membrane, h, *config.shading);
  return frame;
}

Raster read_depth(const std::filesystem::path& path) {
  const FloatImage image = read_exr(path, {"Z"});
  Raster depth(image.width, image.height);
  for (std::size_t i = 0; i < depth.values.size(); ++i) depth.values[i] = image.pixels[i];
  return depth;
}

std::vector<Matrix4> read_poses(const std::filesystem::path& path) {
  const NpyArray array = read_npy(path);
  const auto& shape = array.shape;
  const bool stacked = shape.size() == 3, single = shape.size() == 2;
  if (!(stacked || single) || shape.back() != 4 || shape[shape.size() - 2] != 4)
    throw DataError("{}: holds no 4 x 4 poses", path.string());
  std::vector<Matrix4> poses;
  for (std::size_t frame = 0; frame < array.data.size() / 16; ++frame) {
    const Matrix4 pose = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(&array.data[16 * frame]);
    const Matrix3 rotation = pose.topLeftCorner<3, 3>();
    const bool rigid = pose.allFinite() && (rotation.transpose() * rotation - Matrix3::Identity()).norm() < 1e-6 &&
                       rotation.determinant() > 0.0 && pose.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), 1e-12);
    if (!rigid) throw DataError("{}: pose {} is no rigid motion", path.string(), frame);
    poses.push_back(pose);
  }
  if (poses.empty()) throw DataError("{}: holds no pose", path.string());
  return poses;
}

}  // namespace tacipc
