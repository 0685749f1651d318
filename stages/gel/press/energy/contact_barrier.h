// Barrier energy of contact pairs between gel and object, and within the gel.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "stages/gel/press/contact/contact_laws.h"
#include "stages/gel/press/energy/contact_term.h"

namespace tacipc {

/// Energy B(x) = Σ_k c_k m_k(x) b(s_k(x), ŝ_k), m⁴ [Eq. 5; Li et al. 2020]. For pair k, c_k is its weight
/// (pair_counting.h), s_k its squared distance, b the function of barrier.h, and m_k the mollifier of nearly parallel
/// edges (1 for point–triangle pairs). ŝ_k = d̂², with d̂ from the law of the two bodies. Within one gel, ŝ_k is at
/// most a quarter of the squared distance at rest: neighbours on the undeformed gel must not push each other, however
/// fine the mesh is.
class ContactBarrier final : public ContactTerm {
 public:
  /// \pre the mesh outlives the term and keeps its address
  ContactBarrier(const ContactMesh& mesh, std::vector<ContactPair> pairs, ContactLaws laws);

  int num_stencils() const override { return static_cast<int>(pairs_.size()); }
  std::span<const int> stencil(int i) const override { return pairs_[i].vertices; }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override;

  std::vector<int> active(const Positions& x) const override;
  double value_of(const std::vector<int>& active, const Positions& x) const override;
  bool evaluate_gradient(int i, const FourPoints& x, Vector12& out) const override;
  bool evaluate_blended(int i, const FourPoints& x, double blend, PairVertices wanted, PairLocal& out) const override;
  void evaluate_pack(const StencilPack& which, int count, const Positions& x, const Pack& blend, WantedVertices wanted,
                     PackedBlocks& out) const override;

  const std::vector<ContactPair>& pairs() const { return pairs_; }
  /// Whether pair i is between gels, or within one.
  bool of_gel_alone(int i) const;
  /// Whether pair i is between two objects.
  bool of_objects_alone(int i) const;
  /// Law of the two bodies of pair i.
  const ContactLaw& law(int i) const { return laws_.all()[law_of_.empty() ? 0 : law_of_[static_cast<std::size_t>(i)]]; }
  const ContactLaws& laws() const { return laws_; }

  /// Contact force of one pair: its closest feature and 2 d c m |b′(d²)|, m³, zero beyond d̂. Multiplied by κ, it is
  /// the force between the two sides along the line that joins their closest points; negative if the weight c is.
  struct Push {
    ClosestFeature feature;
    double force;
  };
  /// Contact force of pair i with its vertices at `points`.
  Push push(int i, const FourPoints& points) const;

 private:
  /// ŝ of a pair, and the threshold of its mollifier (zero: never mollified). Both follow from the shape at rest; they
  /// are computed only for pairs that are near, because most never are.
  double s_hat_of(int i) const;
  double mollifier_threshold(int i) const;
  double value_of(int i, const FourPoints& points) const;
  bool mollified(int i, const FourPoints& x) const;

  /// Whether the packed evaluation supports pair i: d̂ of its law is the largest of all, and it is no piece of a flat
  /// face.
  bool fits_packs(int i) const {
    return law(i).d_hat_m == laws_.reach_m() && pairs_[static_cast<std::size_t>(i)].shape == 0;
  }

  const ContactMesh* mesh_;
  std::vector<ContactPair> pairs_;
  ContactLaws laws_;
  std::vector<std::uint16_t> law_of_;  // index of each pair's law; empty if there is one law for all
  double s_hat_;                       // square of the largest d̂: the largest ŝ of all pairs
};

}  // namespace tacipc
