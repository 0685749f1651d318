// Gels whose stress relaxes: a Prony series over the elastic stress of their tetrahedra.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/sensor/sensor.h"
#include "stages/gel/press/energy/viscous_memory.h"

namespace tacipc {

/// Generalised Maxwell model [Simo & Hughes 1998, ch. 10]. A strain that comes at once and stays has the modulus
///   E(t) = E₀ [g∞ + Σ gᵢ e^{−t/τᵢ}],   g∞ = 1 − Σ gᵢ,
/// in time; Poisson's ratio is the same at all times. The elastic law has the long-term modulus E∞ = g∞ E₀ and the
/// stress S (second Piola–Kirchhoff, so that a rotation of the gel is none of its history), and the whole stress is
///   S + Σ Qᵢ,   Q̇ᵢ + Qᵢ/τᵢ = rᵢ Ṡ,   rᵢ = gᵢ/g∞.
/// Over a step h in which S changes at a constant rate this is exactly
///   Qᵢ ← e^{−h/τᵢ} Qᵢ + rᵢ ξᵢ (S_{n+1} − S_n),   ξᵢ = (1 − e^{−h/τᵢ}) τᵢ/h,
/// the derivative by Green's strain of an energy of which only the first part depends on the law:
///   (1 + Σ rᵢ ξᵢ) ψ + M : E,   M = Σ (e^{−h/τᵢ} Qᵢ − rᵢ ξᵢ S_n) held during the step (ViscousMemory).
/// Of several bodies each has a series of its own, or none: it is elastic then, and none of this concerns it.
class Viscoelasticity {
 public:
  /// A body: its series, and the stress in its tetrahedra, none where the series has no members.
  struct Body {
    std::vector<Relaxation> series;
    std::optional<TetStress> stress;
  };
  /// \pre the series of at least one body has members; the parts of each series sum to less than 1
  explicit Viscoelasticity(const std::vector<Body>& bodies);

  /// Qᵢ of each member of the series, body by body, a row for each tetrahedron of its body, Pa; none before the first
  /// step, which starts at rest.
  using History = std::vector<SymmetricRows>;

  /// S at x, a row for each tetrahedron of the bodies whose stress relaxes.
  SymmetricRows stress(const Positions& x) const;
  /// 1 + Σ rᵢ ξᵢ of each body: what a step multiplies its elastic energy by. E₀/E∞ for short steps, 1 for long ones and
  /// for a body without a series.
  std::vector<double> elastic_factors(double h_s) const;
  /// The other part of the energy of a step from stress S_n.
  std::shared_ptr<const ViscousMemory> memory(const History& history, const SymmetricRows& start_pa, double h_s) const;
  /// Σ Qᵢ of a body, by its number, a row for each of its tetrahedra; no rows where it remembers nothing.
  SymmetricRows remembered(const History& history, std::size_t body) const;
  /// Takes the history over a step that changed S by `change_pa`.
  void advance(History& history, const SymmetricRows& change_pa, double h_s) const;

 private:
  struct Member {
    double ratio;  // r
    double time_s;

    double decay(double h_s) const;       // e^{−h/τ}
    double mean_decay(double h_s) const;  // ξ, its mean over the step
  };
  struct Relaxing {
    std::size_t body;
    std::vector<Member> series;
    TetStress stress;
    Eigen::Index first_row, num_rows;  // of the stress

    double elastic_factor(double h_s) const;
  };
  std::vector<Relaxing> relaxing_;
  std::size_t num_bodies_;
  std::shared_ptr<const RestBody> body_;  // tetrahedra of all that relax
};

}  // namespace tacipc
