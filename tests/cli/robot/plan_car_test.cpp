// `rex plan --planner hybrid-astar` as a user meets it.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "collision/motion_clearance.h"
#include "formats/scene_file.h"
#include "support/file_text.h"
#include "support/film_length.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"
#include "support/paths.h"
#include "systems/car.h"

namespace rex::cli::plan_car_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kGoal = "-1.3,1.1,0";

class CarPlan : public RexCommand {
 protected:
  ProcessResult park(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "plan");
    arguments.insert(arguments.end(), {"--planner", "hybrid-astar", "--size", "64x48", "-o", "out"});
    return rex(arguments);
  }
  void expectRefusal(const std::vector<std::string>& arguments, const std::string& message) const {
    expectRefused(park(arguments), message);
  }
};

TEST_F(CarPlan, WritesPathTreeFilmAndReplay) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  if (!runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "needs the package ffmpeg";
  const ProcessResult result = park({"street", "--goal", kGoal, "--speed", "8"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, StartsWith("street, hybrid A*: found a path of "));
  EXPECT_THAT(result.output, HasSubstr(", no path on the grid costs less than "));
  EXPECT_THAT(result.output, HasSubstr("\nout/tree.png\nout/path.csv\nout/path.mp4\nout/path.html\n"));
  const std::string table = fileText(in("out/path.csv"));
  const double seconds = std::stod(table.substr(table.rfind('\n', table.size() - 2) + 1));
  EXPECT_NEAR(replaySeconds(in("out/path.html")), seconds / 8, 1e-4);
  EXPECT_THAT(fileText(in("out/path.html")), HasSubstr("changes of direction"));
  EXPECT_EQ(rex({"render", "street", "--motion", "out/path.csv", "--size", "64x48", "-o", "a.png"}).exitCode,
            0);
}

// The drives lead to the goal, and touch nothing, by the scene that a user sees.
TEST_F(CarPlan, AnswersProgramsWithDrivesThatPark) {
  REX_NEEDS_OSMESA();
  const ProcessResult result = park({"street", "--goal", kGoal, "--no-film", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const nlohmann::json json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json.at("found"), true);
  EXPECT_EQ(json.at("files").size(), 2u);
  const Model model = compile(readScene(sourcePath("data/scenes/street.ors")).spec);
  const ContactModel contacts(model);
  Eigen::Vector3d q = model.initialPositions();
  double length = 0, nearest = 1;
  for (const auto& drive : json.at("drives")) {
    const double way = drive[0], steering = drive[1];
    length += std::abs(way);
    const int pieces = static_cast<int>(std::ceil(std::abs(way) / .02));
    for (int i = 0; i < pieces; ++i) {
      const Eigen::Vector3d next =
          driveCar({.wheelbase = 2.6, .maxSteering = .6}, q, {way, steering}, 1. / pieces);
      nearest = std::min(nearest, motionClearance(model, contacts, q, next, 1e-3));
      q = next;
    }
  }
  EXPECT_LT((q - Eigen::Vector3d(-1.3, 1.1, 0)).norm(), 1e-9);
  EXPECT_NEAR(length, json.at("length"), 1e-9);
  EXPECT_GT(nearest, 0);
  EXPECT_NEAR(nearest, json.at("clearance"), 3e-3);
  EXPECT_EQ(json.at("switches"), 2);
}

TEST_F(CarPlan, SaysThatASpaceIsTooShort) {
  REX_NEEDS_OSMESA();
  std::string scene = fileText(sourcePath("data/scenes/street.ors"));
  for (const auto& [from, to] : {std::pair{"t(5.1 ", "t(4.4 "}, {"t(-5.1 ", "t(-4.4 "}})
    scene.replace(scene.find(from), std::string(from).size(), to);
  std::ofstream(in("short.ors")) << scene;
  const ProcessResult result = park({in("short.ors"), "--goal", kGoal, "--margin", "0.03", "--no-film"});
  EXPECT_EQ(result.exitCode, 1) << result.error;
  EXPECT_THAT(flat(result.output), HasSubstr("no path on this grid: the goal is reached from only"));
  EXPECT_TRUE(fs::exists(in("out/tree.png")));
  EXPECT_FALSE(fs::exists(in("out/path.csv")));
}

TEST_F(CarPlan, TellsWhichShapesAreNoObstacles) {
  REX_NEEDS_OSMESA();
  std::string scene = fileText(sourcePath("data/scenes/street.ors"));
  const std::string joint = "joint drive (road car) { A=<T t(0 -4 0.05)>";
  scene.replace(scene.find(joint), joint.size(), "joint drive (world car) { A=<T t(0 0 0)>");
  std::ofstream(in("world.ors")) << scene;
  const ProcessResult result = park({in("world.ors"), "--goal", "5,1.1,0", "--no-film"});
  EXPECT_EQ(result.exitCode, 0) << "it parks where another car stands";
  EXPECT_THAT(flat(result.error),
              HasSubstr("shapes of 'world' and 'car' do not stop each other, because a joint"));
  EXPECT_THAT(park({"street", "--goal", kGoal, "--no-film"}).error, Not(HasSubstr("do not stop")));
}

TEST_F(CarPlan, SaysWhatIsWrong) {
  expectRefusal(
      {"board", "--goal", "0,0,0"},
      "board: found 3 coordinates, wanted one joint of type transXYPhi, that of the car, and no other");
  expectRefusal({"man", "--goal", "0,0,0"}, "man: found 27 coordinates, wanted one joint of type transXYPhi");
  expectRefusal({"street"}, "--goal is required");
  expectRefusal({"street", "--goal", "5,1.1,0"}, "--goal: found '");
  expectRefusal({"street", "--goal", "5,9,0"}, "--goal");
  expectRefusal({"street", "--goal", kGoal, "--start", "5,1.1,0"}, "--start: found '");
  expectRefusal({"street", "--goal", kGoal, "--seed", "1"},
                "--seed: found --planner hybrid-astar, wanted a planner that draws samples");
}

}  // namespace rex::cli::plan_car_test
