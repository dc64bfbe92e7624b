// `rex plan` as a user meets it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "collision/motion_clearance.h"
#include "formats/scene_file.h"
#include "render/image.h"
#include "support/file_text.h"
#include "support/film_length.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"
#include "support/paths.h"

namespace rex::cli::plan_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kGoal = "1.5,-1.1,-1";
constexpr const char* kPegInTheHole = "0.945499,0.431195,-1.97155,0.623969,2.22355,-0.665206,-1.48356";

class PlanCommand : public RexCommand {
 protected:
  ProcessResult plan(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "plan");
    return rex(arguments);
  }
  // Without the film.
  ProcessResult planBoard(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(),
                     {"board", "--goal", kGoal, "--no-film", "--size", "64x48", "-o", "out"});
    return plan(arguments);
  }
  void expectRefusal(std::vector<std::string> arguments, const std::string& message) const {
    arguments.insert(arguments.end(), {"-o", "out"});
    expectRefused(plan(arguments), message);
  }
  void expectRefusalOnBoard(std::vector<std::string> arguments, const std::string& message) const {
    arguments.insert(arguments.begin(), {"board", "--goal", kGoal});
    expectRefusal(arguments, message);
  }
  fs::path scene(const std::string& text) const {
    std::ofstream(in("my.ors")) << text;
    return in("my.ors");
  }
};

TEST_F(PlanCommand, WritesPathTreeFilmAndReplay) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  if (!runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "needs the package ffmpeg";
  const ProcessResult result =
      plan({"board", "--goal", kGoal, "--speed", "4", "--size", "64x48", "--camera", "right", "-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, StartsWith("board, rrt-connect, seed 0: found a path\n"));
  EXPECT_THAT(result.output, HasSubstr("\nout/tree.png\nout/path.csv\nout/path.mp4\nout/path.html\n"));
  const std::string table = fileText(in("out/path.csv"));
  EXPECT_THAT(table, StartsWith("time,stem>arm1,arm1>arm2,arm2>eff\n0,"));
  EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 20);
  EXPECT_EQ(readPng(in("out/tree.png")).width, 64);
  EXPECT_GT(fs::file_size(in("out/path.mp4")), 500u);
  const double seconds = std::stod(table.substr(table.rfind('\n', table.size() - 2) + 1));
  EXPECT_NEAR(replaySeconds(in("out/path.html")), seconds / 4, 1e-4);
  EXPECT_EQ(framesOf(in("out/path.mp4")), fmt::format("{},30/1", std::ceil(30 * seconds / 4) + 1));
  const std::string page = fileText(in("out/path.html"));
  EXPECT_THAT(page, HasSubstr("board, rrt-connect, seed 0"));
  EXPECT_THAT(page, HasSubstr("configurations checked"));
  EXPECT_THAT(page, HasSubstr("alt=\"speeds\""));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\">speed of the replay</th><td>4</td>"));
  EXPECT_EQ(rex({"render", "board", "--motion", "out/path.csv", "--size", "64x48", "-o", "a.png"}).exitCode,
            0);
}

TEST_F(PlanCommand, AnswersProgramsWithAPathThatIsClear) {
  REX_NEEDS_OSMESA();
  const ProcessResult result = planBoard({"--runs", "3", "--seed", "4", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const nlohmann::json json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json.at("found"), 3);
  ASSERT_EQ(json.at("runs").size(), 3u);
  EXPECT_EQ(json.at("runs")[2].at("seed"), 6);
  EXPECT_GT(json.at("runs")[0].at("checks"), 100);
  EXPECT_GE(json.at("runs")[0].at("planning_seconds"), 0);
  EXPECT_EQ(json.at("files").size(), 2u);
  const Model model = compile(readScene(sourcePath("data/scenes/board.ors")).spec);
  const ContactModel contacts(model);
  std::vector<Eigen::VectorXd> path;
  for (const auto& row : json.at("path")) {
    const auto q = row.get<std::vector<double>>();
    path.emplace_back(Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size())));
  }
  ASSERT_GT(path.size(), 2u);
  EXPECT_EQ(path.front(), model.initialPositions());
  double nearest = 1;
  for (std::size_t k = 1; k < path.size(); ++k)
    nearest = std::min(nearest, motionClearance(model, contacts, path[k - 1], path[k], 1e-4));
  const std::size_t best = json.at("shortest").get<std::size_t>() - 4;
  EXPECT_NEAR(nearest, json.at("runs")[best].at("clearance"), 2e-4);
  EXPECT_GT(nearest, 0);
}

TEST_F(PlanCommand, WritesTheSameTwice) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  for (const char* out : {"a", "b"})
    ASSERT_EQ(plan({"board", "--goal", kGoal, "--size", "64x48", "--speed", "9", "--seed", "7", "-o", out})
                  .exitCode,
              0);
  for (const char* name : {"path.csv", "tree.png", "path.html"})
    EXPECT_EQ(fileText(in("a") / name), fileText(in("b") / name)) << name;
  ASSERT_EQ(
      plan({"board", "--goal", kGoal, "--size", "64x48", "--no-film", "--seed", "8", "-o", "c"}).exitCode, 0);
  EXPECT_NE(fileText(in("a/path.csv")), fileText(in("c/path.csv")));
}

TEST_F(PlanCommand, TellsOfSeveralSeeds) {
  REX_NEEDS_OSMESA();
  const ProcessResult result = planBoard({"--runs", "5", "--planner", "lazy-prm", "--samples", "300"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("board, lazy-prm, seeds 0 to 4: 5 of 5 found a path\n"));
  for (const char* row : {"nodes", "configurations checked", "planning, CPU ms", "length", "clearance, m"})
    EXPECT_THAT(result.output, HasSubstr(row));
}

TEST_F(PlanCommand, BringsThePegIntoTheHole) {
  REX_NEEDS_OSMESA();
  const ProcessResult result = plan({"pegInAHole", "--start", "0", "--goal", kPegInTheHole, "--margin",
                                     "0.02", "--runs", "3", "--no-film", "--json", "-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const auto report = nlohmann::json::parse(result.output);
  for (const auto& run : report.at("runs")) {
    EXPECT_TRUE(run.at("found"));
    EXPECT_GT(run.at("clearance"), 0.015);
  }
}

TEST_F(PlanCommand, ShowsWhatItExploredWhereThereIsNoPath) {
  REX_NEEDS_OSMESA();
  ASSERT_EQ(planBoard({}).exitCode, 0);
  ASSERT_TRUE(fs::exists(in("out/path.csv")));
  const ProcessResult result = planBoard({"--samples", "3"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.output, HasSubstr("seed 0: no path within the budget of --samples\nexplored "));
  EXPECT_TRUE(fs::exists(in("out/tree.png")));
  EXPECT_FALSE(fs::exists(in("out/path.csv"))) << "it belongs to another search";
  const nlohmann::json json = nlohmann::json::parse(planBoard({"--samples", "3", "--json"}).output);
  EXPECT_EQ(json.at("found"), 0);
  EXPECT_TRUE(json.at("path").is_null());
}

// A wall that is thinner than the steps of the checks.
TEST_F(PlanCommand, EndsAfterItsTimeLimit) {
  const ProcessResult result =
      planBoard({"--planner", "rrt-star", "--samples", "10000000", "--time-limit", "0.05"});
  EXPECT_THAT(result.output, AnyOf(HasSubstr("no path within 0.05 s, the --time-limit\nexplored "),
                                   HasSubstr("ms for planning, ended by the --time-limit")));
  EXPECT_TRUE(std::filesystem::exists(in("out/tree.png"))) << "what was explored";
  const ProcessResult table =
      planBoard({"--planner", "rrt-star", "--samples", "10000000", "--time-limit", "0.05", "--runs", "2"});
  EXPECT_THAT(table.output, HasSubstr("\n2 ended after 0.05 s, the --time-limit\n"));
}

TEST_F(PlanCommand, TellsOfAPathThatIsNotClear) {
  REX_NEEDS_OSMESA();
  const fs::path file = scene(
      "body rail {} body ball { type=1 size=[0 0 0 .05] contact }\n"
      "body wall { type=0 size=[.02 1 1 0] contact }\n"
      "joint slide (rail ball) { A=<T t(-1 0 0)> type=transX limits=[0 2] }\n");
  const auto plan2 = [&](const char* resolution, const char* margin) {
    return plan({file.string(), "--goal", "2", "--resolution", resolution, "--step", "2", "--samples", "50",
                 "--margin", margin, "--no-film", "-o", "out"});
  };
  for (const char* margin : {"0.01", "0"}) {
    const ProcessResult coarse = plan2("2", margin);
    EXPECT_EQ(coarse.exitCode, 1) << margin;
    EXPECT_THAT(coarse.output, HasSubstr("found a path"));
    EXPECT_THAT(flat(coarse.error), HasSubstr("use a finer --resolution or a larger --margin"));
  }
  const ProcessResult fine = plan2("0.02", "0.01");
  EXPECT_EQ(fine.exitCode, 1);
  EXPECT_THAT(fine.output, HasSubstr("no path within the budget"));
}

// One leg would have to go through the other.
TEST_F(PlanCommand, KeepsTheLegsOfTheHumanoidApart) {
  const std::string apart = "left_hip_roll=.3,right_hip_roll=-.3";
  expectRefusal(
      {"humanoid", "--start", apart, "--goal", "left_hip_roll=-.45,right_hip_roll=.45", "--no-film"},
      "--goal: found 'left_");
  const ProcessResult result =
      plan({"humanoid", "--start", "left_hip_roll=-.3,left_hip_pitch=-.7", "--goal",
            "left_hip_roll=-.3,left_hip_pitch=.6", "--no-film", "--json", "-o", "swing"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
}

TEST_F(PlanCommand, IsNotStoppedByThingsThatStandInEachOther) {
  const std::string shelves =
      "body shelf2 { type=ST_box size=[1 1 .02] contact fixed }\n"
      "body shelf3 { X=<T t(0 0 .01)> type=ST_box size=[1 1 .02] contact fixed }\n"
      "body rail { X=<T t(0 0 1)> }\n"
      "body cart { type=ST_sphere size=[0 0 0 .1] contact }\n"
      "joint drive (rail cart) { type=transX limits=[-1 1] }\n";
  EXPECT_EQ(plan({scene(shelves).string(), "--goal", "0.5", "--no-film", "-o", "out"}).exitCode, 0);
}

TEST_F(PlanCommand, SaysThatNothingCanCollide) {
  REX_NEEDS_OSMESA();
  const ProcessResult result = plan({"arm3", "--goal", "1,1,1", "--no-film", "-o", "out"});
  EXPECT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.error, HasSubstr("arm3: no two shapes may collide: every path is free"));
  EXPECT_THAT(result.output, HasSubstr("nothing can collide"));
}

TEST_F(PlanCommand, TakesRotationsOfAnyLength) {
  REX_NEEDS_OSMESA();
  const fs::path file =
      scene("body a {} body b { type=0 size=[.1 .2 .3 0] }\njoint (a b) { type=quatBall }\n");
  const ProcessResult result =
      plan({file.string(), "--goal", "0.7,0.7,0,0", "--no-film", "--json", "-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const nlohmann::json path = nlohmann::json::parse(result.output).at("path");
  EXPECT_NEAR(path.back()[1].get<double>(), std::sqrt(0.5), 1e-9);
  fs::remove_all(in("out"));
  expectRefusal(
      {file.string(), "--goal", "0,0,0,0"},
      "--goal: found (0, 0, 0, 0) for joint 'a>b', wanted a quaternion w, x, y, z that is not zero");
}

TEST_F(PlanCommand, RefusesPosturesThatCannotBe) {
  expectRefusal({"board", "--goal", "arm1>arm2=1"},
                "--goal: found 'board' and 'eff' 0.09242 m in overlap, wanted all shapes 0.01 m apart");
  expectRefusal({"board", "--goal", kGoal, "--start", "arm1>arm2=1"}, "--start: found 'board' and 'eff'");
  expectRefusal({"board", "--goal", kGoal, "--margin", "0.5"}, "m apart, wanted all shapes 0.5 m apart");
  expectRefusal({"arm7dof", "--goal", "shoulder_yaw=3"},
                "--goal: joint 'shoulder_yaw' (q0): found 3, out of bounds by 0.1, wanted -2.9 to 2.9");
  expectRefusal({"maze", "--start", "0,-1,0", "--goal", "3,0,0"},
                "--start: joint 'drive' (q1): found -1, out of bounds by 0.5, wanted -0.5 to 2.5");
  expectRefusal({"board", "--goal", "1,2"}, "--goal: found 2 numbers, wanted 3");
  expectRefusal({"board", "--goal", kGoal, "--start", "1,2,x"}, "--start: found 'x', wanted a number");
  expectRefusal({"board", "--goal", "arm1>arm=1"}, "did you mean 'arm1>arm2'?");
  expectRefusal({"board"}, "--goal is required");
  for (const char* command : {"plan", "simulate", "render"})
    EXPECT_THAT(rex({command, "nosuch.ors"}).error, HasSubstr("there is no scene 'nosuch.ors'")) << command;
  EXPECT_THAT(rex({"simulate", "board"}).error, HasSubstr("--out is required"));
}

TEST_F(PlanCommand, RefusesScenesThatItCannotPlanIn) {
  expectRefusal({"bord", "--goal", "0"}, "did you mean 'board'?");
  expectRefusal({scene("body a { type=0 size=[1 1 1 0] }"), "--goal", "0"},
                "my.ors: found no joint that moves");
  expectRefusal(
      {scene("body a {} body b { type=0 size=[1 1 1 0] } joint rail (a b) { type=transX }"), "--goal", "1"},
      "joint 'rail': found limits -inf and inf, wanted finite limits");
  expectRefusal({scene("body a {} body b {} joint (a b) {}"), "--goal", "1"},
                "found no shape that a film can show, wanted --no-film");
}

TEST_F(PlanCommand, RefusesOptionsThatMakeNoSense) {
  expectRefusalOnBoard({"--planner", "prm", "--step", "1"},
                       "--step: found --planner prm, wanted a planner that grows trees");
  expectRefusalOnBoard({"--planner", "prm", "--samples", "1000000"},
                       "--samples: found 1000000, wanted 1 to 100000");
  expectRefusalOnBoard({"--body", "stme"}, "--body: scene 'board' has no body 'stme' (did you mean 'stem'?)");
  expectRefusalOnBoard({"--body", "stem"}, "--body: found 'stem', which no joint moves");
  expectRefusalOnBoard({"--camera", "frnt"}, "did you mean 'front'?");
  expectRefusalOnBoard({"--plannr", "rrt"}, "unknown option '--plannr' (did you mean '--planner'?)");
}

TEST_F(PlanCommand, RefusesAFolderThatCannotBe) {
  std::ofstream(in("file")) << "x";
  for (const char* out : {"file", "file/inside"}) {
    const ProcessResult result = plan({"board", "--goal", kGoal, "-o", out});
    EXPECT_EQ(result.exitCode, 64);
    EXPECT_THAT(flat(result.error), HasSubstr("-o " + std::string(out) + ": found "));
    EXPECT_THAT(flat(result.error), HasSubstr("wanted a folder"));
  }
}

TEST_F(PlanCommand, RefusesAFolderThatTakesNoFiles) {
  fs::create_directories(in("out/path.csv/inside"));
  const ProcessResult blocked = planBoard({});
  EXPECT_EQ(blocked.exitCode, 64);
  EXPECT_THAT(flat(blocked.error), HasSubstr("-o out/path.csv: found "));
  EXPECT_THAT(flat(blocked.error), HasSubstr("wanted a file, or nothing"));
  EXPECT_EQ(blocked.output, "") << "before the search";
  const ProcessResult locked = plan({"board", "--goal", kGoal, "-o", "/proc"});
  EXPECT_EQ(locked.exitCode, 64);
  EXPECT_THAT(flat(locked.error), HasSubstr("-o /proc: found "));
  EXPECT_THAT(flat(locked.error), HasSubstr("wanted a folder to write to"));
}

TEST_F(PlanCommand, TakesAwayTheFramesOfAnEarlierFilm) {
  REX_NEEDS_OSMESA();
  fs::create_directories(in("out/path"));
  for (const char* name : {"out/path/0000.png", "out/path/0001.png"}) std::ofstream(in(name)) << "x";
  ASSERT_EQ(planBoard({"--samples", "1"}).exitCode, 1);
  EXPECT_FALSE(fs::exists(in("out/path")));
  fs::create_directories(in("out/path"));
  std::ofstream(in("out/path/mine.txt")) << "x";
  ASSERT_EQ(planBoard({"--samples", "1"}).exitCode, 1);
  EXPECT_TRUE(fs::exists(in("out/path/mine.txt")));
}

// A ball 1 mm above a plate on a way that asks for more distances than are measured.
TEST_F(PlanCommand, SaysThatAClearanceIsNotProven) {
  REX_NEEDS_OSMESA();
  const fs::path file = scene(
      "body rail {} body ball { type=1 size=[0 0 0 .05] contact }\n"
      "body plate { X=<T t(0 0 -.101)> type=0 size=[3000 1 .1 0] contact }\n"
      "joint slide (rail ball) { type=transX limits=[-1000 1000] }\n");
  const ProcessResult result =
      plan({file.string(), "--start", "-900", "--goal", "900", "--margin", "0.0005", "--resolution", "1",
            "--step", "100", "--no-film", "--size", "64x48", "-o", "out"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.output, HasSubstr(" m all along the path is proven, 0.0010 m measured"));
  EXPECT_THAT(flat(result.error), HasSubstr("it is not proven that shapes stay apart"));
  EXPECT_THAT(flat(result.error), Not(HasSubstr("overlap")));
}

TEST_F(PlanCommand, WritesAMillionPosturesAtMost) {
  REX_NEEDS_OSMESA();
  const fs::path file = scene(
      "body rail {} body ball { type=1 size=[0 0 0 .05] contact }\n"
      "joint slide (rail ball) { type=transX limits=[0 100000] }\n");
  ASSERT_EQ(plan({file.string(), "--goal", "200", "--step", "100", "--resolution", "1", "--velocity", "0.01",
                  "--no-film", "--size", "64x48", "-o", "out"})
                .exitCode,
            0);
  const std::string table = fileText(in("out/path.csv"));
  const auto rows = std::count(table.begin(), table.end(), '\n');
  EXPECT_GT(rows, 999'000);
  EXPECT_LT(rows, 1'000'010);
}

// The trapezoid of a metre at 1 m/s, and at the limits that are asked for.
TEST_F(PlanCommand, IsAsFastAsLimitsAllow) {
  REX_NEEDS_OSMESA();
  const fs::path file = scene(
      "body rail {} body ball { type=1 size=[0 0 0 .05] contact mass=2 }\n"
      "joint slide (rail ball) { type=transZ limits=[0 10] }\n");
  const auto planned = [&](std::vector<std::string> options) {
    options.insert(options.begin(),
                   {file.string(), "--goal", "1", "--no-film", "--size", "64x48", "-o", "out"});
    return plan(options);
  };
  const ProcessResult result = planned({});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("\nduration   1.50"));
  EXPECT_THAT(result.output,
              HasSubstr(" s, at least 1.000 s from the velocity limits alone; no stop on the way\n"
                        "limits     velocities 1 rad/s or m/s; accelerations that reach them in 0.5 s\n"));
  EXPECT_THAT(flat(result.error),
              HasSubstr("no velocity limit for 'slide': assuming 1 rad/s or m/s, see --velocity"));
  const auto timing = [&](const std::vector<std::string>& options) {
    return nlohmann::json::parse(planned(options).output).at("timing");
  };
  const nlohmann::json faster = timing({"--velocity", "4", "--ramp", "0.125", "--json"});
  EXPECT_NEAR(timing({"--json"}).at("duration"), 1 + .5, 1e-2 * 1.5);
  EXPECT_NEAR(faster.at("duration"), .25 + .125, 1e-2 * .375);
  EXPECT_NEAR(faster.at("least_duration"), .25, 1e-9);
  EXPECT_EQ(faster.at("stops"), 0);
  EXPECT_EQ(faster.at("velocity_limits"), nlohmann::json({4.}));
  EXPECT_EQ(faster.at("acceleration_limits"), nlohmann::json({32.}));
  EXPECT_EQ(faster.at("assumed_velocities"), nlohmann::json({"slide"}));
  EXPECT_TRUE(faster.at("effort_limits").is_null());
  EXPECT_EQ(timing({"--effort", "--json"}).at("effort_limits"), nlohmann::json({nullptr}));
}

TEST_F(PlanCommand, SaysThatEffortsDoNotSuffice) {
  REX_NEEDS_OSMESA();
  std::ofstream(in("lift.urdf")) << R"(<robot name="lift"><link name="post"/><link name="load">
    <inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    <joint name="up" type="prismatic"><parent link="post"/><child link="load"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="2" effort="19" velocity="3"/></joint></robot>)";
  const auto planned = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"lift.urdf", "--goal", "1", "--no-film", "-o", "out"});
    return plan(options);
  };
  const ProcessResult weak = planned({"--effort"});
  EXPECT_EQ(weak.exitCode, 1) << weak.error;
  EXPECT_THAT(weak.output, HasSubstr("duration   none: no motion along the path: at s = "));
  EXPECT_THAT(weak.output, HasSubstr("the effort of 'up' is 19.62 even at rest, limit 19"));
  EXPECT_FALSE(fs::exists(in("out/path.csv")));
  const ProcessResult any = planned({});
  EXPECT_EQ(any.exitCode, 0) << any.error;
  EXPECT_THAT(any.output, HasSubstr("limits     velocities of the scene; accelerations"));
  EXPECT_THAT(any.error, Not(HasSubstr("no velocity limit")));
}

TEST_F(PlanCommand, StopsAtCornersThatAreNotSmoothed) {
  REX_NEEDS_OSMESA();
  const auto timing = [&](const std::vector<std::string>& words) {
    return nlohmann::json::parse(planBoard(words).output).at("timing");
  };
  const nlohmann::json smooth = timing({"--json"}), rough = timing({"--no-smooth", "--json"});
  EXPECT_GT(rough.at("stops"), 2);
  EXPECT_LT(smooth.at("stops"), rough.at("stops"));
  EXPECT_LT(smooth.at("duration"), .7 * rough.at("duration").get<double>());
}

TEST_F(PlanCommand, StaysWhereItIs) {
  REX_NEEDS_OSMESA();
  const ProcessResult result = plan(
      {"board", "--start", kGoal, "--goal", kGoal, "--no-film", "--json", "--size", "64x48", "-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_EQ(nlohmann::json::parse(result.output).at("runs")[0].at("planned_length"), 0);
}

TEST_F(PlanCommand, DoesWhatItsExamplesSay) {
  REX_NEEDS_OSMESA();
  const auto examples = examplesOf("plan");
  EXPECT_EQ(examples.size(), 5u);
  for (std::vector<std::string> example : examples) {
    example.insert(example.end(), {"--no-film", "--size", "64x48"});
    const ProcessResult result = rex(example);
    EXPECT_EQ(result.exitCode, 0) << result.error;
  }
}

}  // namespace rex::cli::plan_test
