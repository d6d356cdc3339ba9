// SPDX-License-Identifier: BSD-3-Clause
#include "../../src/slam/block_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

namespace cca {
namespace {

/// A drive of `rows` poses that comes by the same places again, as blocks and as one matrix.
struct System {
  explicit System(int rows) : all(Eigen::MatrixXd::Zero(3 * rows, 3 * rows)) {
    for (int i = 0; i < rows; ++i) {
      if (i + 1 < rows) pairs.emplace_back(i, i + 1);
      if (i + 3 < rows) pairs.emplace_back(i + 3, i);
      if (i % 7 == 0 && i + 11 < rows) pairs.emplace_back(i, i + 11);
    }
  }

  void fill(BlockCholesky& blocks, double on_diagonal) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int i = 0; 3 * i < all.rows(); ++i) {
      blocks.diagonal(i) = on_diagonal * Eigen::Matrix3d::Identity();
      all.block<3, 3>(3 * i, 3 * i) = blocks.diagonal(i);
    }
    for (const auto& [i, j] : pairs) {
      const Eigen::Matrix3d block = Eigen::Matrix3d::NullaryExpr([&] { return number(random); });
      blocks.add(blocks.slotOf(i, j), block);
      all.block<3, 3>(3 * i, 3 * j) = block;
      all.block<3, 3>(3 * j, 3 * i) = block.transpose();
    }
  }

  std::vector<std::pair<int, int>> pairs;
  Eigen::MatrixXd all;
};

TEST(BlockCholesky, SolvesWhatADenseFactorisationSolves) {
  constexpr int kRows = 40;
  System system(kRows);
  BlockCholesky blocks(kRows, system.pairs);
  system.fill(blocks, 20.0);
  ASSERT_TRUE(blocks.factorise());
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(3 * kRows, -1.0, 1.0);
  std::vector<Eigen::Vector3d> x;
  for (int i = 0; i < kRows; ++i) x.emplace_back(b.segment<3>(3 * i));
  blocks.solve(x);
  const Eigen::VectorXd expected = system.all.ldlt().solve(b);
  for (int i = 0; i < kRows; ++i) {
    EXPECT_LT((x[static_cast<std::size_t>(i)] - expected.segment<3>(3 * i)).norm(), 1e-12);
  }
}

TEST(BlockCholesky, AMatrixThatIsNotPositiveDefiniteIsRefused) {
  constexpr int kRows = 10;
  System system(kRows);
  BlockCholesky blocks(kRows, system.pairs);
  system.fill(blocks, 0.1);
  EXPECT_FALSE(blocks.factorise());
}

TEST(BlockCholesky, ARowWithoutNeighboursIsSolvedAlone) {
  BlockCholesky blocks(1, {});
  blocks.diagonal(0) = 2.0 * Eigen::Matrix3d::Identity();
  ASSERT_TRUE(blocks.factorise());
  std::vector<Eigen::Vector3d> x{{2.0, 4.0, 6.0}};
  blocks.solve(x);
  EXPECT_LT((x.front() - Eigen::Vector3d(1.0, 2.0, 3.0)).norm(), 1e-12);
}

}  // namespace
}  // namespace cca
