// An order of a matrix's rows in which triangular sweeps can go in several places at the same time.
#pragma once

#include <vector>

#include "stages/gel/press/solve/block_matrix.h"

namespace tacipc {

/// Rows in parts of which no two share a block, one after the other, and last a separator: rows that share blocks with
/// several parts. A sweep over the lower triangle goes through all parts at once and through the separator after them
/// (before them, if upwards). Parts are runs of the given order: where neighbours have neighbouring numbers few rows
/// are in the separator. Bodies are coupled to all that touches them: where the pattern has any, their rows end the
/// separator, in the order given.
struct SweepOrder {
  std::vector<int> part_start;  // first row of each part, of the separator, and the number of rows
  std::vector<int> row_of;      // row in this order of each row of the matrix

  /// Blocks below the diagonal in this order, column by column, rows ascending.
  std::vector<int> column_start, row;
  std::vector<int> separator_start;  // of each column: its first block whose row is in the separator
  std::vector<int> source;           // the matrix's block: its index, or −1 − its index where it lies transposed

  int num_parts() const { return static_cast<int>(part_start.size()) - 2; }
  int num_rows() const { return part_start.back(); }
  int separator() const { return part_start[part_start.size() - 2]; }
};

SweepOrder make_sweep_order(const BlockPattern& pattern, int num_parts);

}  // namespace tacipc
