#include "tests/stages/image/render/third_party/povray_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <sstream>

#include "common/base/byte_reader.h"
#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {
namespace {

constexpr double kUnit = 1e-4;          // m
constexpr double kFadeDistance = 1e-5;  // m
constexpr int kLargestSide = 32768;

std::string vector_text(const Vector3& v) { return fmt::format("<{:.9g},{:.9g},{:.9g}>", v.x(), v.y(), v.z()); }

void add_rows(fmt::memory_buffer& out, const char* name, const Positions& rows, double scale) {
  fmt::format_to(std::back_inserter(out), "  {} {{ {}", name, rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    fmt::format_to(std::back_inserter(out), ",\n{}", vector_text(scale * rows.row(i).transpose()));
  fmt::format_to(std::back_inserter(out), " }}\n");
}

/// For the shell, whatever is in it.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

Sensor comparable_sensor(const Sensor& sensor) {
  Sensor out = sensor;
  if (sensor.camera.width_px % 2 != 0 || sensor.camera.height_px % 2 != 0)
    throw DataError("{}: the picture's width and height must be even", sensor.name);
  out.stack.gel_ior.reset();
  out.coating = {.albedo = {1.0, 1.0, 1.0}};
  out.ambient_rgb = {};
  out.diffuser.reset();
  out.markers.radius_m.reset();
  out.camera = {.position_m = sensor.camera.position_m,
                .width_px = sensor.camera.width_px,
                .height_px = sensor.camera.height_px,
                .window_width_m = sensor.camera.window_width_m,
                .window_height_m = sensor.camera.window_height_m};
  const Vector3 first = sensor.leds.front().position_m;
  const double radius = first.head<2>().norm();
  constexpr std::array<int, 8> kColors = {0, 0, 0, 1, 1, 1, 2, 2};
  out.leds.clear();
  for (std::size_t k = 0; k < kColors.size(); ++k) {
    const double azimuth = static_cast<double>(k) * std::numbers::pi / 4.0;
    Led led{.position_m = {radius * std::cos(azimuth), radius * std::sin(azimuth), first.z()},
            .emission = Emission::isotropic};
    led.rgb[static_cast<std::size_t>(kColors[k])] = 1.0;
    out.leds.push_back(led);
  }
  return out;
}

PovrayScene povray_scene(const Membrane& membrane, const Sensor& sensor) {
  std::array<double, 3> most{};
  for (const Led& led : sensor.leds) {
    const double squared_distance =
        (membrane.positions.rowwise() - led.position_m.transpose()).rowwise().squaredNorm().minCoeff();
    for (std::size_t c = 0; c < 3; ++c) most[c] += led.rgb[c] * led.intensity / squared_distance;
  }
  // A triangle may come a little nearer to a light than its corners.
  const double weight = 1.01 * *std::max_element(most.begin(), most.end());
  const Camera& camera = sensor.camera;
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to,
                 "#version 3.7;\nglobal_settings {{ assumed_gamma 1.0 ambient_light 0 }}\nbackground {{ rgb 0 }}\n");
  fmt::format_to(to, "camera {{ perspective location {} direction {} right {} up {} }}\n",
                 vector_text(camera.position_m / kUnit), vector_text({0.0, 0.0, -camera.position_m.z() / kUnit}),
                 vector_text({camera.window_width_m / kUnit, 0.0, 0.0}),
                 vector_text({0.0, -camera.window_height_m / kUnit, 0.0}));
  for (const Led& led : sensor.leds) {
    const double strength = led.intensity / (2.0 * kFadeDistance * kFadeDistance * weight);
    fmt::format_to(to, "light_source {{ {} color rgb {} fade_distance {} fade_power 2 }}\n",
                   vector_text(led.position_m / kUnit),
                   vector_text(strength * Vector3(led.rgb[0], led.rgb[1], led.rgb[2])), kFadeDistance / kUnit);
  }
  fmt::format_to(to, "mesh2 {{\n");
  add_rows(out, "vertex_vectors", membrane.positions, 1.0 / kUnit);
  add_rows(out, "normal_vectors", membrane.normals, -1.0);
  fmt::format_to(to, "  face_indices {{ {}", membrane.triangles.rows());
  for (Eigen::Index f = 0; f < membrane.triangles.rows(); ++f)
    fmt::format_to(to, ",\n<{},{},{}>", membrane.triangles(f, 0), membrane.triangles(f, 1), membrane.triangles(f, 2));
  fmt::format_to(to, " }}\n  texture {{ pigment {{ rgb 1 }} finish {{ ambient 0 diffuse 1 }} }}\n}}\n");
  return {.text = fmt::to_string(out), .white = weight / std::numbers::pi};
}

bool povray_is_there() { return std::system("command -v povray >/dev/null 2>&1") == 0; }

void run_povray(const std::filesystem::path& scene, const std::filesystem::path& picture, const Camera& camera,
                int threads) {
  if (!povray_is_there()) throw DataError("there is no program povray (Debian package povray)");
  // In the scene's folder: POV-Ray is allowed to read and write there.
  const std::string command = fmt::format(
      "cd {} && povray -D +I{} +O{} +FP Bits_Per_Color=16 File_Gamma=1.0 Dither=off -A +W{} +H{} +WT{} >povray.log "
      "2>&1",
      quoted(scene.parent_path().string()), quoted(scene.filename().string()), quoted(picture.filename().string()),
      camera.width_px, camera.height_px, threads);
  if (std::system(command.c_str()) != 0 || !std::filesystem::exists(picture))
    throw DataError("povray failed on {}:\n{}", scene.string(), read_file(scene.parent_path() / "povray.log"));
}

FloatImage read_ppm16(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  std::istringstream head(bytes);
  const auto next = [&] {
    std::string word;
    while (head >> word && word.front() == '#') std::getline(head, word);
    return word;
  };
  const std::string magic = next(), width = next(), height = next(), largest = next();
  if (!head || magic != "P6" || largest != "65535") throw DataError("{}: is not a PPM of 16 bits", path.string());
  const int columns = std::atoi(width.c_str()), rows = std::atoi(height.c_str());
  if (columns < 1 || rows < 1 || columns > kLargestSide || rows > kLargestSide)
    throw DataError("{}: is {} x {} pixels", path.string(), width, height);
  FloatImage image(columns, rows, 3);
  ByteReader in(bytes, path.string(), std::endian::big);
  in.skip(static_cast<std::size_t>(head.tellg()) + 1, "the header");
  for (float& value : image.pixels) value = static_cast<float>(in.read<std::uint16_t>("the pixels") / 65535.0);
  return image;
}

}  // namespace tacipc
