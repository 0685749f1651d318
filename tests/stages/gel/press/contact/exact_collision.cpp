#include "tests/stages/gel/press/contact/exact_collision.h"

#include <gmpxx.h>

#include <algorithm>
#include <vector>

namespace tacipc {
namespace {

/// Σ cₖ tᵏ (1 − t)ⁿ⁻ᵏ with integer coefficients: products are convolutions, equal signs of all cₖ fix the sign on (0,
/// 1).
using Polynomial = std::vector<mpz_class>;

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  return product;
}

Polynomial operator+(Polynomial a, const Polynomial& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

Polynomial operator-(Polynomial a, const Polynomial& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

/// The part on [0, ½], rescaled to [0, 1] and times 2ⁿ: t = s/2, 1 − t = ((1 − s)·2 + s)/2.
Polynomial first_half(const Polynomial& p) {
  const std::size_t n = p.size() - 1;
  Polynomial half(p.size());
  for (std::size_t k = 0; k <= n; ++k) {
    mpz_class binomial = 1;
    for (std::size_t j = 0; j + k <= n; ++j) {
      half[k + j] += (p[k] * binomial) << (n - k - j);
      binomial = binomial * static_cast<unsigned long>(n - k - j) / static_cast<unsigned long>(j + 1);
    }
  }
  return half;
}

Polynomial second_half(Polynomial p) {
  std::reverse(p.begin(), p.end());
  p = first_half(p);
  std::reverse(p.begin(), p.end());
  return p;
}

bool positive(const Polynomial& p) {
  return std::all_of(p.begin(), p.end(), [](const mpz_class& c) { return c > 0; });
}
bool negative(const Polynomial& p) {
  return std::all_of(p.begin(), p.end(), [](const mpz_class& c) { return c < 0; });
}

using Vector = std::array<Polynomial, 3>;
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Polynomial dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A collision is a zero of the volume at which no condition is negative.
struct Query {
  Polynomial volume;
  std::vector<Polynomial> conditions;
};

/// `budget` bounds the work where both halves stay open again and again, as in one plane.
Collision decide(const Query& query, int depth, int& budget) {
  if (positive(query.volume) || negative(query.volume)) return Collision::free;
  if (std::any_of(query.conditions.begin(), query.conditions.end(), negative)) return Collision::free;
  const bool crosses = sgn(query.volume.front()) * sgn(query.volume.back()) < 0;
  if (crosses && std::all_of(query.conditions.begin(), query.conditions.end(), positive)) return Collision::hit;
  if (depth == 0 || --budget < 0) return Collision::undecided;
  Query first{first_half(query.volume), {}}, second{second_half(query.volume), {}};
  for (const Polynomial& condition : query.conditions) {
    first.conditions.push_back(first_half(condition));
    second.conditions.push_back(second_half(condition));
  }
  const Collision one = decide(first, depth - 1, budget);
  if (one == Collision::hit) return one;
  const Collision other = decide(second, depth - 1, budget);
  if (other == Collision::hit) return other;
  return one == Collision::free ? other : one;
}

}  // namespace

Collision exact_collision(ContactPair::Kind kind, const FourPoints& x_start, const FourPoints& displacement,
                          double until) {
  std::array<std::array<std::array<mpq_class, 2>, 3>, 4> ends;
  mpz_class unit = 1;  // that all coordinates are multiples of one over: doubles have powers of two only
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < 3; ++c) {
      const mpq_class from(x_start[i][c]);
      ends[i][c] = {from, from + mpq_class(until) * mpq_class(displacement[i][c])};
      for (const mpq_class& end : ends[i][c]) unit = std::max<mpz_class>(unit, end.get_den());
    }
  }
  std::array<Vector, 4> x;
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) x[i][c] = {mpz_class(ends[i][c][0] * unit), mpz_class(ends[i][c][1] * unit)};
  Query query;
  if (kind == ContactPair::Kind::point_triangle) {
    const Vector w = x[0] - x[1], e1 = x[2] - x[1], e2 = x[3] - x[1];
    const Vector normal = cross(e1, e2);
    const Polynomial b1 = dot(cross(w, e2), normal), b2 = dot(cross(e1, w), normal);
    query = {dot(w, normal), {b1, b2, dot(normal, normal) - b1 - b2}};
  } else {
    const Vector w = x[2] - x[0], a = x[1] - x[0], b = x[3] - x[2];
    const Vector normal = cross(a, b);
    const Polynomial s = dot(cross(w, b), normal), t = dot(cross(w, a), normal), one = dot(normal, normal);
    query = {dot(w, normal), {s, one - s, t, one - t}};
  }
  constexpr int kDepth = 48;
  int budget = 400;
  const auto zero = [](const mpz_class& c) { return c == 0; };
  if (std::all_of(query.volume.begin(), query.volume.end(), zero)) return Collision::undecided;
  return decide(query, kDepth, budget);
}

}  // namespace tacipc
