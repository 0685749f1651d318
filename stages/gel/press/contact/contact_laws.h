// Contact laws: friction and barrier of each pair of bodies, resolved once before the first step.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "stages/gel/press/contact/contact_mesh.h"
#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Interaction of the surfaces of two bodies.
struct ContactLaw {
  double friction = 0.0;   // coefficient of friction μ
  double d_hat_m = 0.0;    // d̂: range of the barrier; it acts at smaller gaps
  double stiffness = 1.0;  // factor on the barrier's stiffness κ
};

/// Deviation of one pair of bodies from the usual law; absent values are the usual ones.
struct LawOverride {
  std::array<int, 2> between{};  // indices of the bodies (ContactMesh::body_of()); they may be equal
  std::optional<double> friction = std::nullopt;
  std::optional<double> d_hat_m = std::nullopt;
  std::optional<double> force = std::nullopt;  // factor on the usual force at the same gap over d̂
};

/// Law of each pair of bodies: the only source of μ and d̂ for searches, energies and step limits.
class ContactLaws {
 public:
  /// All pairs share one law.
  explicit ContactLaws(const ContactLaw& shared = {})
      : laws_{shared}, reach_m_(shared.d_hat_m), largest_friction_(shared.friction) {}

  /// Resolves the laws of bodies 0 … num_bodies − 1. If several overrides set the same value of a pair, the last one
  /// counts. A pair with a smaller d̂ has the usual force at the same ratio of gap to d̂: κ grows with 1/d̂³.
  static ContactLaws resolved(const ContactLaw& usual, int num_bodies, const std::vector<LawOverride>& overrides);

  bool all_alike() const { return laws_.size() == 1; }
  const ContactLaw& of(int body, int other) const { return laws_[index(body, other)]; }

  /// Index in all() of the law that applies to a contact pair.
  std::size_t index(const ContactMesh& mesh, const ContactPair& pair) const {
    return all_alike() ? 0 : index(mesh.body_of(pair.vertices[0]), mesh.body_of(pair.vertices[3]));
  }
  const std::vector<ContactLaw>& all() const { return laws_; }

  /// Largest d̂ of all pairs: no contact force acts beyond it.
  double reach_m() const { return reach_m_; }
  /// d̂ of the bodies of a contact pair.
  double reach_m(const ContactMesh& mesh, const ContactPair& pair) const { return laws_[index(mesh, pair)].d_hat_m; }
  /// Largest μ of all pairs; zero: no friction anywhere.
  double largest_friction() const { return largest_friction_; }
  /// μ of a law divided by the largest μ.
  double relative_friction(const ContactLaw& law) const { return all_alike() ? 1.0 : law.friction / largest_friction_; }

 private:
  std::size_t index(int body, int other) const {
    return all_alike() ? 0 : static_cast<std::size_t>(body * num_bodies_ + other);
  }

  std::vector<ContactLaw> laws_;  // the shared law, or one per body × number of bodies + other body
  int num_bodies_ = 1;
  double reach_m_, largest_friction_;
};

}  // namespace tacipc
