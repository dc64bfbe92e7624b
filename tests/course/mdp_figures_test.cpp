#include "course/mdp_figures.h"

#include <limits>

#include <gtest/gtest.h>

#include "learning/dynamic_programming.h"
#include "support/expect_error.h"
#include "support/needs_gnuplot.h"
#include "support/temporary_folder.h"

namespace rex::mdp_figures_test {

TEST(MdpFigures, PlacesValuesAndWalls) {
  const GridWorld world = gridWorld("G.\n.#", {.discount = .5});
  const MdpSolution solution = policyIteration(world.mdp);
  const Figure values = valueFigure(world, solution.V);
  ASSERT_TRUE(values.heatMap);
  EXPECT_EQ(values.heatMap->values(1, 0), 1);
  EXPECT_EQ(values.heatMap->values(1, 1), .5);
  EXPECT_EQ(values.heatMap->values(0, 0), .5);
  ASSERT_EQ(values.regions.size(), 1u);
  EXPECT_EQ(values.regions[0].x, (std::vector<double>{.5, 1.5, 1.5, .5}));
  EXPECT_EQ(values.regions[0].y, (std::vector<double>{-.5, -.5, .5, .5}));
  ASSERT_EQ(values.notes.size(), 3u);
  EXPECT_EQ(values.notes[1].text, "1.00");
  const Figure policy = policyFigure(world, solution.V, deterministicPolicy(world.mdp, solution.actions));
  ASSERT_EQ(policy.arrows.size(), 1u);
  EXPECT_EQ(policy.arrows[0].x, (std::vector<double>{0, 1}));  // north from (0, 0), west from (1, 1)
  EXPECT_GT(policy.arrows[0].dy[0], 0);
  EXPECT_LT(policy.arrows[0].dx[1], 0);
  EXPECT_EQ(policyFigure(world, solution.V, uniformPolicy(world.mdp)).arrows[0].x.size(), 8u);
}

TEST(MdpFigures, SumUpRuns) {
  const Figure figure = learningFigure({{"a", {{1, 2}, {3, 2}, {5, 5}}}});
  EXPECT_EQ(figure.series[0].y, (std::vector<double>{3, 3}));
  EXPECT_NEAR(figure.bands[0].low[0], 1.4, 1e-12);
  EXPECT_NEAR(figure.bands[0].high[0], 4.6, 1e-12);
  EXPECT_NEAR(figure.bands[0].high[1], 4.4, 1e-12);
}

TEST(MdpFigures, CanBeDrawn) {
  REX_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const GridWorld world =
      gridWorld("...G\n.#.P\n....", {.stepReward = -.04, .slip = .2, .marks = {{'G', 1}, {'P', -1}}});
  const MdpSolution solution = policyIteration(world.mdp);
  for (Figure figure : {valueFigure(world, solution.V),
                        policyFigure(world, solution.V, deterministicPolicy(world.mdp, solution.actions)),
                        valueFigure(world, Eigen::VectorXd::Ones(11)),
                        learningFigure({{"a", {{1, 2, 4}, {2, 3, 3}}}, {"b", {{0, 1, 0}, {1, 1, 3}}}})})
    EXPECT_THAT(encodeSvg(figure), testing::HasSubstr("</svg>"));
}

TEST(MdpFigures, RefuseWrongInput) {
  const GridWorld world = gridWorld("G.\n..");
  EXPECT_REX_ERROR(valueFigure(world, Eigen::VectorXd::Zero(3)), "values of the grid");
  EXPECT_REX_ERROR(policyFigure(world, Eigen::VectorXd::Zero(4), Eigen::MatrixXd::Zero(4, 3)),
                   "policy of the grid: found 4 x 3, wanted 4 x 4");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REX_ERROR(valueFigure(world, Eigen::Vector4d(0, nan, 0, 0)),
                   "values of the grid: number 1: found nan");
  EXPECT_REX_ERROR(valueFigure(gridWorld("G.."), Eigen::Vector3d::Zero()),
                   "grid to draw: found 3 x 1 cells, wanted 2 x 2 or more");
  EXPECT_REX_ERROR(learningFigure({{"odd", {{1, 2}, {1, nan}}}}), "run 1 of 'odd': number 1: found nan");
  EXPECT_REX_ERROR(learningFigure({{"empty", {}}}), "learning curves 'empty': found no run");
  EXPECT_REX_ERROR(learningFigure({{"uneven", {{1, 2}, {1}}}}),
                   "run 1 of 'uneven': found a vector of size 1, wanted");
}

}  // namespace rex::mdp_figures_test
