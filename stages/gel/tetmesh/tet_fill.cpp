#include "stages/gel/tetmesh/tet_fill.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "common/base/error.h"
#include "stages/gel/tetmesh/isolated.h"
#include "stages/gel/tetmesh/smooth.h"

#define TETLIBRARY
#include <tetgen.h>

namespace tacipc {
namespace {

constexpr double kUnitsPerMetre = 1e3;  // TetGen works in millimetres

/// Data of the callback by which TetGen asks whether a tetrahedron is too large; the callback is a bare function
/// pointer. They are set only in the child process that runs TetGen.
const std::function<double(const Vector3&)>* edge_length_of_run = nullptr;
double circumradius_ratio_of_run = 0.0;

/// Circumradius of abcd, or the longest edge if it has no volume.
double circumradius(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 u = b - a, v = c - a, w = d - a;
  const double six_volumes = u.dot(v.cross(w));
  const Vector3 top = u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v);
  if (std::abs(six_volumes) <= 1e-14 * u.norm() * v.norm() * w.norm()) return std::max({u.norm(), v.norm(), w.norm()});
  return top.norm() / (2.0 * std::abs(six_volumes));
}

bool is_too_large(REAL* pa, REAL* pb, REAL* pc, REAL* pd, REAL*, REAL) {
  const Eigen::Map<const Vector3> a(pa), b(pb), c(pc), d(pd);
  const double wanted = (*edge_length_of_run)((a + b + c + d) / (4.0 * kUnitsPerMetre)) * kUnitsPerMetre;
  return circumradius(a, b, c, d) > circumradius_ratio_of_run * wanted;
}

const char* reason(int code) {
  switch (code) {
    case 1: return "out of memory";
    case 2: return "internal error";
    case 3: return "the surface intersects itself";
    case 4: return "a feature of the surface is too small";
    case 5: return "two facets of the surface are too close";
    case 10: return "the surface was not accepted";
    default: return "unknown reason";
  }
}

void give_surface(const GelSurface& surface, tetgenio& in) {
  in.numberofpoints = static_cast<int>(surface.positions.rows());
  in.pointlist = new REAL[static_cast<std::size_t>(3 * in.numberofpoints)];
  Eigen::Map<Positions>(in.pointlist, in.numberofpoints, 3) = surface.positions * kUnitsPerMetre;
  in.numberoffacets = static_cast<int>(surface.triangles.rows());
  in.facetlist = new tetgenio::facet[static_cast<std::size_t>(in.numberoffacets)];
  in.facetmarkerlist = new int[static_cast<std::size_t>(in.numberoffacets)];
  for (int f = 0; f < in.numberoffacets; ++f) {
    tetgenio::facet& facet = in.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    for (int i = 0; i < 3; ++i) facet.polygonlist[0].vertexlist[i] = surface.triangles(f, i);
    in.facetmarkerlist[f] = static_cast<int>(surface.tags[static_cast<std::size_t>(f)]);
  }
}

double six_volumes(const Positions& x, const Eigen::RowVector4i& tet) {
  const Vector3 origin = x.row(tet[0]);
  const Vector3 a = x.row(tet[1]).transpose() - origin, b = x.row(tet[2]).transpose() - origin,
                c = x.row(tet[3]).transpose() - origin;
  return a.dot(b.cross(c));
}

/// Serialises vertices and tetrahedra: their counts, then the arrays.
std::string packed(const tetgenio& out) {
  const std::size_t points = sizeof(REAL) * 3 * static_cast<std::size_t>(out.numberofpoints),
                    tets = sizeof(int) * 4 * static_cast<std::size_t>(out.numberoftetrahedra);
  std::string bytes(2 * sizeof(int) + points + tets, '\0');
  std::memcpy(bytes.data(), &out.numberofpoints, sizeof(int));
  std::memcpy(bytes.data() + sizeof(int), &out.numberoftetrahedra, sizeof(int));
  if (points > 0) std::memcpy(bytes.data() + 2 * sizeof(int), out.pointlist, points);
  if (tets > 0) std::memcpy(bytes.data() + 2 * sizeof(int) + points, out.tetrahedronlist, tets);
  return bytes;
}

std::string run_tetgen(const GelSurface& surface, std::string switches) {
  tetgenio in, out;
  give_surface(surface, in);
  in.tetunsuitable = &is_too_large;
  try {
    tetrahedralize(switches.data(), &in, &out);
  } catch (int code) {
    throw DataError("gave up: {} (code {})", reason(code), code);
  }
  return packed(out);
}

TetMesh take_mesh(const GelSurface& surface, const std::string& bytes) {
  int num_points = 0, num_tets = 0;
  std::memcpy(&num_points, bytes.data(), sizeof(int));
  std::memcpy(&num_tets, bytes.data() + sizeof(int), sizeof(int));
  if (num_points < surface.positions.rows() || num_tets == 0) {
    throw DataError("TetGen gave back {} vertices and {} tets for a surface of {} vertices", num_points, num_tets,
                    surface.positions.rows());
  }
  TetMesh mesh;
  mesh.positions.resize(num_points, 3);
  mesh.tets.resize(num_tets, 4);
  const std::size_t points = sizeof(double) * static_cast<std::size_t>(mesh.positions.size());
  std::memcpy(mesh.positions.data(), bytes.data() + 2 * sizeof(int), points);
  std::memcpy(mesh.tets.data(), bytes.data() + 2 * sizeof(int) + points,
              sizeof(int) * static_cast<std::size_t>(mesh.tets.size()));
  mesh.positions /= kUnitsPerMetre;
  mesh.positions.topRows(surface.positions.rows()) = surface.positions;
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
    if (six_volumes(mesh.positions, mesh.tets.row(t)) < 0.0) std::swap(mesh.tets(t, 0), mesh.tets(t, 1));
  }
  mesh.boundary = surface.triangles;
  mesh.tags = surface.tags;
  return mesh;
}

}  // namespace

FillConfig FillConfig::read(ConfigReader& in) {
  return {.radius_edge_ratio = in.number("radius_edge_ratio", Range::between(1.0, 10.0)),
          .circumradius_ratio = in.number("circumradius_ratio", Range::between(0.3, 3.0)),
          .min_dihedral_deg = in.number("min_dihedral_deg", Range::between(0.0, 20.0)),
          .optimization_level = in.integer("optimization_level", 0, 10),
          .smoothing_sweeps = in.integer("smoothing_sweeps", 0, 100)};
}

TetMesh fill_with_tets(const GelSurface& surface, const FillConfig& config,
                       const std::function<double(const Vector3&)>& edge_length_m) {
  const auto left = static_cast<int>(std::max<Eigen::Index>(1, config.max_vertices - surface.positions.rows()));
  // p: from a surface; Y: keep its triangles; q: shape bounds; O: optimise with all operations; S: largest number of
  // new vertices; Q: quiet.
  const std::string switches = fmt::format("pYq{}/{}O{}/7S{}Q", config.radius_edge_ratio, config.min_dihedral_deg,
                                           config.optimization_level, left);
  // After some errors TetGen frees memory twice.
  const std::string filled = run_isolated("TetGen (" + switches + ")", [&] {
    edge_length_of_run = &edge_length_m;
    circumradius_ratio_of_run = config.circumradius_ratio;
    return run_tetgen(surface, switches);
  });
  TetMesh mesh = take_mesh(surface, filled);
  if (mesh.num_vertices() - surface.positions.rows() >= left) {
    throw DataError(
        "the refinement reached max_vertices {:g}; radius_edge_ratio {:g} or circumradius_ratio {:g} may be too small",
        static_cast<double>(config.max_vertices), config.radius_edge_ratio, config.circumradius_ratio);
  }
  smooth(mesh, config.smoothing_sweeps);
  return mesh;
}

}  // namespace tacipc
