#include "tests/verification/gel_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.h"
#include "common/triangle_mesh.h"
#include "stages/tetmesh/generate.h"
#include "tests/verification/shared_files.h"

namespace tacipc::verify {
namespace {

constexpr double kMillimetre = 1e-3;

/// Depth of the crown below z = 0 along one axis.
double sag_along(double x, double half_m, double rim_m, double sag_m, double edge_sag_m) {
  const double u = std::abs(x);
  if (u <= half_m) return sag_m * (u / half_m) * (u / half_m);
  const double slope = 2.0 * sag_m / half_m, t = (u - half_m) / (rim_m - half_m);
  const double straight = slope * (rim_m - half_m);
  return sag_m + straight * t + (edge_sag_m - sag_m - straight) * t * t;
}

void tag_faces(TetMesh& gel) {
  gel.boundary = boundary_triangles(gel.tets, gel.num_vertices());
  const double lowest = gel.positions.col(2).minCoeff();
  const double tolerance = 1e-6 * (gel.positions.col(2).maxCoeff() - lowest);
  gel.tags.clear();
  for (Eigen::Index f = 0; f < gel.boundary.rows(); ++f) {
    const Vector3 a = gel.positions.row(gel.boundary(f, 0)), b = gel.positions.row(gel.boundary(f, 1)),
                  c = gel.positions.row(gel.boundary(f, 2));
    const Vector3 normal = (b - a).cross(c - a).normalized();
    const bool flat_at_back = std::max({a.z(), b.z(), c.z()}) < lowest + tolerance;
    gel.tags.push_back(flat_at_back ? BoundaryTag::glued : normal.z() > 0.5 ? BoundaryTag::front : BoundaryTag::side);
  }
}

TetMesh box_mesh(const BoxGel& box) {
  const std::vector<double> xs =
      graded_lines(box.width_m / 2, box.near_m, box.near_half_m, box.growth, box.far_m, box.corner_cut_m);
  const std::vector<double> ys =
      graded_lines(box.height_m / 2, box.near_m, box.near_half_m, box.growth, box.far_m, box.corner_cut_m);
  std::vector<double> zs{0.0};
  for (double step = box.layer_m; zs.back() < box.thickness_m; step *= box.layer_growth) zs.push_back(zs.back() + step);
  for (double& z : zs) z *= -box.thickness_m / zs.back();
  const int nx = static_cast<int>(xs.size()) - 1, ny = static_cast<int>(ys.size()) - 1,
            nz = static_cast<int>(zs.size()) - 1;
  const auto index = [&](const std::array<int, 3>& at) { return (at[2] * (ny + 1) + at[1]) * (nx + 1) + at[0]; };

  // Kuhn's subdivision: one tetrahedron for each order in which the three axes are walked through a cell. A cell is
  // walked upwards or downwards along an axis by the parity of its index, so that neighbours mirror each other; the
  // shift by one in x lays the diagonals of the corner cells along the cut.
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  std::vector<std::array<int, 4>> tets;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const bool corner = box.corner_cut_m && (i == 0 || i == nx - 1) && (j == 0 || j == ny - 1);
        const int outer_x = i == 0 ? 0 : nx, outer_y = j == 0 ? 0 : ny;
        const std::array<int, 3> up{(i + 1) % 2 == 0, j % 2 == 0, k % 2 == 0};
        for (const auto& order : kOrders) {
          std::array<int, 3> at{i + !up[0], j + !up[1], k + !up[2]};
          std::array<int, 4> tet{index(at)};
          bool cut = corner && at[0] == outer_x && at[1] == outer_y;
          for (int s = 0; s < 3; ++s) {
            at[order[s]] += up[order[s]] ? 1 : -1;
            tet[s + 1] = index(at);
            cut = cut || (corner && at[0] == outer_x && at[1] == outer_y);
          }
          if (!cut) tets.push_back(tet);
        }
      }
    }
  }
  std::vector<int> number(static_cast<std::size_t>((nx + 1) * (ny + 1) * (nz + 1)), -1);
  for (const auto& tet : tets)
    for (const int v : tet) number[v] = 0;
  int used = 0;
  for (int& n : number)
    if (n == 0) n = used++;
  TetMesh gel;
  gel.positions.resize(used, 3);
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        const int n = number[index({i, j, k})];
        if (n < 0) continue;
        double top = 0.0;
        if (box.crown) {
          const Crown& c = *box.crown;
          top = -std::hypot(sag_along(xs[i], c.half_x_m, box.width_m / 2, c.sag_m, c.edge_sag_m),
                            sag_along(ys[j], c.half_y_m, box.height_m / 2, c.sag_m, c.edge_sag_m));
        }
        gel.positions.row(n) << xs[i], ys[j], top + zs[k] * (box.thickness_m + top) / box.thickness_m;
      }
    }
  }
  gel.tets.resize(static_cast<Eigen::Index>(tets.size()), 4);
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const auto row = static_cast<Eigen::Index>(t);
    for (int c = 0; c < 4; ++c) gel.tets(row, c) = number[tets[t][c]];
    Matrix3 edges;
    for (int c = 0; c < 3; ++c)
      edges.col(c) = gel.positions.row(gel.tets(row, c + 1)) - gel.positions.row(gel.tets(row, 0));
    if (edges.determinant() < 0.0) std::swap(gel.tets(row, 1), gel.tets(row, 2));
  }
  return gel;
}

TetMesh disc_mesh(const DiscGel& disc) {
  GelShape shape;
  shape.outline = GelShape::Outline::disc;
  shape.radius_m = disc.radius_m;
  shape.thickness_m = disc.thickness_m;
  GenerateConfig config;
  config.sizing = disc.sizing;
  config.fill = {.radius_edge_ratio = 1.4,
                 .circumradius_ratio = 0.85,
                 .min_dihedral_deg = 12.0,
                 .optimization_level = 4,
                 .smoothing_sweeps = 5};
  config.max_vertices = 200000;
  config.min_dihedral_deg = 1.0;
  config.seed = 1;
  return generate_gel(shape, config);
}

TetMesh file_mesh(const FileGel& file, const std::filesystem::path& shared) {
  const MshContent content = read_msh(resolve(file.path, shared));
  TetMesh gel;
  gel.positions = file.unit_m * content.positions * file.scale.asDiagonal();
  if (file.flip) gel.positions.rightCols<2>() *= -1.0;
  gel.positions.col(2).array() -= gel.positions.col(2).maxCoeff();
  gel.tets = content.tets;
  return gel;
}

BoxGel read_box(ConfigReader& in) {
  BoxGel box;
  const auto size = in.numbers("size_mm", 3, Range::positive());
  box.width_m = kMillimetre * size[0];
  box.height_m = kMillimetre * size[1];
  box.thickness_m = kMillimetre * size[2];
  box.near_m = kMillimetre * in.number("near_mm", Range::positive());
  box.near_half_m = kMillimetre * in.number("near_half_mm", Range::non_negative());
  box.growth = in.number("growth", Range::between(1.0, 3.0));
  box.far_m = kMillimetre * in.number("far_mm", Range::positive());
  box.layer_m = kMillimetre * in.number("layer_mm", Range::positive());
  box.layer_growth = in.number("layer_growth", Range::between(1.0, 3.0));
  if (const auto cut = in.optional_number("corner_cut_mm", Range::positive())) box.corner_cut_m = kMillimetre * *cut;
  if (auto crown = in.optional_section("crown")) {
    const auto half = crown->numbers("half_mm", 2, Range::positive());
    box.crown = Crown{.half_x_m = kMillimetre * half[0],
                      .half_y_m = kMillimetre * half[1],
                      .sag_m = kMillimetre * crown->number("sag_mm", Range::positive()),
                      .edge_sag_m = kMillimetre * crown->number("edge_sag_mm", Range::positive())};
    if (2.0 * box.crown->half_x_m >= box.width_m || 2.0 * box.crown->half_y_m >= box.height_m)
      crown->fault("half_mm", "must be less than half the gel's size");
    if (std::sqrt(2.0) * box.crown->edge_sag_m >= box.thickness_m)
      crown->fault("edge_sag_mm", "leaves no gel at the corners");
  }
  return box;
}

}  // namespace

std::vector<double> graded_lines(double half_m, double near_m, double near_half_m, double growth, double far_m,
                                 std::optional<double> last_m) {
  const double inner = half_m - last_m.value_or(0.0);
  const double near_end = std::min(near_half_m, inner);
  const int near_cells = std::max(1, static_cast<int>(std::ceil(near_end / near_m - 1e-9)));
  std::vector<double> right{0.0};
  if (near_end > 0.0)
    for (int i = 1; i <= near_cells; ++i) right.push_back(near_end * i / near_cells);
  // The graded part is laid out at its wanted lengths, then scaled to end on the border.
  std::vector<double> steps;
  double covered = 0.0;
  for (double step = std::min(near_m * growth, far_m); covered < (inner - near_end) * (1.0 - 1e-9);
       step = std::min(step * growth, far_m)) {
    steps.push_back(step);
    covered += step;
  }
  for (const double step : steps) right.push_back(right.back() + step * (inner - near_end) / covered);
  right.back() = inner;
  if (last_m) right.push_back(half_m);
  std::vector<double> lines;
  for (auto it = right.rbegin(); it != right.rend(); ++it) lines.push_back(0.0 - *it);
  lines.insert(lines.end(), right.begin() + 1, right.end());
  return lines;
}

GelSpec GelSpec::read(ConfigReader& in) {
  GelSpec spec;
  const int given = in.has("box") + in.has("disc") + in.has("file");
  if (given != 1) in.fault("box", "give one of box, disc, file");
  if (auto box = in.optional_section("box")) spec.shape = read_box(*box);
  if (auto disc = in.optional_section("disc")) {
    DiscGel gel;
    gel.radius_m = kMillimetre * disc->number("radius_mm", Range::positive());
    gel.thickness_m = kMillimetre * disc->number("thickness_mm", Range::positive());
    ConfigReader mesh = disc->section("mesh");
    gel.sizing = SizingConfig::read(mesh);
    spec.shape = gel;
  }
  if (auto file = in.optional_section("file")) {
    FileGel gel;
    gel.path = file->text("path");
    gel.unit_m = metres_per_unit(file->choice("unit", {"m", "cm", "mm", "um", "in"}));
    const auto scale = file->numbers_or("scale", {1.0, 1.0, 1.0}, Range::positive());
    gel.scale = {scale[0], scale[1], scale[2]};
    gel.flip = file->flag_or("flip", false);
    spec.shape = gel;
  }
  return spec;
}

TetMesh make_gel(const GelSpec& spec, const std::filesystem::path& shared) {
  if (const auto* disc = std::get_if<DiscGel>(&spec.shape)) return disc_mesh(*disc);
  const auto* box = std::get_if<BoxGel>(&spec.shape);
  TetMesh gel = box ? box_mesh(*box) : file_mesh(std::get<FileGel>(spec.shape), shared);
  tag_faces(gel);
  return gel;
}

GelShape shape_of(const GelSpec& spec, const TetMesh& gel) {
  const Vector3 extent = gel.positions.colwise().maxCoeff() - gel.positions.colwise().minCoeff();
  GelShape shape;
  shape.outline = std::holds_alternative<DiscGel>(spec.shape) ? GelShape::Outline::disc : GelShape::Outline::rectangle;
  shape.radius_m = extent.head<2>().maxCoeff() / 2.0;
  shape.width_m = extent.x();
  shape.height_m = extent.y();
  shape.thickness_m = extent.z();
  return shape;
}

}  // namespace tacipc::verify
