#include "verification/gel_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "common/base/units.h"
#include "common/mesh/triangle_mesh.h"
#include "stages/gel/tetmesh/generate.h"
#include "verification/shared_files.h"

namespace tacipc::verify {
namespace {

using LatticePoint = std::array<int, 3>;

/// Block of cells whose corners are the points (i, j, k), 0 ≤ i ≤ cells[0] and so on. Points at the same position (a
/// closed ring, an axis) have the same representative; cells that touch a point without one are left out.
struct Lattice {
  LatticePoint cells;
  LatticePoint shift{0, 0,
                     0};  // cells that are walked upwards along an axis: 0: those of even index, 1: those of odd index
  std::function<std::optional<LatticePoint>(const LatticePoint&)> representative;
  std::function<Vector3(const LatticePoint&)> position;  // position of a representative, m
};

// Kuhn's subdivision: one tetrahedron for each order in which the three axes are walked through a cell. The parity of a
// cell's index decides whether it is walked upwards or downwards along an axis, so that neighbours mirror each other.
constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

/// Splits each cell into six tetrahedra (Kuhn), mirrored from cell to cell so that no direction is preferred.
/// Tetrahedra that the representatives flatten are left out. Volumes are positive, and unused vertices are dropped. A
/// ring that closes along an axis needs an even number of cells there. The result has no boundary and no tags.
TetMesh fill_lattice(const Lattice& lattice) {
  const auto& [nx, ny, nz] = lattice.cells;
  const auto index = [&](const LatticePoint& p) { return (p[2] * (ny + 1) + p[1]) * (nx + 1) + p[0]; };
  std::vector<std::array<int, 4>> tets;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const LatticePoint up{(i + lattice.shift[0]) % 2 == 0, (j + lattice.shift[1]) % 2 == 0,
                              (k + lattice.shift[2]) % 2 == 0};
        for (const auto& order : kOrders) {
          LatticePoint at{i + !up[0], j + !up[1], k + !up[2]};
          std::array<int, 4> tet{};
          bool whole = true;
          for (int s = 0; s < 4; ++s) {
            if (s > 0) at[order[s - 1]] += up[order[s - 1]] ? 1 : -1;
            const auto point = lattice.representative(at);
            tet[s] = point ? index(*point) : -1;
            whole = whole && point && std::find(tet.begin(), tet.begin() + s, tet[s]) == tet.begin() + s;
          }
          if (whole) tets.push_back(tet);
        }
      }
    }
  }
  std::vector<int> number((nx + 1) * (ny + 1) * (nz + 1), -1);
  for (const auto& tet : tets)
    for (const int v : tet) number[v] = 0;
  TetMesh gel;
  gel.positions.resize(std::ranges::count(number, 0), 3);
  int used = 0;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        int& n = number[index({i, j, k})];
        if (n < 0) continue;
        n = used++;
        gel.positions.row(n) = lattice.position({i, j, k});
      }
    }
  }
  gel.tets.resize(tets.size(), 4);
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

/// Steps that fill `length`: the first is `first`, each further one `growth` times the previous, at most `longest`.
/// Then all are scaled to end at the border.
std::vector<double> growing_steps(double length, double first, double growth, double longest) {
  std::vector<double> steps;
  double covered = 0.0;
  for (double step = std::min(first, longest); covered < length * (1.0 - 1e-9);
       step = std::min(step * growth, longest)) {
    steps.push_back(step);
    covered += step;
  }
  for (double& step : steps) step *= length / covered;
  return steps;
}

/// Heights of the layers, 0 at the front.
std::vector<double> layer_heights(double thickness_m, double layer_m, double growth) {
  std::vector<double> z{0.0};
  for (const double step : growing_steps(thickness_m, layer_m, growth, thickness_m)) z.push_back(z.back() - step);
  z.back() = -thickness_m;
  return z;
}

int cells_of(const std::vector<double>& lines) { return static_cast<int>(lines.size()) - 1; }

TetMesh box_mesh(const BoxGel& box) {
  const std::vector<double> xs =
      graded_lines(box.width_m / 2, box.near_m, box.near_half_m, box.growth, box.far_m, box.corner_cut_m);
  const std::vector<double> ys =
      graded_lines(box.height_m / 2, box.near_m, box.near_half_m, box.growth, box.far_m, box.corner_cut_m);
  const std::vector<double> zs = layer_heights(box.thickness_m, box.layer_m, box.layer_growth);
  const int nx = cells_of(xs), ny = cells_of(ys);
  Lattice lattice;
  lattice.cells = {nx, ny, cells_of(zs)};
  lattice.shift = {1, 0, 0};  // lays the diagonals of the corner cells along the cut
  lattice.representative = [&](const LatticePoint& p) -> std::optional<LatticePoint> {
    const bool corner = (p[0] == 0 || p[0] == nx) && (p[1] == 0 || p[1] == ny);
    if (corner && box.corner_cut_m) return std::nullopt;
    return p;
  };
  lattice.position = [&](const LatticePoint& p) {
    const double x = xs[p[0]], y = ys[p[1]];
    double top = 0.0;
    if (box.crown) {
      const Crown& c = *box.crown;
      top = -std::hypot(sag_along(x, c.half_x_m, box.width_m / 2, c.sag_m, c.edge_sag_m),
                        sag_along(y, c.half_y_m, box.height_m / 2, c.sag_m, c.edge_sag_m));
    }
    return Vector3(x, y, top + zs[p[2]] * (box.thickness_m + top) / box.thickness_m);
  };
  return fill_lattice(lattice);
}

TetMesh ring_mesh(const RingGel& gel) {
  const std::vector<double> radii = ring_radii(gel), zs = layer_heights(gel.thickness_m, gel.layer_m, gel.layer_growth);
  Lattice lattice;
  lattice.cells = {cells_of(radii), gel.sectors, cells_of(zs)};
  lattice.representative = [&](const LatticePoint& p) {
    return std::optional(LatticePoint{p[0], p[0] == 0 ? 0 : p[1] % gel.sectors, p[2]});
  };
  lattice.position = [&](const LatticePoint& p) {
    const double angle = 2.0 * std::numbers::pi * p[1] / gel.sectors;
    return Vector3(radii[p[0]] * std::cos(angle), radii[p[0]] * std::sin(angle), zs[p[2]]);
  };
  return fill_lattice(lattice);
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

RingGel read_rings(ConfigReader& in) {
  RingGel gel;
  gel.radius_m = kMillimetre * in.number("radius_mm", Range::positive());
  gel.thickness_m = kMillimetre * in.number("thickness_mm", Range::positive());
  gel.sectors = in.integer("sectors", 6, 1000);
  if (gel.sectors % 2 != 0) in.fault("sectors", "must be even");
  const auto focus = in.numbers("focus_mm", 2, Range::non_negative());
  gel.focus_from_m = kMillimetre * focus[0];
  gel.focus_to_m = kMillimetre * focus[1];
  if (!(gel.focus_from_m <= gel.focus_to_m && gel.focus_to_m < gel.radius_m))
    in.fault("focus_mm", "must be two radii, the first not above the second, both less than radius_mm");
  gel.near_m = kMillimetre * in.number("near_mm", Range::positive());
  gel.growth = in.number("growth", Range::between(1.0, 3.0));
  gel.far_m = kMillimetre * in.number("far_mm", Range::positive());
  gel.layer_m = kMillimetre * in.number("layer_mm", Range::positive());
  gel.layer_growth = in.number("layer_growth", Range::between(1.0, 3.0));
  return gel;
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
  for (const double step : growing_steps(inner - near_end, near_m * growth, growth, far_m))
    right.push_back(right.back() + step);
  right.back() = inner;
  if (last_m) right.push_back(half_m);
  std::vector<double> lines;
  for (auto it = right.rbegin(); it != right.rend(); ++it) lines.push_back(0.0 - *it);
  lines.insert(lines.end(), right.begin() + 1, right.end());
  return lines;
}

std::vector<double> ring_radii(const RingGel& gel) {
  std::vector<double> inside, radii{0.0};
  if (gel.focus_from_m > 0.0) inside = growing_steps(gel.focus_from_m, gel.near_m * gel.growth, gel.growth, gel.far_m);
  for (auto step = inside.rbegin(); step != inside.rend(); ++step) radii.push_back(radii.back() + *step);
  radii.back() = gel.focus_from_m;
  const double width = gel.focus_to_m - gel.focus_from_m;
  const int cells = static_cast<int>(std::ceil(width / gel.near_m - 1e-9));
  for (int i = 1; i <= cells; ++i) radii.push_back(gel.focus_from_m + width * i / cells);
  for (const double step : growing_steps(gel.radius_m - gel.focus_to_m, gel.near_m * gel.growth, gel.growth, gel.far_m))
    radii.push_back(radii.back() + step);
  radii.back() = gel.radius_m;
  return radii;
}

GelSpec GelSpec::read(ConfigReader& in) {
  GelSpec spec;
  const int given = in.has("box") + in.has("rings") + in.has("disc") + in.has("file");
  if (given != 1) in.fault("box", "give one of box, rings, disc, file");
  if (auto rings = in.optional_section("rings")) spec.shape = read_rings(*rings);
  if (auto box = in.optional_section("box")) spec.shape = read_box(*box);
  if (auto disc = in.optional_section("disc")) {
    DiscGel gel;
    gel.radius_m = kMillimetre * disc->number("radius_mm", Range::positive());
    gel.thickness_m = kMillimetre * disc->number("thickness_mm", Range::positive());
    gel.sizing = disc->read<SizingConfig>("mesh");
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
  TetMesh gel;
  if (const auto* box = std::get_if<BoxGel>(&spec.shape)) gel = box_mesh(*box);
  if (const auto* rings = std::get_if<RingGel>(&spec.shape)) gel = ring_mesh(*rings);
  if (const auto* file = std::get_if<FileGel>(&spec.shape)) gel = file_mesh(*file, shared);
  tag_faces(gel);
  return gel;
}

GelShape shape_of(const GelSpec& spec, const TetMesh& gel) {
  const Vector3 extent = gel.positions.colwise().maxCoeff() - gel.positions.colwise().minCoeff();
  GelShape shape;
  const bool round = std::holds_alternative<DiscGel>(spec.shape) || std::holds_alternative<RingGel>(spec.shape);
  shape.outline = round ? GelShape::Outline::disc : GelShape::Outline::rectangle;
  shape.radius_m = extent.head<2>().maxCoeff() / 2.0;
  shape.width_m = extent.x();
  shape.height_m = extent.y();
  shape.thickness_m = extent.z();
  return shape;
}

}  // namespace tacipc::verify
