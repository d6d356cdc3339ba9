// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

namespace cca {

/// Solves H x = b where H is symmetric, positive definite, and sparse in blocks of 3 x 3: those of
/// a pose graph. A block at a time is several times as fast as a number at a time [Davis 2006, ch.
/// 4].
class BlockCholesky {
 public:
  /// @param rows   of H, in blocks.
  /// @param pairs  (i, j), i != j: the blocks beside the diagonal that may not be zero, each pair
  ///               once; in any order.
  /// Cost: that of an approximate minimum degree ordering.
  BlockCholesky(int rows, const std::vector<std::pair<int, int>>& pairs);

  void setZero();
  /// H(i, i)
  Eigen::Matrix3d& diagonal(int i) {
    return diagonal_[static_cast<std::size_t>(place_[static_cast<std::size_t>(i)])];
  }
  /// Where the block (i, j) is kept, or its transpose; (i, j) one of the pairs or its reverse.
  struct Slot {
    std::size_t column = 0, at = 0;
    bool is_transposed = false;
  };
  Slot slotOf(int i, int j) const;
  /// H(i, j) += block, and H(j, i) its transpose.
  void add(const Slot& slot, const Eigen::Matrix3d& block);

  /// Factorises, whereafter H is lost. @return whether H was positive definite.
  bool factorise();
  /// b becomes x. To be called after factorise().
  void solve(std::vector<Eigen::Vector3d>& b) const;

 private:
  struct Column {
    std::vector<int> rows;  ///< below the diagonal, ascending
    std::vector<Eigen::Matrix3d> blocks;
  };
  std::vector<int> place_;  ///< of each row in the order of elimination
  std::vector<Eigen::Matrix3d> diagonal_;
  std::vector<Column> columns_;
};

}  // namespace cca
