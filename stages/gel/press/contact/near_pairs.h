// Which of many candidate pairs are near, several at a time.
#pragma once

#include <span>
#include <vector>

#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Squared distances of all pairs at `x`, m², to within 1e-6 of themselves from above, and zero where edges are too
/// parallel to tell: good for ruling pairs out, not for computing with.
std::vector<double> coarse_squared_distances(std::span<const ContactPair> pairs, const Positions& x);

/// Indices, ascending, of all pairs with squared distance below s_hat, and perhaps of a few more.
std::vector<int> near_pairs(std::span<const ContactPair> pairs, const Positions& x, double s_hat);

/// Smallest distance over the pairs, at most `none`, m.
double smallest_distance(std::span<const ContactPair> pairs, const Positions& x, double none);

}  // namespace tacipc
