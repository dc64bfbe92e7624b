#include "learning/mazes.h"

#include <gtest/gtest.h>

#include "learning/dynamic_programming.h"
#include "support/expect_error.h"

namespace rex::mazes_test {

// A value for each cell in the order in which it is read: the highest row first; walls have none.
void expectTable(const GridWorld& world, const Eigen::VectorXd& V, const Eigen::MatrixXd& table,
                 double tolerance) {
  int seen = 0;
  for (int row = 0; row < world.height; ++row)
    for (int column = 0; column < world.width; ++column) {
      const auto s = world.state(column, row);
      if (!s) continue;
      ++seen;
      EXPECT_NEAR(V[*s], table(world.height - 1 - row, column), tolerance) << column << ", " << row;
    }
  EXPECT_EQ(seen, V.size());
}

TEST(Mazes, TMazeHasTheValuesOfTheCourse) {
  const Mdp maze = tMaze();
  Eigen::VectorXd random(7), optimal(7);
  random << .5625, 1, 1.25, 4, 0, 2, 3;
  optimal << 1, 2, 1.5, 4, 0, 2, 3;
  EXPECT_EQ(policyValues(maze, uniformPolicy(maze)).V, random);
  EXPECT_EQ(valueIteration(maze).V, optimal);
  const MdpSolution solution = policyIteration(maze);
  EXPECT_EQ(solution.V, optimal);
  EXPECT_EQ(solution.actions[0], 0);
  EXPECT_EQ(solution.actions[1], 0);
  EXPECT_EQ(solution.actions[2], 1);
}

// Always to the right is a chain of births and deaths: where it is in the long run follows from the balance
// between neighbours, p_i up_i = p_(i+1) down_(i+1), and what it earns per step is the share of the last
// state.
TEST(Mazes, RiverSwimPaysWhatItsBalanceSays) {
  Mdp river = riverSwim();
  const double p[] = {1, 12, 12 * 7., 12 * 49., 12 * 343., 12 * 343 * .875};
  const double gain = p[5] / (p[0] + p[1] + p[2] + p[3] + p[4] + p[5]);
  EXPECT_NEAR(gain, .4286, 1e-4);
  river.discount = 1 - 1e-7;
  const Eigen::VectorXd V = policyValues(river, deterministicPolicy(river, std::vector<int>(6, 1))).V;
  for (int s = 0; s < 6; ++s) EXPECT_NEAR(1e-7 * V[s], gain, 1e-5);
  const MdpSolution solution = policyIteration(river);
  EXPECT_EQ(solution.actions, std::vector<int>(6, 1));
  EXPECT_LT((solution.V - V).cwiseAbs().maxCoeff(), 1e-6 * V[0]);
  // At the discount that it has, too; going left for ever pays .005 / (1 - .95).
  river = riverSwim();
  EXPECT_EQ(policyIteration(river).actions, std::vector<int>(6, 1));
  EXPECT_NEAR(policyValues(river, deterministicPolicy(river, std::vector<int>(6, 0))).V[0], .1, 1e-12);
  EXPECT_REX_ERROR((void)riverSwim(2), "states of a river: found 2, wanted at least 3");
}

// Sutton and Barto, Reinforcement Learning, 2nd edition: examples 3.5 and 3.8, figures 3.2 and 3.5.
TEST(Mazes, JumpsHaveThePublishedValues) {
  const GridWorld world =
      gridWorld(".A.B.\n.....\n...b.\n.....\n.a...\n",
                {.bumpReward = -1, .marks = {{'A', 10, false, 'a'}, {'B', 5, false, 'b'}}});
  Eigen::MatrixXd random(5, 5), optimal(5, 5);
  random << 3.3, 8.8, 4.4, 5.3, 1.5, 1.5, 3.0, 2.3, 1.9, .5, .1, .7, .7, .4, -.4, -1.0, -.4, -.4, -.6, -1.2,
      -1.9, -1.3, -1.2, -1.4, -2.0;
  optimal << 22.0, 24.4, 22.0, 19.4, 17.5, 19.8, 22.0, 19.8, 17.8, 16.0, 17.8, 19.8, 17.8, 16.0, 14.4, 16.0,
      17.8, 16.0, 14.4, 13.0, 14.4, 16.0, 14.4, 13.0, 11.7;
  expectTable(world, policyValues(world.mdp, uniformPolicy(world.mdp)).V, random, .051);
  expectTable(world, policyIteration(world.mdp).V, optimal, .051);
  // From A one comes back in five steps: 10 / (1 - .9^5).
  EXPECT_NEAR(policyIteration(world.mdp).V[*world.state(1, 4)], 10 / (1 - std::pow(.9, 5)), 1e-12);
}

// The same book, example 4.1: whole numbers.
TEST(Mazes, RandomWalksHaveThePublishedValues) {
  const GridWorld world =
      gridWorld("G...\n....\n....\n...G", {.discount = 1, .stepReward = -1, .marks = {{'G', 0}}});
  Eigen::MatrixXd random(4, 4), optimal(4, 4);
  random << 0, -14, -20, -22, -14, -18, -20, -20, -20, -20, -18, -14, -22, -20, -14, 0;
  optimal << 0, -1, -2, -3, -1, -2, -3, -2, -2, -3, -2, -1, -3, -2, -1, 0;
  expectTable(world, policyValues(world.mdp, uniformPolicy(world.mdp)).V, random, 1e-12);
  expectTable(world, policyIteration(world.mdp).V, optimal, 1e-12);
}

// Russell and Norvig, Artificial Intelligence, 3rd edition, figure 17.3: moves slip to the side.
TEST(Mazes, SlipsHaveThePublishedValues) {
  const GridWorld world = gridWorld(
      "...G\n.#.P\n....", {.discount = 1, .stepReward = -.04, .slip = .2, .marks = {{'G', 1}, {'P', -1}}});
  Eigen::MatrixXd optimal(3, 4);
  optimal << .812, .868, .918, 1, .762, 0, .660, -1, .705, .655, .611, .388;
  const MdpSolution solution = policyIteration(world.mdp);
  ASSERT_EQ(solution.status, MdpStatus::kSolved) << solution.message;
  expectTable(world, solution.V, optimal, .00051);
  // One goes around the long way, rather than past the pit.
  EXPECT_EQ(solution.actions[static_cast<std::size_t>(*world.state(2, 0))], 3);
}

TEST(Mazes, NumberCellsFromTheLowerLeft) {
  const GridWorld world = gridWorld("#.G\n..#");
  EXPECT_EQ(world.width, 3);
  EXPECT_EQ(world.height, 2);
  EXPECT_EQ(world.state(0, 0), 0);
  EXPECT_EQ(world.state(1, 1), 2);
  EXPECT_EQ(world.state(2, 1), 3);
  EXPECT_TRUE(world.mdp.isTerminal(3));
  for (const auto& [column, row] : {std::pair{0, 1}, {2, 0}, {-1, 0}, {0, 2}})
    EXPECT_FALSE(world.state(column, row).has_value());
  EXPECT_EQ(world.mdp.transitions[0].coeff(1, 2), 1);  // north
  EXPECT_EQ(world.mdp.transitions[1].coeff(2, 3), 1);  // east
  EXPECT_EQ(world.mdp.transitions[3].coeff(1, 0), 1);  // west
  EXPECT_EQ(world.mdp.transitions[2].coeff(2, 1), 1);  // south
}

TEST(Mazes, SayWhatIsWrongAndWhere) {
  EXPECT_REX_ERROR(gridWorld(""), "map: found no free cell");
  EXPECT_REX_ERROR(gridWorld("..\n..\n.x"),
                   "map:3:2: cell of the map: found 'x', wanted '#', '.' or the let");
  EXPECT_REX_ERROR(gridWorld("..\n..\n."), "map:3: row of the map: found 1 cells, wanted 2, as in the first");
  EXPECT_REX_ERROR(gridWorld("G", {.slip = 1.5}), "slip: found 1.5");
  EXPECT_REX_ERROR(gridWorld("G.", {.discount = 3}), "discount: found 3");
  EXPECT_REX_ERROR(gridWorld("G\t"), "map:1:2: cell of the map: found '\\t', wanted");
  EXPECT_REX_ERROR(gridWorld("..", {.marks = {{'.', 1}}}),
                   "letter of a mark: found '.', wanted a letter other than '#' and '.'");
  EXPECT_REX_ERROR(gridWorld("..", {.marks = {{'#', 1}}}), "letter of a mark: found '#'");
  EXPECT_REX_ERROR(gridWorld("G.", {.marks = {{'G', 1}, {'G', 2}}}),
                   "letter of a mark: found 'G', wanted one mark of each letter");
  const GridWorldOptions jump{.marks = {{'A', 1, false, 'a'}}};
  EXPECT_REX_ERROR(gridWorld("A.", jump), "cell 'a', the target of a jump: found 0 of them, wanted one");
  EXPECT_REX_ERROR(gridWorld("Aaa", jump), "cell 'a', the target of a jump: found 2 of them, wanted one");
}

}  // namespace rex::mazes_test
