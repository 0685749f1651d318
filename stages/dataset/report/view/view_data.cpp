#include "stages/dataset/report/view/view_data.h"

#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/error.h"
#include "common/base/json.h"
#include "common/image/picture.h"

namespace tacipc {
namespace {

constexpr double kMostSteps = 65535.0;

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_COMPRESSION);
  if (code != Z_OK) throw DataError("the data of the 3-D view cannot be packed (zlib: {})", zError(code));
  packed.resize(size);
  return packed;
}

/// Base64: four letters for three bytes, padded with '='.   [RFC 4648]
std::string base64(const std::string& bytes) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t given = std::min<std::size_t>(3, bytes.size() - at);
    unsigned bits = 0;
    for (std::size_t i = 0; i < 3; ++i) bits = bits << 8 | (i < given ? static_cast<unsigned char>(bytes[at + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i) text += i <= given ? kLetters[bits >> (18 - 6 * i) & 63u] : '=';
  }
  return text;
}

std::string packed_triangles(const Triangles& triangles) {
  std::vector<int> first, second, third;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const int a = triangles(t, 0);
    first.push_back(t == 0 ? a : a - triangles(t - 1, 0));
    second.push_back(triangles(t, 1) - a);
    third.push_back(triangles(t, 2) - a);
  }
  return byte_planes(first) + byte_planes(second) + byte_planes(third);
}

/// \param before positions of the previous frame, or null
std::string packed_positions(const Positions& x, const Positions* before, const ViewGrid& grid) {
  std::string bytes;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<int> steps;
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      const int here = grid.steps(x(v, axis), axis);
      const int from = before ? grid.steps((*before)(v, axis), axis) : v > 0 ? grid.steps(x(v - 1, axis), axis) : 0;
      steps.push_back(here - from);
    }
    bytes += byte_planes(steps);
  }
  return bytes;
}

/// Pressure of the colour bar's end, at least one pascal, so that a press without contact also has a bar.
double top_pressure(const SceneView& view) {
  std::vector<double> pressures;
  for (const ViewedGel& gel : view.gels) {
    for (const ViewedFront& frame : gel.frames)
      std::copy_if(frame.pressure_pa.begin(), frame.pressure_pa.end(), std::back_inserter(pressures),
                   [](double p) { return p > 0.0; });
  }
  if (pressures.empty()) return 1.0;
  const auto at = pressures.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(pressures.size() - 1));
  std::nth_element(pressures.begin(), at, pressures.end());
  return std::max(1.0, *at);
}

/// Deepest indentation of all frames, at least one micrometre.
double deepest(const SceneView& view) {
  double depth = 1e-6;
  for (std::size_t f = 0; f < view.frames.size(); ++f) depth = std::max(depth, deepest_indentation(view, f));
  return depth;
}

std::string packed_frames(const ViewedGel& gel, const ViewGrid& grid, double top_pa) {
  std::string bytes;
  const Positions* before = nullptr;
  for (const ViewedFront& frame : gel.frames) {
    bytes += packed_positions(frame.positions, before, grid);
    before = &frame.positions;
    std::vector<int> pressures, states;
    for (const double p : frame.pressure_pa)
      pressures.push_back(static_cast<int>(std::lround(255.0 * std::min(1.0, p / top_pa))));
    for (const ContactState state : frame.state) states.push_back(static_cast<int>(state));
    bytes += byte_planes(pressures) + byte_planes(states);
  }
  return bytes;
}

Value grid_value(const ViewGrid& grid) {
  return Value::Map{{"low_m", Value::List{grid.low_m.x(), grid.low_m.y(), grid.low_m.z()}},
                    {"step_m", grid.step_m},
                    {"size", Value::List{grid.size.x(), grid.size.y(), grid.size.z()}}};
}

Value pose_value(const Matrix4& pose) {
  Value::List numbers;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) numbers.emplace_back(pose(row, column));
  return numbers;
}

Value color_bar() {
  Value::List colors;
  for (int i = 0; i < 256; ++i) {
    const auto [r, g, b] = perceptual_color(i / 255.0);
    colors.emplace_back(Value::List{int{r}, int{g}, int{b}});
  }
  return colors;
}

}  // namespace

ViewGrid ViewGrid::around(const std::vector<const Positions*>& sets) {
  Eigen::RowVector3d low = sets.front()->colwise().minCoeff(), high = sets.front()->colwise().maxCoeff();
  for (const Positions* set : sets) {
    low = low.cwiseMin(set->colwise().minCoeff());
    high = high.cwiseMax(set->colwise().maxCoeff());
  }
  ViewGrid grid{.low_m = low.transpose(), .step_m = std::max((high - low).maxCoeff(), 1e-9) / kMostSteps};
  for (int axis = 0; axis < 3; ++axis) grid.size[axis] = grid.steps(high[axis], axis);
  return grid;
}

int ViewGrid::steps(double coordinate_m, int axis) const {
  return static_cast<int>(std::lround((coordinate_m - low_m[axis]) / step_m));
}

std::string byte_planes(const std::vector<int>& values) {
  std::string planes(3 * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int n = values[i];
    if (n >= 1 << 23 || n < -(1 << 23)) throw DataError("{}: is too large for the data of a 3-D view", n);
    const unsigned code = n >= 0 ? 2u * static_cast<unsigned>(n) : 2u * static_cast<unsigned>(-(n + 1)) + 1u;
    for (std::size_t plane = 0; plane < 3; ++plane)
      planes[plane * values.size() + i] = static_cast<char>(code >> (8 * plane) & 255u);
  }
  return planes;
}

double deepest_indentation(const SceneView& view, std::size_t frame) {
  double depth = 0.0;
  for (const ViewedGel& gel : view.gels)
    depth = std::max(depth, (gel.frames.front().positions.col(2) - gel.frames[frame].positions.col(2)).maxCoeff());
  return depth;
}

std::string view_script(const SceneView& view, const std::vector<std::string>& texts) {
  assert(texts.size() == view.frames.size());
  const double top_pa = top_pressure(view);
  std::string bytes;
  Value::List frames, gels, objects;
  for (std::size_t f = 0; f < view.frames.size(); ++f)
    frames.emplace_back(Value::Map{{"frame", view.frames[f]}, {"text", texts[f]}});
  for (const ViewedGel& gel : view.gels) {
    std::vector<const Positions*> sets;
    Value::List poses;
    for (const ViewedFront& frame : gel.frames) {
      sets.push_back(&frame.positions);
      poses.push_back(pose_value(frame.world_from_gel));
    }
    const ViewGrid grid = ViewGrid::around(sets);
    bytes += packed_triangles(gel.front) + packed_frames(gel, grid, top_pa);
    gels.emplace_back(Value::Map{{"name", gel.name},
                                 {"vertices", gel.frames.front().positions.rows()},
                                 {"triangles", gel.front.rows()},
                                 {"bottom_m", gel.bottom_m},
                                 {"grid", grid_value(grid)},
                                 {"poses", poses}});
    const auto there = [](const std::string& link) { return !link.empty(); };
    if (std::any_of(gel.pictures.begin(), gel.pictures.end(), there))
      gels.back().set("pictures", Value::List(gel.pictures.begin(), gel.pictures.end()));
  }
  for (const ViewedObject& object : view.objects) {
    Value::List poses;
    for (const Matrix4& pose : object.world_from_object) poses.push_back(pose_value(pose));
    std::vector<const Positions*> sets;
    for (const Positions& x : object.deformed) sets.push_back(&x);
    if (sets.empty()) sets.push_back(&object.mesh.positions);
    const ViewGrid grid = ViewGrid::around(sets);
    bytes += packed_triangles(object.mesh.triangles);
    for (std::size_t i = 0; i < sets.size(); ++i)
      bytes += packed_positions(*sets[i], i > 0 ? sets[i - 1] : nullptr, grid);
    objects.emplace_back(Value::Map{{"name", object.name},
                                    {"vertices", object.mesh.num_vertices()},
                                    {"triangles", object.mesh.num_triangles()},
                                    {"grid", grid_value(grid)},
                                    {"poses", poses}});
    if (object.fixed) objects.back().set("kind", "fixed");
    if (object.robot) objects.back().set("kind", "robot");
    if (!object.deformed.empty()) objects.back().set("kind", "soft");
  }
  const Value data = Value::Map{
      {"gels", gels},     {"objects", objects},    {"indentation_m", deepest(view)},   {"pressure_pa", top_pa},
      {"frames", frames}, {"colors", color_bar()}, {"packed", base64(deflated(bytes))}};
  return "tacipc_view(" + to_json(data) + ");\n";
}

}  // namespace tacipc
