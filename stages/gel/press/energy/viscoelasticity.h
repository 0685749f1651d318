// Viscoelastic gels: a Prony series over the elastic stress of their tetrahedra.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/sensor/sensor.h"
#include "stages/gel/press/energy/viscous_memory.h"

namespace tacipc {

/// Generalised Maxwell model [Simo & Hughes 1998, ch. 10]. The relaxation modulus is
///   E(t) = E₀ [g∞ + Σ gᵢ e^{−t/τᵢ}],   g∞ = 1 − Σ gᵢ;
/// Poisson's ratio is constant in time. The elastic law has the long-term modulus E∞ = g∞ E₀ and the stress S (second
/// Piola–Kirchhoff, so that a rotation of the gel does not enter its history). The total stress is
///   S + Σ Qᵢ,   Q̇ᵢ + Qᵢ/τᵢ = rᵢ Ṡ,   rᵢ = gᵢ/g∞.
/// Over a step h in which S changes at a constant rate this is exactly
///   Qᵢ ← e^{−h/τᵢ} Qᵢ + rᵢ ξᵢ (S_{n+1} − S_n),   ξᵢ = (1 − e^{−h/τᵢ}) τᵢ/h.
/// It is the derivative by Green's strain of an energy of which only the first part depends on the law:
///   (1 + Σ rᵢ ξᵢ) ψ + M : E,   M = Σ (e^{−h/τᵢ} Qᵢ − rᵢ ξᵢ S_n) constant during the step (ViscousMemory).
/// Each of several bodies has its own series; a body without one is elastic.
class Viscoelasticity {
 public:
  /// A body: its series, and the stress in its tetrahedra if the series has members.
  struct Body {
    std::vector<Relaxation> series;
    std::optional<TetStress> stress;
  };
  /// \pre the series of at least one body has members; the parts of each series sum to less than 1
  explicit Viscoelasticity(const std::vector<Body>& bodies);

  /// Qᵢ of each member of the series, body by body, one row per tetrahedron of the body, Pa. Empty before the first
  /// step, which starts at rest.
  using History = std::vector<SymmetricRows>;

  /// S at x, one row per tetrahedron of the viscoelastic bodies.
  SymmetricRows stress(const Positions& x) const;
  /// Factor 1 + Σ rᵢ ξᵢ on the elastic energy of each body in a step: E₀/E∞ for short steps, 1 for long ones and for a
  /// body without a series.
  std::vector<double> elastic_factors(double h_s) const;
  /// Energy M : E of a step from stress S_n.
  std::shared_ptr<const ViscousMemory> memory(const History& history, const SymmetricRows& start_pa, double h_s) const;
  /// Σ Qᵢ of a body by its index, one row per tetrahedron; no rows if it has no history.
  SymmetricRows remembered(const History& history, std::size_t body) const;
  /// Advances the history over a step that changed S by `change_pa`.
  void advance(History& history, const SymmetricRows& change_pa, double h_s) const;

 private:
  struct Member {
    double ratio;  // ratio r
    double time_s;

    double decay(double h_s) const;       // decay e^{−h/τ} over the step
    double mean_decay(double h_s) const;  // mean ξ of the decay over the step
  };
  struct Relaxing {
    std::size_t body;
    std::vector<Member> series;
    TetStress stress;
    Eigen::Index first_row, num_rows;  // rows of its stress

    double elastic_factor(double h_s) const;
  };
  std::vector<Relaxing> relaxing_;
  std::size_t num_bodies_;
  std::shared_ptr<const RestBody> body_;  // tetrahedra of all viscoelastic bodies
};

}  // namespace tacipc
