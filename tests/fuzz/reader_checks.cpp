#include "tests/fuzz/reader_checks.h"

#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/format/csv.h"
#include "common/format/npy.h"
#include "common/image/image.h"
#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/dataset_plan.h"
#include "common/sample/motion.h"

namespace tacipc {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

template <typename Indices>
void require_vertices(const Indices& indices, Eigen::Index num_vertices, const char* what) {
  require(indices.size() == 0 || (indices.minCoeff() >= 0 && indices.maxCoeff() < num_vertices), what);
}

template <typename T>
void require_full(const Image<T>& image, int channels) {
  require(image.width > 0 && image.height > 0 && image.channels == channels, "an image without pixels");
  require(image.pixels.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                                     static_cast<std::size_t>(channels),
          "pixels that do not fill the image");
}

}  // namespace

void check_triangle_mesh(const std::filesystem::path& file) {
  const TriangleMesh mesh = read_triangle_mesh(file, 1e-3);
  require(mesh.num_triangles() > 0, "a mesh without triangles");
  require(mesh.positions.allFinite(), "positions that are not finite");
  require_vertices(mesh.triangles, mesh.num_vertices(), "a triangle of a vertex that is not there");
}

void check_tet_mesh(const std::filesystem::path& file) {
  const MshContent content = read_msh(file);
  require(content.positions.allFinite(), "positions that are not finite");
  require_vertices(content.tets, content.positions.rows(), "a tet of a vertex that is not there");
  require_vertices(content.triangles, content.positions.rows(), "a triangle of a vertex that is not there");
  require(content.triangle_tags.size() == static_cast<std::size_t>(content.triangles.rows()), "not one tag a triangle");
  try {
    const TetMesh mesh = read_tet_mesh(file);
    require(mesh.tags.size() == static_cast<std::size_t>(mesh.boundary.rows()), "not one tag a boundary triangle");
  } catch (const DataError&) {
    // A mesh, but no gel.
  }
}

void check_npy(const std::filesystem::path& file) {
  const NpyArray array = read_npy(file);
  std::size_t count = 1;
  for (const std::size_t extent : array.shape) count *= extent;
  require(array.data.size() == count, "values that do not fill the shape");
  std::optional<NpyFrames> frames;
  try {
    frames.emplace(file);
  } catch (const DataError&) {
    return;  // Fortran order, no axis, a header longer than any writer's
  }
  require(frames->shape() == array.shape, "two shapes of one array");
  if (count == 0) return;
  const std::size_t size = count / array.shape[0];
  for (std::size_t f = 0; f < array.shape[0]; ++f) {
    const std::vector<double> frame = frames->frame(f);
    require(frame.size() == size, "a frame of another size");
    for (std::size_t i = 0; i < size; ++i)
      require(std::bit_cast<std::uint64_t>(frame[i]) == std::bit_cast<std::uint64_t>(array.data[f * size + i]),
              "a frame of other values");
  }
}

void check_csv(const std::filesystem::path& file) {
  CsvReader table(file);
  std::string text = csv_line(table.columns());
  std::vector<std::vector<std::string>> rows;
  while (table.next()) {
    rows.push_back(table.row());
    text += csv_line(rows.back());
    require(rows.back().size() == table.columns().size(), "a row that is not as wide as the table");
    require(table[table.columns().front()] == rows.back().front(), "a field that is not the row's");
  }
  write_file(file, text);
  CsvReader again(file);
  require(again.columns() == table.columns(), "columns that do not read back");
  for (const auto& row : rows) require(again.next() && again.row() == row, "a row that does not read back");
  require(!again.next(), "more rows than were written");
}

void check_plan(const std::filesystem::path& file) {
  for_each_planned(file, std::nullopt, [](const PlannedRow& row) {
    require(!row.id.empty() && row.id.find('/') == std::string::npos, "an id that is no name");
  });
  for_each_planned(file, "0000", [](const PlannedRow& row) { require(row.shard == "0000", "another shard"); });
}

void check_path(const std::filesystem::path& file) {
  double before = -1.0;
  for (const PathPoint& point : read_path(file)) {
    require(std::isfinite(point.time_s) && point.time_s > before, "times that do not ascend");
    require(point.shift_m.allFinite(), "a shift that is not finite");
    require(std::abs(point.rotation.norm() - 1.0) < 1e-9, "a rotation that is none");
    before = point.time_s;
  }
}

void check_image(const std::filesystem::path& file) {
  require_full(read_png(file, 3), 3);
  require_full(read_png(file, 1), 1);
}

void check_exr(const std::filesystem::path& file) { require_full(read_exr(file, {"R", "B"}), 2); }

std::string png_with_checksums(std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kNumber = 4;
  std::string out(bytes);
  const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<std::uint8_t>(out[at])); };
  for (std::size_t at = kSignature; at + 3 * kNumber <= out.size();) {
    const std::size_t length = byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3);
    at += kNumber;
    if (length > out.size() - at - 2 * kNumber) break;
    const auto* chunk = reinterpret_cast<const Bytef*>(out.data() + at);
    const auto sum = static_cast<std::uint32_t>(crc32_z(0, chunk, length + kNumber));
    at += length + kNumber;
    for (int i = 0; i < 4; ++i) out[at++] = static_cast<char>(sum >> (24 - 8 * i));
  }
  return out;
}

}  // namespace tacipc
