#include "stages/tetmesh/tet_fill.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <new>
#include <string>

#include "common/error.h"
#include "stages/tetmesh/smooth.h"

#define TETLIBRARY
#include <tetgen.h>

namespace tacipc {
namespace {

constexpr double kUnitsPerMetre = 1e3;  // TetGen sees millimetres

/// TetGen asks through a bare function pointer whether a tet is too large; these carry what the answer needs.
const std::function<double(const Vector3&)>* edge_length_of_run = nullptr;
double circumradius_ratio_of_run = 0.0;
std::mutex one_run_at_a_time;

/// Circumradius of abcd, or the longest edge where it has no volume.
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

/// Keeps standard output empty while a library writes to it.
class SilentStdout {
 public:
  SilentStdout() {
    std::fflush(stdout);
    kept_ = dup(STDOUT_FILENO);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) {
      dup2(nowhere, STDOUT_FILENO);
      close(nowhere);
    }
  }
  ~SilentStdout() {
    std::fflush(stdout);
    if (kept_ >= 0) {
      dup2(kept_, STDOUT_FILENO);
      close(kept_);
    }
  }
  SilentStdout(const SilentStdout&) = delete;
  SilentStdout& operator=(const SilentStdout&) = delete;

 private:
  int kept_ = -1;
};

const char* reason(int code) {
  switch (code) {
    case 1:
      return "out of memory";
    case 2:
      return "internal error";
    case 3:
      return "the surface intersects itself";
    case 4:
      return "a feature of the surface is too small";
    case 5:
      return "two facets of the surface are too close";
    case 10:
      return "the surface was not accepted";
    default:
      return "unknown reason";
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

TetMesh take_mesh(const GelSurface& surface, const tetgenio& out) {
  if (out.numberofpoints < surface.positions.rows() || out.numberoftetrahedra == 0) {
    throw DataError("TetGen gave back {} vertices and {} tets for a surface of {} vertices", out.numberofpoints,
                    out.numberoftetrahedra, surface.positions.rows());
  }
  TetMesh mesh;
  mesh.positions = Eigen::Map<const Positions>(out.pointlist, out.numberofpoints, 3) / kUnitsPerMetre;
  mesh.positions.topRows(surface.positions.rows()) = surface.positions;
  mesh.tets = Eigen::Map<const Tetrahedra>(out.tetrahedronlist, out.numberoftetrahedra, 4);
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
  const std::scoped_lock lock(one_run_at_a_time);
  edge_length_of_run = &edge_length_m;
  circumradius_ratio_of_run = config.circumradius_ratio;
  // p: from a surface; Y: keep its triangles; q: shape bounds; O: optimise with all operations; Q: quiet.
  std::string switches =
      fmt::format("pYq{}/{}O{}/7Q", config.radius_edge_ratio, config.min_dihedral_deg, config.optimization_level);
  tetgenio in, out;
  give_surface(surface, in);
  in.tetunsuitable = &is_too_large;
  try {
    const SilentStdout silent;
    tetrahedralize(switches.data(), &in, &out);
  } catch (int code) {
    throw DataError("TetGen gave up: {} (code {}, switches {})", reason(code), code, switches);
  } catch (const std::bad_alloc&) {
    throw DataError("TetGen gave up: out of memory (switches {})", switches);
  }
  TetMesh mesh = take_mesh(surface, out);
  smooth(mesh, config.smoothing_sweeps);
  return mesh;
}

}  // namespace tacipc
