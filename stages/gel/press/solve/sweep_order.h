// Order of a matrix's rows in which triangular sweeps run in parallel.
#pragma once

#include <vector>

#include "stages/gel/press/solve/block_matrix.h"

namespace tacipc {

/// Rows ordered as parts that share no block with each other, followed by a separator: rows that share blocks with
/// several parts. A sweep over the lower triangle handles all parts at once and the separator after them (before them
/// in an upward sweep). Parts are runs of the given order: if neighbours in space have similar numbers, few rows are in
/// the separator. Bodies are coupled to everything that touches them: their rows end the separator, in the given order.
struct SweepOrder {
  std::vector<int> part_start;  // first row of each part, first row of the separator, number of rows
  std::vector<int> row_of;      // row in this order of each row of the matrix

  /// Blocks below the diagonal in this order, column by column, rows ascending.
  std::vector<int> column_start, row;
  std::vector<int> separator_start;  // per column: its first block whose row is in the separator
  std::vector<int> source;           // block of the matrix: its index, or −1 − its index if it is stored transposed

  int num_parts() const { return static_cast<int>(part_start.size()) - 2; }
  int num_rows() const { return part_start.back(); }
  int separator() const { return part_start[part_start.size() - 2]; }
};

/// Orders the rows of a pattern in this number of parts and a separator.
SweepOrder make_sweep_order(const BlockPattern& pattern, int num_parts);

}  // namespace tacipc
