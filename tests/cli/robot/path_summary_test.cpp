#include "cli/robot/path_summary.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planning/robot_problem.h"
#include "scene/ors_reader.h"

namespace rex::cli::path_summary_test {

using ::testing::HasSubstr;
using ::testing::Not;

class Summary : public ::testing::Test {
 protected:
  // A metre at 1 m/s, which is reached after half a second.
  PathTiming timing() const {
    FoundPath found;
    found.curve = straightCurve(task.problem.space, Eigen::RowVector2d(0, 1));
    return timingOf(task, options, found);
  }
  static FoundPath path(std::uint64_t seed, double length) {
    return {.seed = seed,
            .path = Eigen::MatrixXd::Zero(1, 2),
            .length = length,
            .plannedLength = 2 * length,
            .clearance = {0.02, 0.0201},
            .samples = 9,
            .nodes = static_cast<int>(seed),
            .checks = 100,
            .planningTime = 0.25,
            .smoothingTime = 0.001};
  }

  const Model model = compile(parseOrs("body a {} body b {} joint (a b) { limits=[-1 1] }", "pole").spec);
  const ContactModel contacts{model};
  const PathTask task{model, contacts,
                      robotProblem(model, contacts, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1))};
  PlanOptions options{};
};

TEST_F(Summary, TellsOfOneSearch) {
  EXPECT_EQ(summaryOf(task, options, {.all = {path(7, 3)}}, timing()),
            "pole, rrt-connect, seed 7: found a path\n"
            "explored   7 nodes of 9 samples, 100 configurations checked\n"
            "CPU time   250.0 ms for planning, 1.0 ms for smoothing\n"
            "length     3.000, before smoothing 6.000\n"
            "duration   1.500 s, at least 1.000 s from the velocity limits alone; no stop on the way\n"
            "limits     velocities 1 rad/s or m/s; accelerations that reach them in 0.5 s\n"
            "clearance  0.0200 m all along the path, margin 0.01 m");
  FoundPath free = path(7, 3);
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  free.clearance = {kEndless, kEndless};
  EXPECT_THAT(summaryOf(task, options, {.all = {free}}, timing()), HasSubstr("nothing can collide"));
  FoundPath open = path(7, 3);
  open.clearance = {-0.01, 0.02};
  EXPECT_THAT(summaryOf(task, options, {.all = {open}}, timing()),
              HasSubstr("-0.0100 m all along the path is proven, 0.0200 m measured, margin"));
  EXPECT_EQ(summaryOf(task, options, {.all = {{.samples = 4, .nodes = 2, .checks = 5}}}, {}),
            "pole, rrt-connect, seed 0: no path within the budget of --samples\n"
            "explored   2 nodes of 4 samples, 5 configurations checked\n"
            "CPU time   0.0 ms for planning");
}

TEST_F(Summary, TellsWhyThereIsNoMotion) {
  PathTiming none;
  none.result.message = "no motion along the path: at s = 0 of 1: too heavy";
  EXPECT_THAT(summaryOf(task, options, {.all = {path(7, 3)}}, none),
              HasSubstr("\nduration   none: no motion along the path: at s = 0 of 1: too heavy\n"));
}

TEST_F(Summary, TellsOfSeveralInATable) {
  const FoundPaths found{.all = {path(1, 9), {.seed = 2, .nodes = 50}, path(3, 4), path(4, 6)}, .best = 2};
  const std::string text = summaryOf(task, options, found, timing());
  EXPECT_THAT(text, HasSubstr("pole, rrt-connect, seeds 1 to 4: 3 of 4 found a path\n"));
  EXPECT_THAT(text, HasSubstr("\nnodes                           1        3.5         50\n"));
  EXPECT_THAT(text, HasSubstr("\nlength                          4          6          9\n"));
  EXPECT_THAT(text, HasSubstr("\nshortest: seed 3\nduration   1.500 s, at least 1.000 s"));
  const std::string none = summaryOf(task, options, {.all = {FoundPath{}, FoundPath{}}}, {});
  EXPECT_THAT(none, HasSubstr("0 of 2 found a path"));
  EXPECT_THAT(none, HasSubstr("nodes"));
  EXPECT_THAT(none, Not(HasSubstr("length")));
  EXPECT_THAT(none, Not(HasSubstr("shortest")));
}

}  // namespace rex::cli::path_summary_test
