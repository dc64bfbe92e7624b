// `rex plan --planner optimize` as a user meets it.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "collision/motion_clearance.h"
#include "formats/scene_file.h"
#include "kinematics/jacobians.h"
#include "render/image.h"
#include "support/file_text.h"
#include "support/film_length.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"
#include "support/paths.h"

namespace rex::cli::plan_motion_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class MotionPlan : public RexCommand {
 protected:
  ProcessResult trajectory(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "plan");
    if (std::ranges::find(arguments, "--planner") == arguments.end())
      arguments.insert(arguments.end(), {"--planner", "optimize"});
    arguments.insert(arguments.end(), {"-o", "out"});
    return rex(arguments);
  }
  nlohmann::json answer(std::vector<std::string> arguments, int exitCode) const {
    arguments.insert(arguments.end(), {"--no-film", "--json"});
    const ProcessResult result = trajectory(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.error;
    return nlohmann::json::parse(result.output);
  }
  void expectRefusal(const std::vector<std::string>& arguments, const std::string& message) const {
    expectRefused(trajectory(arguments), message);
  }
};

Eigen::MatrixXd pathOf(const nlohmann::json& answer) {
  const auto rows = answer["path"].get<std::vector<std::vector<double>>>();
  Eigen::MatrixXd path(rows.front().size(), rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    path.col(static_cast<Eigen::Index>(k)) = Eigen::VectorXd::Map(rows[k].data(), path.rows());
  return path;
}

TEST_F(MotionPlan, WritesMotionCostsFilmAndReplay) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  if (!runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "needs the package ffmpeg";
  const ProcessResult result = trajectory({"arm7", "--goal", "arm7:0.5,0.2,0.6", "--size", "64x48"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, StartsWith("arm7: arm7 to 0.5, 0.2, 0.6\nsolved (augmented Lagrangian) after "));
  EXPECT_THAT(result.output, HasSubstr("\nclearance  nothing can collide\nout/costs.png\nout/path.csv\n"
                                       "out/path.mp4\nout/path.html\n"));
  EXPECT_EQ(readPng(in("out/costs.png")).width, 800);
  EXPECT_GT(fs::file_size(in("out/path.mp4")), 500u);
  EXPECT_THAT(fileText(in("out/path.html")), HasSubstr("Newton steps"));
  EXPECT_EQ(rex({"render", "arm7", "--motion", "out/path.csv", "--size", "64x48", "-o", "a.png"}).exitCode,
            0);
}

TEST_F(MotionPlan, PlaysInRealTimeOrAsFastAsAskedFor) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  if (!runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "needs the package ffmpeg";
  const std::vector<std::string> task{"arm7",   "--goal", "arm7:0.5,0.2,0.6", "--duration", "1",
                                      "--size", "64x48"};
  ASSERT_EQ(trajectory(task).exitCode, 0);
  EXPECT_EQ(framesOf(in("out/path.mp4")), "31,30/1");
  EXPECT_NEAR(replaySeconds(in("out/path.html")), 1, 1e-5);
  std::vector<std::string> slowly = task;
  slowly.insert(slowly.end(), {"--speed", "0.5"});
  ASSERT_EQ(trajectory(slowly).exitCode, 0);
  EXPECT_EQ(framesOf(in("out/path.mp4")), "61,30/1");
  EXPECT_NEAR(replaySeconds(in("out/path.html")), 2, 1e-5);
}

TEST_F(MotionPlan, BringsTheBodyToTheGoalAtRestWithEachMethod) {
  REX_NEEDS_GNUPLOT();
  const Model model = compile(readScene(sourcePath("data/robots/arm7.ors")).spec);
  std::vector<double> costs;
  for (const char* method : {"optimize", "optimize-penalty", "optimize-barrier"}) {
    const nlohmann::json found =
        answer({"arm7", "--goal", "arm7:0.5,0.2,0.6", "--planner", method, "--steps", "40"}, 0);
    const Eigen::MatrixXd path = pathOf(found);
    ASSERT_EQ(path.cols(), 41);
    const BodyPoses poses = forwardKinematics(model, path.rightCols<1>());
    const Eigen::Vector3d p_WB = position(poses, model.body("arm7"), Eigen::Vector3d::Zero());
    EXPECT_LT((p_WB - Eigen::Vector3d(0.5, 0.2, 0.6)).norm(), 1e-5) << method;
    EXPECT_LT((path.col(40) - path.col(39)).norm() / found["tau"].get<double>(), 1e-5) << method;
    costs.push_back(found["cost"]);
  }
  EXPECT_NEAR(costs[1], costs[0], 1e-3 * costs[0]);
  EXPECT_NEAR(costs[2], costs[0], 1e-3 * costs[0]);
}

// The same motion without --avoid goes through the wall. What is reported is proven once more here.
TEST_F(MotionPlan, GoesRoundWhatIsInTheWay) {
  REX_NEEDS_GNUPLOT();
  const std::vector<std::string> task{"board", "--goal", "eff:0,-0.3,0.5"};
  EXPECT_LT(answer(task, 0)["clearance"], 0);
  std::vector<std::string> avoiding = task;
  avoiding.emplace_back("--avoid");
  const nlohmann::json found = answer(avoiding, 0);
  EXPECT_GT(found["clearance"], 0);
  const Model model = compile(readScene(sourcePath("data/scenes/board.ors")).spec);
  const ContactModel contacts(model);
  const Eigen::MatrixXd path = pathOf(found);
  for (Eigen::Index k = 1; k < path.cols(); ++k)
    ASSERT_GT(motionClearance(model, contacts, path.col(k - 1), path.col(k), 1e-4), 0) << k;
}

TEST_F(MotionPlan, SaysWhichConstraintCannotHold) {
  REX_NEEDS_GNUPLOT();
  const nlohmann::json found = answer({"arm7", "--goal", "arm7:5,0,0", "--steps", "20"}, 1);
  EXPECT_EQ(found["status"], "infeasible");
  EXPECT_THAT(found["most_violated"].get<std::string>(), HasSubstr("'goal' at step 19"));
  EXPECT_GT(found["error"], 1);
}

TEST_F(MotionPlan, GivesTheSameBytesAgain) {
  REX_NEEDS_GNUPLOT();
  ASSERT_EQ(trajectory({"board", "--goal", "eff:0,-0.45,0.6", "--avoid", "--no-film"}).exitCode, 0);
  const std::string first = fileText(in("out/path.csv"));
  ASSERT_EQ(trajectory({"board", "--goal", "eff:0,-0.45,0.6", "--avoid", "--no-film"}).exitCode, 0);
  EXPECT_EQ(fileText(in("out/path.csv")), first);
}

TEST_F(MotionPlan, RefusesWrongUse) {
  expectRefusal({"board", "--goal", "eff"}, "--goal: found 'eff', wanted BODY:x,y,z");
  expectRefusal({"board", "--goal", "ef:0,0,0"}, "scene 'board' has no body 'ef' (did you mean 'eff'?)");
  expectRefusal({"board", "--goal", "eff:0,0"}, "--goal");
  expectRefusal({"board", "--goal", "eff:0,0,x"}, "--goal");
  expectRefusal({"board", "--goal", "eff:0,0,0", "--planner", "optimize-penalti"},
                "(did you mean 'optimize-penalty'");
  expectRefusal({"board", "--goal", "eff:0,0,0", "--wheelbase", "3"},
                "--wheelbase: found --planner optimize, wanted --planner hybrid-astar");
  expectRefusal({"board", "--goal", "eff:0,0,0", "--margin", "0"}, "--margin: found 0, wanted 0.0001 to 0.5");
  expectRefusal({"board", "--goal", "eff:0,0,0", "--margin", "0.6"}, "--margin: found 0.6, wanted 0 to 0.5");
  expectRefusal({"board", "--goal", "eff:0,0,0", "--start", "1,2"}, "--start");
  expectRefusal({"board", "--goal", "eff:0,0,0", "--avoid", "--margin", "0.5"},
                "m apart, wanted all shapes 0.5 m apart, the --margin");
  std::ofstream(in("ball.ors"))
      << "body base {}\nbody ball {}\nshape (ball) { type=ST_sphere size=[0 0 0 .1] }\n"
         "joint spin (base ball) { type=quatBall }\n";
  expectRefusal({"ball.ors", "--goal", "ball:0,0,1"}, "quaternion");
}

}  // namespace rex::cli::plan_motion_test
