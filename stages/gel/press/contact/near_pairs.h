// Filters candidate pairs by distance, several at a time.
#pragma once

#include <span>
#include <vector>

#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Squared distances of all pairs at `x`, m². They exceed the true values by at most 1e-6 of them, and are zero if
/// edges are too parallel to decide. Use them to exclude pairs, not to compute energies.
std::vector<double> coarse_squared_distances(std::span<const ContactPair> pairs, const Positions& x);

/// Indices, ascending, of all pairs with squared distance below s_hat, or a few more.
std::vector<int> near_pairs(std::span<const ContactPair> pairs, const Positions& x, double s_hat);

/// Smallest distance over the pairs, m, capped at `none`.
double smallest_distance(std::span<const ContactPair> pairs, const Positions& x, double none);

}  // namespace tacipc
