// SPDX-License-Identifier: BSD-3-Clause
#include "slam/block_cholesky.hpp"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstddef>

namespace cca {

BlockCholesky::BlockCholesky(int rows, const std::vector<std::pair<int, int>>& pairs)
    : diagonal_(static_cast<std::size_t>(rows)), columns_(static_cast<std::size_t>(rows)) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < rows; ++i) entries.emplace_back(i, i, 1.0);
  for (const auto& [i, j] : pairs) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  Eigen::SparseMatrix<double> pattern(rows, rows);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  place_.resize(static_cast<std::size_t>(rows));
  for (int k = 0; k < rows; ++k) place_[static_cast<std::size_t>(order.indices()(k))] = k;

  for (const auto& [i, j] : pairs) {
    const int a = place_[static_cast<std::size_t>(i)], b = place_[static_cast<std::size_t>(j)];
    columns_[static_cast<std::size_t>(std::min(a, b))].rows.push_back(std::max(a, b));
  }
  // What a column fills is what the first row below its diagonal fills, too.
  for (Column& column : columns_) {
    std::vector<int>& below = column.rows;
    std::sort(below.begin(), below.end());
    below.erase(std::unique(below.begin(), below.end()), below.end());
    column.blocks.resize(below.size());
    if (below.empty()) continue;
    std::vector<int>& parent = columns_[static_cast<std::size_t>(below.front())].rows;
    parent.insert(parent.end(), below.begin() + 1, below.end());
  }
  setZero();
}

void BlockCholesky::setZero() {
  for (Eigen::Matrix3d& block : diagonal_) block.setZero();
  for (Column& column : columns_) {
    for (Eigen::Matrix3d& block : column.blocks) block.setZero();
  }
}

BlockCholesky::Slot BlockCholesky::slotOf(int i, int j) const {
  const int a = place_[static_cast<std::size_t>(i)], b = place_[static_cast<std::size_t>(j)];
  const auto number = static_cast<std::size_t>(std::min(a, b));
  const Column& column = columns_[number];
  const auto at = std::lower_bound(column.rows.begin(), column.rows.end(), std::max(a, b));
  return {number, static_cast<std::size_t>(at - column.rows.begin()), a < b};
}

void BlockCholesky::add(const Slot& slot, const Eigen::Matrix3d& block) {
  Eigen::Matrix3d& sum = columns_[slot.column].blocks[slot.at];
  if (slot.is_transposed) {
    sum += block.transpose();
  } else {
    sum += block;
  }
}

bool BlockCholesky::factorise() {
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const Eigen::LLT<Eigen::Matrix3d> root(diagonal_[j]);
    if (root.info() != Eigen::Success) return false;
    diagonal_[j] = root.matrixL();
    const Eigen::Matrix3d inverse =
        diagonal_[j].triangularView<Eigen::Lower>().solve(Eigen::Matrix3d::Identity());
    Column& column = columns_[j];
    for (Eigen::Matrix3d& block : column.blocks) block = (block * inverse.transpose()).eval();
    for (std::size_t k = 0; k < column.rows.size(); ++k) {
      const auto row = static_cast<std::size_t>(column.rows[k]);
      const Eigen::Matrix3d turned = column.blocks[k].transpose();
      diagonal_[row].noalias() -= column.blocks[k] * turned;
      Column& other = columns_[row];
      std::size_t to = 0;
      for (std::size_t i = k + 1; i < column.rows.size(); ++i) {
        while (other.rows[to] != column.rows[i]) ++to;
        other.blocks[to].noalias() -= column.blocks[i] * turned;
      }
    }
  }
  return true;
}

void BlockCholesky::solve(std::vector<Eigen::Vector3d>& b) const {
  std::vector<Eigen::Vector3d> x(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) x[static_cast<std::size_t>(place_[i])] = b[i];
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    diagonal_[j].triangularView<Eigen::Lower>().solveInPlace(x[j]);
    const Column& column = columns_[j];
    for (std::size_t k = 0; k < column.rows.size(); ++k) {
      x[static_cast<std::size_t>(column.rows[k])] -= column.blocks[k] * x[j];
    }
  }
  for (std::size_t j = columns_.size(); j-- > 0;) {
    const Column& column = columns_[j];
    for (std::size_t k = 0; k < column.rows.size(); ++k) {
      x[j] -= column.blocks[k].transpose() * x[static_cast<std::size_t>(column.rows[k])];
    }
    diagonal_[j].transpose().triangularView<Eigen::Upper>().solveInPlace(x[j]);
  }
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = x[static_cast<std::size_t>(place_[i])];
}

}  // namespace cca
