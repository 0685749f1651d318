#include "stages/gel/press/energy/elastic_packs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacipc {
namespace {

/// F = Σ_k (x_k − x_0) b_kᵀ by rows, with its cofactors.
struct Deformation {
  Pack3 row[3];       // rows of F
  Pack3 cofactor[3];  // rows of J F⁻ᵀ
  Pack J;
};

TACIPC_INLINE void add_cofactors(Deformation& d) {
  d.cofactor[0] = cross(d.row[1], d.row[2]);
  d.cofactor[1] = cross(d.row[2], d.row[0]);
  d.cofactor[2] = cross(d.row[0], d.row[1]);
  d.J = dot(d.row[0], d.cofactor[0]);
}

TACIPC_INLINE Deformation deformation(const double* x, const std::array<std::array<int, kLanes>, 4>& vertices,
                                      const Pack3* b) {
  const Pack3 x0 = load_rows(x, vertices[0]);
  const Pack3 e1 = load_rows(x, vertices[1]) - x0, e2 = load_rows(x, vertices[2]) - x0,
              e3 = load_rows(x, vertices[3]) - x0;
  Deformation d;
  d.row[0] = e1.x * b[0] + e2.x * b[1] + e3.x * b[2];
  d.row[1] = e1.y * b[0] + e2.y * b[1] + e3.y * b[2];
  d.row[2] = e1.z * b[0] + e2.z * b[1] + e3.z * b[2];
  add_cofactors(d);
  return d;
}

TACIPC_CLONES void deformed_volumes(const double* x, const std::array<std::array<int, kLanes>, 4>& vertices,
                                    const Pack3* b, const Pack& volume, double* out) {
  const Pack deformed = volume * deformation(x, vertices, b).J;
  for (int l = 0; l < kLanes; ++l) out[l] = deformed[l];
}

/// V ψ(F) lane by lane; NaN if J ≤ 0.
TACIPC_CLONES void energies(const double* x, const std::array<std::array<int, kLanes>, 4>& vertices, const Pack3* b,
                            const Pack& volume, double mu, double lambda, double* out) {
  Deformation d = deformation(x, vertices, b);
  const Pack log_J = logarithm(d.J);
  // tr FᵀF − 3 as a function of F − I, so that a gel at rest has no rounding energy.
  d.row[0].x -= 1.0;
  d.row[1].y -= 1.0;
  d.row[2].z -= 1.0;
  const Pack trace = d.row[0].x + d.row[1].y + d.row[2].z;
  const Pack squares = dot(d.row[0], d.row[0]) + dot(d.row[1], d.row[1]) + dot(d.row[2], d.row[2]);
  const Pack value = volume * (0.5 * mu * (squares + 2.0 * trace) - mu * log_J + 0.5 * lambda * log_J * log_J);
  for (int l = 0; l < kLanes; ++l) out[l] = d.J[l] > 0.0 ? value[l] : std::nan("");
}

/// Constants of one pack: V, μ and λ.
struct Stiffness {
  Pack volume;
  double mu, lambda;
};

/// Factors of gradient and Hessian: bᵢ, gᵢ = F⁻ᵀ bᵢ, l = λ + p J and a = μ − λ ln J − p J.
struct Shapes {
  Pack3 b[4], g[4];
  Pack volume_mu, volume_a, volume_l;
};

TACIPC_INLINE Shapes shapes(const Deformation& d, const Pack3* rest, const Stiffness& k, const Pack& p_J) {
  Shapes s;
  Pack a = k.mu - p_J;
  if (k.lambda != 0.0) a -= k.lambda * logarithm(d.J);
  const Pack inverse_J = 1.0 / d.J;
  for (int i = 1; i < 4; ++i) {
    s.b[i] = rest[i - 1];
    s.g[i] = inverse_J * Pack3{dot(d.cofactor[0], s.b[i]), dot(d.cofactor[1], s.b[i]), dot(d.cofactor[2], s.b[i])};
  }
  s.b[0] = Pack3{} - (s.b[1] + s.b[2] + s.b[3]);
  s.g[0] = Pack3{} - (s.g[1] + s.g[2] + s.g[3]);
  s.volume_mu = k.volume * k.mu;
  s.volume_a = k.volume * a;
  s.volume_l = k.volume * (k.lambda + p_J);
  return s;
}

/// Gradients V (μ F bᵢ − a gᵢ).
TACIPC_INLINE void gradients(const Deformation& d, const Shapes& s, Pack (*out)[3]) {
  for (int k = 0; k < 4; ++k) {
    out[k][0] = s.volume_mu * dot(d.row[0], s.b[k]) - s.volume_a * s.g[k].x;
    out[k][1] = s.volume_mu * dot(d.row[1], s.b[k]) - s.volume_a * s.g[k].y;
    out[k][2] = s.volume_mu * dot(d.row[2], s.b[k]) - s.volume_a * s.g[k].z;
  }
}

/// Blocks V [μ (bᵢ·bⱼ) I + a gⱼ gᵢᵀ + l gᵢ gⱼᵀ].
TACIPC_INLINE void blocks(const Shapes& s, Pack (*out)[9]) {
  int at = 0;
  for (int j = 0; j < 4; ++j) {
    const Pack3 a_gj = s.volume_a * s.g[j], l_gj = s.volume_l * s.g[j];
    for (int i = j; i < 4; ++i, ++at) {
      Pack* h = out[at];
      const Pack3& gi = s.g[i];
      const Pack diagonal = s.volume_mu * dot(s.b[i], s.b[j]);
      h[0] = a_gj.x * gi.x + l_gj.x * gi.x + diagonal;
      h[1] = a_gj.y * gi.x + l_gj.x * gi.y;
      h[2] = a_gj.z * gi.x + l_gj.x * gi.z;
      h[3] = a_gj.x * gi.y + l_gj.y * gi.x;
      h[4] = a_gj.y * gi.y + l_gj.y * gi.y + diagonal;
      h[5] = a_gj.z * gi.y + l_gj.y * gi.z;
      h[6] = a_gj.x * gi.z + l_gj.z * gi.x;
      h[7] = a_gj.y * gi.z + l_gj.z * gi.y;
      h[8] = a_gj.z * gi.z + l_gj.z * gi.z + diagonal;
    }
  }
}

TACIPC_INLINE Pack of_lanes(const double* pressure) {
  Pack p = {};
  if (pressure) {
    for (int l = 0; l < kLanes; ++l) p[l] = pressure[l];
  }
  return p;
}

TACIPC_CLONES void differentiate(const double* x, const std::array<std::array<int, kLanes>, 4>& vertices,
                                 const Pack3* rest, const Stiffness& stiffness, const double* pressure,
                                 ElasticPacks::State& state, ElasticPacks::Derivatives& out) {
  const Deformation d = deformation(x, vertices, rest);
  for (int r = 0; r < 3; ++r) state.row[r] = d.row[r];
  state.pressure_J = of_lanes(pressure) * d.J;
  const Shapes s = shapes(d, rest, stiffness, state.pressure_J);
  gradients(d, s, out.gradient);
  blocks(s, out.hessian);
}

TACIPC_CLONES bool differentiate_change(const double* x, const std::array<std::array<int, kLanes>, 4>& vertices,
                                        const Pack3* rest, const Stiffness& stiffness, const double* pressure,
                                        double tolerance, ElasticPacks::State& known, ElasticPacks::Derivatives& out) {
  const Deformation d = deformation(x, vertices, rest);
  const Pack p_J = of_lanes(pressure) * d.J;
  const Shapes s = shapes(d, rest, stiffness, p_J);
  gradients(d, s, out.gradient);
  // ‖ΔF F⁻¹‖² J², because F⁻ᵀ is the cofactors over J.
  Pack squared = {};
  for (int r = 0; r < 3; ++r) {
    const Pack3 change = d.row[r] - known.row[r];
    for (const Pack3& cofactor : d.cofactor) {
      const Pack part = dot(change, cofactor);
      squared += part * part;
    }
  }
  const Pack of_pressure = (p_J - known.pressure_J) / stiffness.mu, one = Pack{} + 1.0;
  const double limit = tolerance * tolerance;
  if (all_of((squared <= limit * d.J * d.J) & (of_pressure * of_pressure <= limit * one))) return false;

  Deformation before;
  for (int r = 0; r < 3; ++r) before.row[r] = known.row[r];
  add_cofactors(before);
  Pack old[ElasticPacks::kBlocks][9];
  blocks(shapes(before, rest, stiffness, known.pressure_J), old);
  blocks(s, out.hessian);
  for (int b = 0; b < ElasticPacks::kBlocks; ++b) {
    for (int k = 0; k < 9; ++k) out.hessian[b][k] -= old[b][k];
  }
  for (int r = 0; r < 3; ++r) known.row[r] = d.row[r];
  known.pressure_J = p_J;
  return true;
}

}  // namespace

ElasticPacks::ElasticPacks(const Tetrahedra& tets, const std::vector<RestTet>& rest, const NeoHookean& law,
                           const std::vector<int>& order, const std::vector<int>& rank)
    : law_(law) {
  const int count = static_cast<int>(tets.rows());
  for (int first = 0; first < count; first += kLanes) {
    Rest& pack = packs_.emplace_back();
    pack.corners.count = std::min(kLanes, count - first);
    for (int l = 0; l < kLanes; ++l) {
      const int t = order[static_cast<std::size_t>(std::min(first + l, count - 1))];
      std::array<int, 4> sorted{0, 1, 2, 3};
      std::sort(sorted.begin(), sorted.end(), [&](int a, int b) { return rank[tets(t, a)] < rank[tets(t, b)]; });
      for (int k = 0; k < 4; ++k) pack.corners.vertices[k][l] = tets(t, sorted[k]);
      for (int k = 1; k < 4; ++k) {
        const Vector3 b = rest[t].shape_gradients.col(sorted[k]);
        pack.shape_gradients[k - 1].x[l] = b.x();
        pack.shape_gradients[k - 1].y[l] = b.y();
        pack.shape_gradients[k - 1].z[l] = b.z();
      }
      pack.volume_m3[l] = l < pack.corners.count ? rest[t].volume_m3 : 0.0;
    }
  }
}

double ElasticPacks::value(const Positions& x) const {
  const double sum = ordered_sum(size(), [&](int first, int last) {
    double part = 0.0, lanes[kLanes];
    for (int i = first; i < last; ++i) {
      const Rest& pack = packs_[static_cast<std::size_t>(i)];
      energies(x.data(), pack.corners.vertices, pack.shape_gradients, pack.volume_m3, law_.mu_pa, law_.lambda_pa,
               lanes);
      for (const double one : lanes) part += one;
    }
    return part;
  });
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

void ElasticPacks::volumes(int i, const Positions& x, double* out) const {
  const Rest& pack = packs_[static_cast<std::size_t>(i)];
  deformed_volumes(x.data(), pack.corners.vertices, pack.shape_gradients, pack.volume_m3, out);
}

void ElasticPacks::derivatives(int i, const Positions& x, const double* pressure, State& state,
                               Derivatives& out) const {
  const Rest& pack = packs_[static_cast<std::size_t>(i)];
  differentiate(x.data(), pack.corners.vertices, pack.shape_gradients, {pack.volume_m3, law_.mu_pa, law_.lambda_pa},
                pressure, state, out);
}

bool ElasticPacks::change(int i, const Positions& x, const double* pressure, double tolerance, State& known,
                          Derivatives& out) const {
  const Rest& pack = packs_[static_cast<std::size_t>(i)];
  return differentiate_change(x.data(), pack.corners.vertices, pack.shape_gradients,
                              {pack.volume_m3, law_.mu_pa, law_.lambda_pa}, pressure, tolerance, known, out);
}

}  // namespace tacipc
