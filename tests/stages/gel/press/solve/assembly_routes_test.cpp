// Fast assembly of Newton's system against plain assembly, stencil by stencil.
#include <gtest/gtest.h>

#include <random>

#include "common/mesh/spatial_order.h"
#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/energy/friction.h"
#include "stages/gel/press/energy/restricted_term.h"
#include "stages/gel/press/energy/viscous_memory.h"
#include "stages/gel/press/solve/contact_assembly.h"
#include "stages/gel/press/solve/elastic_assembly.h"
#include "stages/gel/press/solve/local_patch.h"
#include "stages/gel/press/solve/volume_assembly.h"
#include "tests/stages/gel/press/elastic_block.h"
#include "tests/stages/gel/press/solve/block_matrices.h"

namespace tacipc {
namespace assembly_routes_test {

/// Largest difference over the largest entry.
double difference(const NewtonSystem& a, const NewtonSystem& b) {
  double most = 0.0, size = 0.0;
  const auto compare = [&](const auto& x, const auto& y) {
    if (x.size() == 0) return;
    most = std::max(most, (x - y).cwiseAbs().maxCoeff());
    size = std::max(size, y.cwiseAbs().maxCoeff());
  };
  const auto flat = [](const auto& v) {
    return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  compare(flat(a.hessian.values), flat(b.hessian.values));
  compare(a.gradient, b.gradient);
  compare(a.coupling, b.coupling);
  compare(a.object_border, b.object_border);
  compare(a.object_hessian, b.object_hessian);
  compare(a.object_gradient, b.object_gradient);
  compare(a.object_coupling, b.object_coupling);
  return most / size;
}

/// A block turned, stretched and crumpled, its lowest vertices prescribed, the free ones numbered along a curve.
struct Crumpled {
  Block block = make_block({1, 1, 0.5}, {3, 2, 1}, 0.2);  // 36 tetrahedra: the last pack is not full
  Positions x = block.rest;
  std::vector<bool> fixed;
  Crumpled() : fixed(static_cast<std::size_t>(x.rows()), false) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-0.06, 0.06);
    const Matrix3 turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      Vector3 at = block.rest.row(v);
      for (double& c : at) c += uniform(random);
      x.row(v) = turn * at.cwiseProduct(Vector3(1.2, 0.8, 1.0));
      fixed[v] = block.rest(v, 2) == 0.0;
    }
  }
  FreeVertices free() const { return {spatial_order(block.rest), fixed}; }
};

TEST(ElasticPacks, EnergyAndSystemAreThoseOfTheElement) {
  const Crumpled c;
  const auto term = std::make_shared<Elasticity>(c.block.rest, c.block.tets, NeoHookean{2.0, 7.0});
  ASSERT_TRUE(term->packs());
  const double value = term->EnergyTerm::value(c.x);
  EXPECT_NEAR(term->value(c.x), value, 1e-13 * value);
  EXPECT_EQ(term->value(c.block.rest), 0.0 * value);

  const FreeVertices free = c.free();
  const auto pattern = mesh_pattern(free, *term);
  const int none = static_cast<int>(c.x.rows());
  NewtonSystem plain;
  clear(plain, free, pattern);
  NewtonSystem packed = plain;
  assemble({3.0, term}, c.x, free, none, Order::hessian, Positions::Zero(c.x.rows(), 3), plain);
  ElasticAssembly assembly(*term->packs(), free);
  assembly.add(c.x, {}, 3.0, packed);
  EXPECT_LT(difference(packed, plain), 1e-13);
  assembly.add(c.x, {}, -3.0, packed);  // the second time without looking places up
  EXPECT_LT(packed.gradient.norm(), 1e-12 * plain.gradient.norm());
}

TEST(VolumeAssembly, EnergyAndSystemAreThoseOfTheClusters) {
  const Crumpled c;
  const auto term = std::make_shared<AveragedElasticity>(c.block.rest, c.block.tets, NeoHookean{2.0, 7.0},
                                                         make_tet_clusters(c.block.tets, 5));
  ASSERT_TRUE(term->packs());
  ASSERT_GT(term->num_stencils(), 3);
  const double value = term->EnergyTerm::value(c.x);
  EXPECT_NEAR(term->value(c.x), value, 1e-13 * value);
  Positions turned = c.x;
  turned.row(c.block.tets(7, 0)) += Eigen::RowVector3d(3, 3, 3);
  EXPECT_EQ(term->value(turned), std::numeric_limits<double>::infinity());

  const FreeVertices free = c.free();
  const auto pattern = mesh_pattern(free, *term);
  const int none = static_cast<int>(c.x.rows());
  NewtonSystem plain;
  clear(plain, free, pattern);
  NewtonSystem packed = plain;
  assemble({3.0, term}, c.x, free, none, Order::hessian, Positions::Zero(c.x.rows(), 3), plain);
  ElasticAssembly tetrahedra(*term->packs(), free);
  VolumeAssembly clusters(*term, free);
  const auto add = [&](double weight) {
    const auto volume = term->volume_derivatives(c.x);
    tetrahedra.add(c.x, volume.pressure, weight, packed);
    clusters.add(volume.second, c.x, weight, packed);
  };
  add(3.0);
  EXPECT_LT(difference(packed, plain), 1e-13);
  add(-3.0);  // the second time without looking places up
  EXPECT_LT(packed.gradient.norm(), 1e-12 * plain.gradient.norm());
}

/// A system with the elasticity of the crumpled block, brought from one place to another.
struct Updated {
  Crumpled crumpled;
  FreeVertices free = crumpled.free();
  std::shared_ptr<AveragedElasticity> term = std::make_shared<AveragedElasticity>(
      crumpled.block.rest, crumpled.block.tets, NeoHookean{2.0, 7.0}, make_tet_clusters(crumpled.block.tets, 5));
  ElasticAssembly tetrahedra{*term->packs(), free};
  VolumeAssembly clusters{*term, free};
  NewtonSystem system;
  std::vector<char> changed = std::vector<char>(static_cast<std::size_t>(free.size()), 0);  // by update()

  Updated() { clear(system, free, mesh_pattern(free, *term)); }
  void add(const Positions& x) {
    const auto volume = term->volume_derivatives(x);
    tetrahedra.add(x, volume.pressure, 3.0, system);
    clusters.add(volume.second, x, 3.0, system);
  }
  void update(const Positions& x, double tolerance) {
    clear_gradient(system, free);
    const auto volume = term->volume_derivatives(x);
    std::fill(changed.begin(), changed.end(), 0);
    tetrahedra.update(x, volume.pressure, tolerance, system, changed);
    clusters.update(volume.second, x, tetrahedra, system, changed);
  }
  /// Its free vertices moved by up to `far`, those of the first `last` alone.
  Positions moved(double far, int last) const {
    Positions x = crumpled.x;
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(-far, far);
    for (int i = 0; i < std::min(last, free.size()); ++i) {
      for (int c = 0; c < 3; ++c) x(free.vertex_of_free[static_cast<std::size_t>(i)], c) += uniform(random);
    }
    return x;
  }
};

TEST(UpdatedAssembly, WithoutToleranceIsThatOfTheNewPlace) {
  Updated kept, anew;
  kept.add(kept.crumpled.x);
  for (const double far : {0.03, 0.01, 0.0}) {
    kept.update(kept.moved(far, 1000), 0.0);
    clear(anew.system, anew.free, anew.system.hessian.pattern);
    anew.add(kept.moved(far, 1000));
    EXPECT_LT(difference(kept.system, anew.system), 1e-12) << far;
  }
}

TEST(UpdatedAssembly, KeepsTheHessianWhereLittleChangesAndNeverTheGradient) {
  Updated kept, anew;
  kept.add(kept.crumpled.x);
  const AlignedVector<double> before = kept.system.hessian.values;
  const Positions near = kept.moved(1e-4, 1000);
  kept.update(near, 0.05);
  anew.add(near);
  EXPECT_EQ(kept.system.hessian.values, before);
  EXPECT_EQ(std::count(kept.changed.begin(), kept.changed.end(), 1), 0);
  EXPECT_LT((kept.system.gradient - anew.system.gradient).norm(), 1e-13 * anew.system.gradient.norm());
}

TEST(UpdatedAssembly, RenewsTheHessianWhereMuchChangesAndSoItsErrorStaysSmall) {
  Updated kept, anew;
  kept.add(kept.crumpled.x);
  const AlignedVector<double> before = kept.system.hessian.values;
  // Far enough for some of the elements: those at one end of the numbering.
  const Positions x = kept.moved(0.05, 4);
  kept.update(x, 0.05);
  int renewed = 0;
  for (int p = 0; p < kept.term->packs()->size(); ++p) renewed += kept.tetrahedra.changed(p);
  EXPECT_GT(renewed, 0);
  EXPECT_NE(kept.system.hessian.values, before);
  const BlockPattern& pattern = *kept.system.hessian.pattern;
  for (int c = 0; c < pattern.size(); ++c) {
    for (int k = pattern.column_start[c]; k < pattern.column_start[c + 1]; ++k) {
      const auto first = before.begin() + static_cast<std::ptrdiff_t>(BlockMatrix::kStride) * k;
      const bool same = std::equal(first, first + BlockMatrix::kStride,
                                   kept.system.hessian.values.begin() + (first - before.begin()));
      EXPECT_TRUE(same || (kept.changed[c] && kept.changed[pattern.row[k]])) << pattern.row[k] << " " << c;
    }
  }
  anew.add(x);
  const Eigen::Map<const Eigen::VectorXd> is(kept.system.hessian.values.data(),
                                             static_cast<Eigen::Index>(before.size()));
  const Eigen::Map<const Eigen::VectorXd> should(anew.system.hessian.values.data(), is.size());
  EXPECT_LT((is - should).norm(), 0.05 * should.norm());
  // Step by step the changes add up, and are noticed.
  for (int k = 1; k <= 50; ++k) kept.update(kept.crumpled.x + (1.0 - 0.02 * k) * (x - kept.crumpled.x), 0.05);
  Updated start;
  start.add(start.crumpled.x);
  const Eigen::Map<const Eigen::VectorXd> back(start.system.hessian.values.data(), is.size());
  EXPECT_LT((is - back).norm(), 0.05 * back.norm());
}

TEST(ElasticPacks, ATurnedElementIsNotAllowed) {
  Crumpled c;
  const Elasticity term(c.block.rest, c.block.tets, NeoHookean{2.0, 7.0});
  c.x.row(c.block.tets(7, 0)) += Eigen::RowVector3d(3, 3, 3);
  EXPECT_EQ(term.value(c.x), std::numeric_limits<double>::infinity());
}

TEST(LocalPatch, ItsTermsChangeAsTheWholeDoes) {
  const Crumpled c;
  for (const auto& [law, element] : {std::pair(ElasticLaw(NeoHookean{2.0, 7.0}), Element::linear),
                                     std::pair(ElasticLaw(StvkHencky{2.0, 7.0}), Element::linear),
                                     std::pair(ElasticLaw(NeoHookean{2.0, 7.0}), Element::averaged_volume)}) {
    const std::shared_ptr<const EnergyTerm> whole = make_elasticity(c.block.rest, c.block.tets, law, element);
    const int seed = c.free().vertex_of_free[3];
    const LocalPatch patch = grow_patch({seed}, {.rings = 0}, c.block.tets, {c.block.tets, c.x.rows()}, c.free());
    EXPECT_EQ(patch.free.vertex_of_free, std::vector<int>{seed});
    const auto part = restricted(whole, patch.moves);
    if (element == Element::linear) {
      EXPECT_EQ(part->num_stencils(), patch.tets.rows());
    }
    EXPECT_LE(part->num_stencils(), whole->num_stencils());
    Positions moved = c.x;
    moved.row(seed) += Eigen::RowVector3d(0.01, -0.02, 0.03);
    const double change = whole->value(moved) - whole->value(c.x);
    EXPECT_NEAR(part->value(moved) - part->value(c.x), change, 1e-12 * whole->value(c.x));
    EXPECT_LT((gradient_of(*part, c.x).row(seed) - gradient_of(*whole, c.x).row(seed)).norm(), 1e-12);
  }
}

TEST(LocalPatch, RemembersAsTheWholeDoes) {
  const Crumpled c;
  const TetStress stress = make_tet_stress(c.block.rest, c.block.tets, NeoHookean{2.0, 7.0}, Element::linear);
  const auto whole = std::make_shared<const ViscousMemory>(stress.body(), stress(c.x));
  const int seed = c.free().vertex_of_free[3];
  const LocalPatch patch = grow_patch({seed}, {.rings = 0}, c.block.tets, {c.block.tets, c.x.rows()}, c.free());
  const auto part = restricted(whole, patch.moves), part_of_part = restricted(part, patch.moves);
  EXPECT_EQ(part->num_stencils(), patch.tets.rows());
  for (const auto& term : {part, part_of_part})
    EXPECT_LT((gradient_of(*term, c.x).row(seed) - gradient_of(*whole, c.x).row(seed)).norm(), 1e-12);
}

TEST(LocalPatch, GrowsByTetrahedraAndLeavesWhatIsPrescribed) {
  const Crumpled c;
  const FreeVertices free = c.free();
  const LocalPatch one =
      grow_patch({free.vertex_of_free[0]}, {.rings = 1}, c.block.tets, {c.block.tets, c.x.rows()}, free);
  const LocalPatch all =
      grow_patch({free.vertex_of_free[0]}, {.rings = 9}, c.block.tets, {c.block.tets, c.x.rows()}, free);
  EXPECT_GT(one.free.size(), 1);
  EXPECT_LT(one.free.size(), free.size());
  EXPECT_EQ(all.free.vertex_of_free, free.vertex_of_free);  // in the same order
  EXPECT_EQ(all.tets.rows(), c.block.tets.rows());
}

TEST(LocalPatch, GrowsOnUntilItHasEnoughVertices) {
  const Crumpled c;
  const FreeVertices free = c.free();
  const TetsOfVertices tets_of(c.block.tets, c.x.rows());
  const auto grown = [&](const PatchSize& size) {
    return grow_patch({free.vertex_of_free[0]}, size, c.block.tets, tets_of, free).free.vertex_of_free;
  };
  const std::vector<int> one = grown({.rings = 1}), two = grown({.rings = 2}), three = grown({.rings = 3});
  ASSERT_LT(one.size(), two.size());
  ASSERT_LT(two.size(), three.size());
  const int enough = static_cast<int>(one.size());
  EXPECT_EQ(grown({.rings = 1, .fewest_vertices = enough, .most_rings = 3}), one);
  EXPECT_EQ(grown({.rings = 1, .fewest_vertices = enough + 1, .most_rings = 3}), two);
  EXPECT_EQ(grown({.rings = 1, .fewest_vertices = free.size() + 1, .most_rings = 3}), three);
}

TEST(LocalPatch, HasEveryTetrahedronWithAVertexThatMoves) {
  const Crumpled c;
  const FreeVertices free = c.free();
  const LocalPatch patch =
      grow_patch({free.vertex_of_free[5]}, {.rings = 1}, c.block.tets, {c.block.tets, c.x.rows()}, free);
  std::vector<std::array<int, 4>> expected, found;
  for (Eigen::Index t = 0; t < c.block.tets.rows(); ++t) {
    const Eigen::RowVector4i v = c.block.tets.row(t);
    if (std::any_of(v.begin(), v.end(), [&](int i) { return patch.moves[static_cast<std::size_t>(i)]; }))
      expected.push_back({v[0], v[1], v[2], v[3]});
  }
  for (Eigen::Index t = 0; t < patch.tets.rows(); ++t)
    found.push_back({patch.tets(t, 0), patch.tets(t, 1), patch.tets(t, 2), patch.tets(t, 3)});
  EXPECT_EQ(found, expected);
}

/// Random pairs of a gel of 40 vertices with an object of 40, some weighted, some with edges nearly parallel.
struct Touching {
  static constexpr int kGel = 40, kAll = 80;
  ContactMesh mesh;
  Positions x = Positions::Zero(kAll, 3), motion = Positions::Zero(kAll, 3);
  std::vector<ContactPair> pairs;
  std::shared_ptr<const ContactBarrier> barrier;
  std::shared_ptr<const Friction> friction;
  std::vector<std::array<int, 2>> coupled;

  Touching() {
    std::mt19937 random(23);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    std::uniform_int_distribution<int> of_gel(0, kGel - 1), of_object(kGel, kAll - 1);
    for (double& c : x.reshaped()) c = uniform(random);
    for (double& c : motion.bottomRows(kAll - kGel).reshaped()) c = 0.1 * uniform(random);
    using Kind = ContactPair::Kind;
    for (int i = 0; i < 300; ++i) {
      const auto g = [&] { return of_gel(random); };
      const auto o = [&] { return of_object(random); };
      ContactPair pair = i % 3 == 0   ? ContactPair{Kind::point_triangle, {g(), o(), o(), o()}}
                         : i % 3 == 1 ? ContactPair{Kind::point_triangle, {o(), g(), g(), g()}}
                                      : ContactPair{Kind::edge_edge, {g(), g(), o(), o()}};
      auto sorted = pair.vertices;
      std::sort(sorted.begin(), sorted.end());
      if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) continue;
      pair.weight = i % 5 == 0 ? -1.0 : i % 7 == 0 ? 0.02 : 1.0;
      if (i % 9 == 2)
        pair.weight = 1.0, x.row(pair.vertices[3]) = x.row(pair.vertices[2]) + x.row(pair.vertices[1]) -
                                                     x.row(pair.vertices[0]) + 1e-3 * motion.row(pair.vertices[3]);
      if (pair.kind == Kind::point_triangle && i % 4 == 1) {  // edges and corners as pair_counting.h has them
        pair.vertices[3] = pair.vertices[2];
        if (i % 8 == 1) pair.vertices[2] = pair.vertices[3] = pair.vertices[1];
      }
      pairs.push_back(pair);
      for (const int a : pair.vertices) {
        for (const int b : pair.vertices) {
          if (a < kGel && b < kGel) coupled.push_back({a, b});
        }
      }
    }
    mesh.num_gel_vertices = kGel;
    mesh.num_object_vertices = kAll - kGel;
    mesh.rest_positions = x;
    barrier = std::make_shared<ContactBarrier>(mesh, pairs, ContactLaws({.d_hat_m = 0.4}));
    friction = std::make_shared<Friction>(*barrier, x, x + 0.3 * motion, 0.01);
  }
};

/// The object's vertices and some of the gel's are prescribed.
std::vector<bool> some_fixed() {
  std::vector<bool> fixed(Touching::kAll, false);
  for (int v = 0; v < Touching::kAll; ++v) fixed[v] = v >= Touching::kGel || v % 11 == 0;
  return fixed;
}

std::shared_ptr<const BlockPattern> pattern_of(const Touching& t, const FreeVertices& free) {
  std::vector<std::array<int, 2>> blocks;
  for (const auto& [a, b] : t.coupled) {
    if (free.free_of_vertex[a] >= 0 && free.free_of_vertex[b] >= 0)
      blocks.push_back({free.free_of_vertex[a], free.free_of_vertex[b]});
  }
  return std::make_shared<BlockPattern>(make_block_pattern(free.size(), blocks));
}

class BlendedContact : public testing::TestWithParam<int> {};

TEST_P(BlendedContact, EveryVertexHasItsOwnShare) {
  const int with_shares = GetParam();
  const Touching t;
  const FreeVertices free = all_but(some_fixed());
  const auto pattern = pattern_of(t, free);
  // Where objects touch each other their vertices have shares, too.
  std::vector<double> shares;
  for (int v = 0; v < with_shares; ++v) shares.push_back(v % 3 == 0 ? 0.0 : v % 3 == 1 ? 0.4 : 1.0);
  const Blend blend(shares), uniform(std::vector<double>(static_cast<std::size_t>(with_shares), 0.4));
  for (const std::shared_ptr<const ContactTerm>& term :
       {std::shared_ptr<const ContactTerm>(t.barrier), std::shared_ptr<const ContactTerm>(t.friction)}) {
    for (const bool moves : {false, true}) {
      const Positions motion = moves ? t.motion : Positions::Zero(Touching::kAll, 3);
      const ObjectMotion object{motion, moves, Vector3::Zero()};
      NewtonSystem expected;
      clear(expected, free, pattern);
      NewtonSystem blended = expected, reblended = expected;
      const std::vector<int> active = term->active(t.x);
      for (const int i : active) {
        double share = 0.0;
        for (const int v : term->stencil(i)) share = std::max(share, v < with_shares ? shares[v] : 0.0);
        const auto one = std::make_shared<RestrictedTerm>(term, std::vector<int>{i});
        assemble({2.0 * (1.0 - share), one}, t.x, free, Touching::kGel, Order::hessian, motion, expected);
        assemble({2.0 * share, one}, t.x, free, Touching::kGel, Order::psd, motion, expected);
      }
      assemble_contact(2.0, *term, active, t.x, free, Touching::kGel, blend, object, blended);
      assemble_contact(2.0, *term, active, t.x, free, Touching::kGel, uniform, object, reblended);
      const NewtonSystem before = reblended;
      std::vector<char> changed(static_cast<std::size_t>(free.size()), 0);
      reblend_contact(2.0, *term, active, t.x, free, Touching::kGel, uniform, blend, object, reblended, changed);
      for (int c = 0; c < free.size(); ++c) {
        for (int k = pattern->column_start[c]; k < pattern->column_start[c + 1]; ++k) {
          if (reblended.hessian.block(k) != before.hessian.block(k)) {
            EXPECT_TRUE(changed[c]) << typeid(*term).name() << " moves " << moves;
            EXPECT_TRUE(changed[pattern->row[k]]) << typeid(*term).name() << " moves " << moves;
          }
        }
      }
      EXPECT_GT(std::count(changed.begin(), changed.end(), 1), 0);
      for (NewtonSystem* system : {&blended, &reblended, &expected}) {
        if (moves) continue;
        system->object_gradient.setZero();  // what nobody asks for
        system->object_border.setZero();
        system->object_hessian.setZero();
      }
      EXPECT_LT(difference(blended, expected), 1e-12) << typeid(*term).name() << " moves " << moves;
      EXPECT_LT(difference(reblended, expected), 1e-12) << typeid(*term).name() << " moves " << moves;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheGelAndOfAll, BlendedContact, testing::Values(Touching::kGel, Touching::kAll));

TEST(AssembleContact, IsTheBlendOfExactAndPositive) {
  const Touching t;
  const FreeVertices free = all_but(some_fixed());
  const auto pattern = pattern_of(t, free);
  const Positions still = Positions::Zero(Touching::kAll, 3);
  for (const std::shared_ptr<const ContactTerm>& term :
       {std::shared_ptr<const ContactTerm>(t.barrier), std::shared_ptr<const ContactTerm>(t.friction)}) {
    EXPECT_NEAR(term->value(t.x), term->EnergyTerm::value(t.x), 1e-13 * term->value(t.x));
    const std::vector<int> active = term->active(t.x);
    EXPECT_GT(active.size(), 50u);
    for (const double blend : {0.0, 0.3, 1.0}) {
      for (const int how : {0, 1, 2}) {  // the object stands still, moves anyhow, or is shifted
        const bool moves = how == 1;
        Positions shifted = still;
        shifted.bottomRows(Touching::kAll - Touching::kGel).rowwise() = Eigen::RowVector3d(0.1, -0.2, 0.3);
        const Positions& motion = how == 0 ? still : moves ? t.motion : shifted;
        NewtonSystem exact;
        clear(exact, free, pattern);
        NewtonSystem positive = exact, blended = exact;
        assemble({2.0, term}, t.x, free, Touching::kGel, Order::hessian, motion, exact);
        assemble({2.0, term}, t.x, free, Touching::kGel, Order::psd, motion, positive);
        assemble_contact(2.0, *term, active, t.x, free, Touching::kGel,
                         Blend(std::vector<double>(Touching::kGel, blend)),
                         {motion, moves, how == 2 ? Vector3(shifted.row(Touching::kGel)) : Vector3::Zero()}, blended);
        NewtonSystem expected = exact;
        const auto mix = [&](auto& to, const auto& a, const auto& b) { to = (1.0 - blend) * a + blend * b; };
        for (std::size_t k = 0; k < expected.hessian.values.size(); ++k)
          mix(expected.hessian.values[k], exact.hessian.values[k], positive.hessian.values[k]);
        mix(expected.coupling, exact.coupling, positive.coupling);
        mix(expected.object_border, exact.object_border, positive.object_border);
        mix(expected.object_hessian, exact.object_hessian, positive.object_hessian);
        mix(expected.object_coupling, exact.object_coupling, positive.object_coupling);
        if (!moves) {  // what nobody asks for
          blended.object_gradient.setZero();
          blended.object_border.setZero();
          blended.object_hessian.setZero();
          blended.object_coupling.setZero();
          expected.object_coupling.setZero();
          expected.object_border.setZero();
          expected.object_hessian.setZero();
          expected.object_gradient.setZero();
        }
        EXPECT_LT(difference(blended, expected), 1e-12)
            << typeid(*term).name() << " blend " << blend << " moves " << moves;
      }
    }
  }
}

}  // namespace assembly_routes_test
}  // namespace tacipc
