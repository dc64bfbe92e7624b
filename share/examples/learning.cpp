// Q-learning in a maze: from rewards alone, a robot that slips learns where to go. The last cell, at the
// upper right, is the goal.
#include <cstdio>

#include "course/course.h"
#include "learning/mazes.h"
#include "learning/q_learning.h"

using namespace rex;

int main() {
  const std::string map = "....G\n.###.\n.....\n.#.#.\n.....\n";
  const GridWorld maze = gridWorld(map, {.discount = 0.95, .stepReward = -0.02, .slip = 0.1});

  Rng rng(1);
  const Eigen::VectorXd start = Eigen::VectorXd::Unit(maze.mdp.states(), 0);  // the lower left cell
  const TabularResult learnt =
      qLearning(maze.mdp, {.episodes = 200, .stepExponent = 0.6, .start = start}, rng);

  std::vector<std::string> arrows(5, "#####");
  for (int s = 0; s < maze.mdp.states(); ++s) {
    Eigen::Index best = 0;
    learnt.Q.row(s).maxCoeff(&best);
    const auto [column, row] = maze.cells[s];
    arrows[row][column] = "^>v<"[best];
  }
  for (std::size_t row = arrows.size(); row-- > 0;) std::puts(arrows[row].c_str());

  Series steps{.label = "steps until the goal"};
  for (std::size_t k = 0; k < learnt.steps.size(); ++k)
    steps.x.push_back(static_cast<double>(k + 1)), steps.y.push_back(learnt.steps[k]);
  plot("learning", {.title = "A maze is learnt", .xLabel = "episode", .yLabel = "steps", .series = {steps}});
}
