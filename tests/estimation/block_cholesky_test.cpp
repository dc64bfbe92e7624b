#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "estimation/block_cholesky_internal.h"

namespace rex::internal {
namespace {

struct RandomGraph {
  int nodes = 0;
  std::vector<std::pair<int, int>> edges;
};

// A chain, closed at random; with a repeated edge, and one that joins a node with itself.
RandomGraph randomGraph(int nodes, int loops, Rng& rng) {
  RandomGraph graph{nodes, {}};
  for (int i = 1; i < nodes; ++i) graph.edges.emplace_back(i - 1, i);
  const auto any = [&] { return static_cast<int>(rng.uniform(0, nodes)); };
  for (int k = 0; k < loops; ++k) graph.edges.emplace_back(any(), any());
  graph.edges.push_back(graph.edges.front());
  graph.edges.emplace_back(0, 0);
  return graph;
}

// The same matrix twice, by blocks and dense: positive definite, unless `excess` is negative.
template <int N>
struct Pair {
  Pair(const RandomGraph& graph, double excess, Rng& rng)
      : blocks(std::make_shared<const BlockPattern>(graph.nodes, graph.edges)),
        dense(Eigen::MatrixXd::Zero(N * graph.nodes, N * graph.nodes)) {
    using Block = Eigen::Matrix<double, N, N>;
    for (const auto& [a, b] : graph.edges) {
      if (a == b) continue;
      const Block block = rng.normalVector(N * N).reshaped(N, N);
      blocks.add(a, b, block);
      dense.block<N, N>(N * a, N * b) += block;
      dense.block<N, N>(N * b, N * a) += block.transpose();
    }
    const Eigen::VectorXd sums = dense.cwiseAbs().rowwise().sum();
    for (int i = 0; i < graph.nodes; ++i) {
      const Block block = (sums.segment<N>(N * i).array() + excess).matrix().asDiagonal();
      blocks.diagonal(i) += block;
      dense.block<N, N>(N * i, N * i) += block;
    }
  }
  BlockCholesky<N> blocks;
  Eigen::MatrixXd dense;
};

template <int N>
void expectDenseResults() {
  Rng rng(N);
  for (const int nodes : {1, 2, 7, 40}) {
    Pair<N> pair(randomGraph(nodes, nodes, rng), 0.1, rng);
    const Eigen::MatrixXd rhs = rng.normalVector(N * nodes * 2).reshaped(N * nodes, 2);
    EXPECT_LT((pair.blocks.times(rhs) - pair.dense * rhs).norm(), 1e-12 * (pair.dense * rhs).norm());
    for (const double shift : {0., 0.3}) {
      ASSERT_TRUE(pair.blocks.factorize(shift));
      const Eigen::MatrixXd shifted = pair.dense + shift * Eigen::MatrixXd::Identity(N * nodes, N * nodes);
      const Eigen::MatrixXd x = Eigen::LLT<Eigen::MatrixXd>(shifted).solve(rhs);
      EXPECT_LT((pair.blocks.solve(rhs) - x).norm(), 1e-9 * x.norm()) << nodes << " nodes";
    }
  }
}

TEST(BlockCholesky, SolvesAsADenseOneDoes) {
  expectDenseResults<1>();
  expectDenseResults<2>();
  expectDenseResults<3>();
  expectDenseResults<6>();
}

TEST(BlockCholesky, SeesWhatIsNotPositiveDefinite) {
  Rng rng(5);
  Pair<3> pair(randomGraph(20, 15, rng), 0.1, rng);
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(pair.dense).eigenvalues()[0];
  EXPECT_TRUE(pair.blocks.factorize(-least + 1e-6));
  EXPECT_FALSE(pair.blocks.factorize(-least - 1e-6));
  pair.blocks.setZero();
  EXPECT_FALSE(pair.blocks.factorize(0));
}

// The pattern of a dense factor of the matrix, with the nodes in the order of elimination.
TEST(BlockPattern, HasTheBlocksThatADenseFactorFills) {
  Rng rng(6);
  const RandomGraph graph = randomGraph(30, 20, rng);
  const BlockPattern pattern(graph.nodes, graph.edges);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(30, 30);
  for (const auto& [a, b] : graph.edges) {
    if (a == b) continue;
    const int i = pattern.column(a), j = pattern.column(b);
    A(i, j) = A(j, i) = A(i, j) + rng.uniform(1, 2);
  }
  A.diagonal() = A.rowwise().sum().array() + 1;
  const Eigen::MatrixXd L = Eigen::LLT<Eigen::MatrixXd>(A).matrixL();
  Eigen::MatrixXi expected = (L.array().abs() > 1e-300).cast<int>(), found = Eigen::MatrixXi::Zero(30, 30);
  for (int c = 0; c < 30; ++c)
    for (int block = pattern.start(c); block < pattern.start(c + 1); ++block)
      found(pattern.row(block), c) = 1;
  EXPECT_EQ(found, expected);
  EXPECT_LT(pattern.size(), 30 * 31 / 4) << "an order that fills few";
}

}  // namespace
}  // namespace rex::internal
