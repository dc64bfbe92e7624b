// `rex simulate` as a user meets it.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "render/image.h"
#include "support/file_text.h"
#include "support/film_length.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"

namespace rex::cli::simulate_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class SimulateCommand : public RexCommand {
 protected:
  ProcessResult simulate(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "simulate");
    return rex(arguments);
  }
  void expectRefusal(std::vector<std::string> arguments, const std::string& message) const {
    arguments.insert(arguments.begin(), {"pegArm.ors", "-o", "out"});
    expectRefused(simulate(arguments), message);
  }
};

TEST_F(SimulateCommand, WritesALogAPlotAndASummary) {
  REX_NEEDS_GNUPLOT();
  const ProcessResult result =
      simulate({"pegArm", "--seconds", "0.5", "--v", "0,1,0", "--no-film", "-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("pegArm, free, rk4, steps of 1 ms: 500 steps, 0.5 s"));
  EXPECT_THAT(result.output, HasSubstr("arm2>peg"));
  EXPECT_THAT(result.output, HasSubstr("out/log.csv\nout/energy.png\nout/energy.svg\n"));
  const std::string log = fileText(in("out/log.csv"));
  EXPECT_THAT(log, StartsWith("time,q0,q1,q2,v0,v1,v2,kinetic,potential,total\n0,"));
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 502);
  EXPECT_GE(readPng(in("out/energy.png")).width, 800);
  EXPECT_THAT(fileText(in("out/energy.svg")), HasSubstr("kinetic"));
  EXPECT_FALSE(fs::exists(in("out/simulate.mp4")));
}

TEST_F(SimulateCommand, MakesAFilm) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  if (!runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "needs the package ffmpeg";
  const ProcessResult result = simulate({"pegArm", "--seconds", "0.2", "--hold", "--trace", "peg", "--camera",
                                         "front", "--size", "64x48", "-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("out/simulate.mp4\n"));
  EXPECT_GT(fs::file_size(in("out/simulate.mp4")), 500u);
}

TEST_F(SimulateCommand, FilmsAsFastAsAskedFor) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  if (!runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "needs the package ffmpeg";
  for (const auto& [speed, frames] : {std::pair("1", "7,30/1"), {"0.5", "13,30/1"}, {"2", "4,30/1"}}) {
    ASSERT_EQ(
        simulate({"pegArm", "--seconds", "0.2", "--speed", speed, "--size", "64x48", "-o", "out"}).exitCode,
        0);
    EXPECT_EQ(framesOf(in("out/simulate.mp4")), frames) << speed;
  }
}

TEST_F(SimulateCommand, AnswersPrograms) {
  REX_NEEDS_GNUPLOT();
  const auto answer = [&](const std::string& engine) {
    const ProcessResult result = simulate({"pegArm", "--engine", engine, "--seconds", "0.5", "--tau", "0.01",
                                           "--no-film", "--json", "-o", "out"});
    EXPECT_EQ(result.exitCode, 0) << result.error;
    return nlohmann::json::parse(result.output);
  };
  const nlohmann::json rk4 = answer("rk4");
  EXPECT_EQ(rk4.at("steps"), 50);
  EXPECT_EQ(rk4.at("q").size(), 3u);
  EXPECT_EQ(rk4.at("files").size(), 3u);
  EXPECT_LT(rk4.at("energy").at("largest_change"), 1e-4);
  for (const char* engine : {"beeman", "leapfrog", "semi-implicit", "euler", "bullet"}) {
    const nlohmann::json other = answer(engine);
    EXPECT_EQ(other.at("engine"), engine);
    EXPECT_NE(other.at("q"), rk4.at("q"));
    EXPECT_NEAR(other.at("q")[0].get<double>(), rk4.at("q")[0].get<double>(), 0.1) << engine;
  }
}

TEST_F(SimulateCommand, WritesTheSameTwice) {
  REX_NEEDS_GNUPLOT();
  for (const char* out : {"a", "b"})
    ASSERT_EQ(simulate({"pegArm", "--seconds", "0.2", "--noise", "0.3", "--seed", "7", "--friction",
                        "--no-film", "-o", out})
                  .exitCode,
              0);
  EXPECT_EQ(fileText(in("a/log.csv")), fileText(in("b/log.csv")));
  EXPECT_EQ(fileText(in("a/energy.svg")), fileText(in("b/energy.svg")));
  ASSERT_EQ(simulate({"pegArm", "--seconds", "0.2", "--noise", "0.3", "--seed", "8", "--no-film", "-o", "c"})
                .exitCode,
            0);
  EXPECT_NE(fileText(in("a/log.csv")), fileText(in("c/log.csv")));
}

TEST_F(SimulateCommand, RefusesWhatItCannotSimulate) {
  EXPECT_THAT(flat(simulate({"pegArm", "-o", "a.mp4"}).error),
              HasSubstr("-o a.mp4: found the name of a file, wanted a folder, which gets simulate.mp4, or a "
                        "page NAME.html"));
  const std::vector<std::pair<std::vector<std::string>, const char*>> messages = {
      {{"--seconds", "0.01", "--tau", "0.1"}, "--seconds / --tau, steps: found 0.1, wanted 1 to 200000"},
      {{"--seconds", "100", "--tau", "1e-5"}, "--seconds / --tau, steps: found 10000000"},
      {{"--engine", "bullet", "--noise", "1"}, "--noise: found --engine bullet, wanted another engine"},
      {{"--floor", "0"}, "--floor: found --engine rk4, wanted --engine bullet, which handles contacts"},
      {{"--refuse-overlap"},
       "--refuse-overlap: found --engine rk4, wanted --engine bullet, which handles contacts"},
      {{"--hold-by", "motor"}, "--hold-by motor: found --engine rk4, wanted --engine bullet"},
      {{"--trace", "pge"}, "--trace: scene 'pegArm.ors' has no body 'pge' (did you mean 'peg'?)"},
      {{"--q", "1,2"}, "--q: found 2 numbers, wanted 3"},
      {{"--v", "1,2"}, "--v: found 2 numbers, wanted 3"},
      {{"--v", "0,inf,0"}, "--v: found 'inf', wanted a number"},
      {{"--size", "0x0"}, "--size: found '0x0'"},
      {{"--camera", "frnt"}, "did you mean 'front'?"},
  };
  for (const auto& [words, message] : messages) expectRefusal(words, message);
  std::ofstream(in("still.ors")) << "body a { type=ST_box size=[1 1 1 0] mass=1 }";
  EXPECT_THAT(flat(simulate({"still.ors", "-o", "out"}).error),
              HasSubstr("still.ors: found no joint that moves"));
}

TEST_F(SimulateCommand, RefusesAFilmThatShowsNothing) {
  std::ofstream(in("bare.ors"))
      << "body a { mass=1 } body b { mass=1 } joint (a b) { type=hingeX B=<T t(0 0 1)> }\n";
  const ProcessResult result = simulate({"bare.ors", "-o", "out"});
  EXPECT_EQ(result.exitCode, 64);
  EXPECT_THAT(flat(result.error), HasSubstr("found no shape that a film can show, wanted --no-film"));
  EXPECT_FALSE(fs::exists(in("out")));
}

// A ball of radius 0.1 m, dropped from 1 m.
TEST_F(SimulateCommand, LaysAFloor) {
  REX_NEEDS_GNUPLOT();
  std::ofstream(in("ball.ors")) << "body post {}\nbody ball { type=1 size=[0 0 0 0.1] mass=1 contact }\n"
                                   "joint fall (post ball) { type=transZ A=<T t(0 0 1)> }\n";
  const auto fallOfASecond = [&](std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"ball.ors", "--engine", "bullet", "--seconds", "1", "--no-film", "--json", "-o", "out"});
    const ProcessResult result = simulate(options);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    return nlohmann::json::parse(result.output).at("q").at(0).get<double>();
  };
  EXPECT_NEAR(fallOfASecond({"--floor", "0.5"}), -0.4, 0.01);
  EXPECT_NEAR(fallOfASecond({}), -9.81 / 2, 0.01);
}

// Balls of MuJoCo that may not touch each other, but the floor. They fell through it, both at -3.9 m.
TEST_F(SimulateCommand, LaysAFloorForModelsOfMujoco) {
  REX_NEEDS_GNUPLOT();
  std::ofstream(in("balls.xml"))
      << "<mujoco><default><geom contype='1' conaffinity='0' size='.1'/></default><worldbody>"
         "<body pos='0 0 1'><freejoint/><geom/></body><body pos='1 0 1'><freejoint/><geom/></body>"
         "</worldbody></mujoco>";
  const ProcessResult result = simulate({"balls.xml", "--engine", "bullet", "--seconds", "1", "--no-film",
                                         "--floor", "0", "--json", "-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const nlohmann::json q = nlohmann::json::parse(result.output).at("q");
  EXPECT_NEAR(q.at(2).get<double>(), 0.1, 1e-4);
  EXPECT_NEAR(q.at(9).get<double>(), 0.1, 1e-4);
}

// A dog on a free base, dropped on a floor: it falls, and then its motors hold it up.
TEST_F(SimulateCommand, HoldsAFallenDogUpright) {
  REX_NEEDS_GNUPLOT();
  const auto drop = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"quadruped", "--free-base", "--engine", "bullet", "--floor", "-0.9",
                                     "--seconds", "2.5", "--no-film", "--json", "-o", "out"});
    const ProcessResult result = simulate(options);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    return nlohmann::json::parse(result.output);
  };
  const nlohmann::json held = drop({"--hold"}), loose = drop({});
  EXPECT_EQ(held.at("held"), true);
  const auto z = [](const nlohmann::json& answer) { return answer.at("q").at(2).get<double>(); };
  EXPECT_LT(z(held), -0.2);
  EXPECT_GT(z(held), z(loose) + 0.05);
  EXPECT_GT(std::abs(held.at("q").at(3).get<double>()), 0.99);
  for (const nlohmann::json& v : held.at("v")) EXPECT_LT(std::abs(v.get<double>()), 0.05);
}

TEST_F(SimulateCommand, LogsEachNthStepAsTextOrNumbers) {
  REX_NEEDS_GNUPLOT();
  const auto log = [&](const std::vector<std::string>& options, const std::string& name) {
    std::vector<std::string> words{"pegArm", "--seconds", "0.01", "--no-film", "-o", "out"};
    words.insert(words.end(), options.begin(), options.end());
    const ProcessResult result = simulate(words);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    EXPECT_THAT(result.output, HasSubstr("out/" + name + "\n"));
    EXPECT_FALSE(fs::exists(in("out/" + name + ".part")));
    return fileText(in("out/" + name));
  };
  const std::string every = log({}, "log.csv"), some = log({"--log-every", "4"}, "log.csv");
  EXPECT_EQ(std::count(every.begin(), every.end(), '\n'), 12);
  EXPECT_EQ(std::count(some.begin(), some.end(), '\n'), 4);
  EXPECT_THAT(some, HasSubstr("\n0.004,"));
  EXPECT_THAT(every, HasSubstr(some.substr(some.rfind("\n0.008,"))));

  const std::string matrix = log({"--log-every", "4", "--log-format", "npy"}, "log.npy");
  EXPECT_THAT(matrix, StartsWith(std::string("\x93NUMPY\x01\x00", 8)));
  const std::size_t head =
      10 + static_cast<unsigned char>(matrix[8]) + 256u * static_cast<unsigned char>(matrix[9]);
  EXPECT_EQ(head % 64, 0u);
  EXPECT_THAT(matrix.substr(0, head),
              HasSubstr("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 10), }"));
  ASSERT_EQ(matrix.size(), head + 3 * 10 * sizeof(double));
  std::vector<double> numbers(30);
  std::memcpy(numbers.data(), matrix.data() + head, matrix.size() - head);
  std::string line;
  for (int i = 20; i < 30; ++i)
    line += fmt::format("{}{}", i == 20 ? "\n" : ",", numbers[static_cast<std::size_t>(i)]);
  EXPECT_THAT(some, HasSubstr(line + "\n"));
}

TEST_F(SimulateCommand, LeavesAnOlderLogIfItFails) {
  fs::create_directories(in("out"));
  std::ofstream(in("out/log.csv")) << "old";
  const std::vector<std::string> words = {"pegArm",    "--tau", "1",  "--v", "1e9,-1e9,1e9",
                                          "--seconds", "100",   "-o", "out"};
  EXPECT_EQ(simulate(words).exitCode, 64);
  EXPECT_EQ(fileText(in("out/log.csv")), "old");
  EXPECT_FALSE(fs::exists(in("out/log.csv.part")));
  std::vector<std::string> deeper = words;
  deeper.back() = "new/deep/er";
  EXPECT_EQ(simulate(deeper).exitCode, 64);
  EXPECT_FALSE(fs::exists(in("new")));
}

TEST_F(SimulateCommand, StopsWhereTheEnergyGrows) {
  REX_NEEDS_GNUPLOT();
  const std::vector<std::string> words = {"pegArm", "--engine",  "euler", "--tau",     "0.05", "--v",
                                          "0,3,0",  "--seconds", "60",    "--no-film", "-o",   "out"};
  const ProcessResult result = simulate(words);
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(flat(result.error),
              ::testing::ContainsRegex("stopped at [0-9.]+ s: the energy has grown by [0-9.]+ J"));
  const std::string log = fileText(in("out/log.csv"));
  std::vector<std::string> json = words;
  json.push_back("--json");
  const nlohmann::json said = nlohmann::json::parse(simulate(json).output);
  EXPECT_GT(said.at("stopped").at("gained"), 2 * said.at("stopped").at("given").get<double>());
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 2 + said.at("steps").get<int>());
  const std::string last = log.substr(log.rfind('\n', log.size() - 2) + 1);
  EXPECT_NEAR(std::stod(last), said.at("stopped").at("time").get<double>() + 0.05, 1e-9);
}

TEST_F(SimulateCommand, SaysWhatCannotBeWritten) {
  std::ofstream(in("plain")) << "a file";
  fs::create_directories(in("out/log.csv.part"));
  fs::create_directories(in("other/log.csv/deep"));
  EXPECT_THAT(flat(simulate({"pegArm", "--no-film", "-o", "plain/sub"}).error),
              HasSubstr("cannot write plain/sub/log.csv: found Not a directory"));
  EXPECT_THAT(flat(simulate({"pegArm", "--no-film", "-o", "out"}).error),
              HasSubstr("cannot write out/log.csv: found Is a directory"));
  EXPECT_THAT(flat(simulate({"pegArm", "--seconds", "0.01", "--no-film", "-o", "other"}).error),
              HasSubstr("cannot write other/log.csv: found Is a directory"));
  EXPECT_FALSE(fs::exists(in("other/log.csv.part")));
}

TEST_F(SimulateCommand, WritesAReplayInsteadOfAFolder) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  const ProcessResult result =
      simulate({"pegArm", "--seconds", "0.5", "--speed", "0.5", "-o", "new/fall.html"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("\nnew/fall.html\n"));
  ASSERT_TRUE(fs::is_regular_file(in("new/fall.html")));
  EXPECT_NEAR(replaySeconds(in("new/fall.html")), 1, 1e-4);
  const std::string page = fileText(in("new/fall.html"));
  EXPECT_TRUE(page.find("<figure>") != std::string::npos);
  EXPECT_TRUE(page.find("<td>rk4</td>") != std::string::npos);
  EXPECT_FALSE(fs::exists(in("new/log.csv")));
  const ProcessResult refused = simulate({"pegArm", "--no-film", "-o", "no.html"});
  EXPECT_EQ(refused.exitCode, 64);
  EXPECT_THAT(flat(refused.error),
              HasSubstr("--no-film: found a page, which is a film itself, wanted a folder"));
  EXPECT_THAT(flat(simulate({"pegArm", "--log-every", "2", "-o", "no.html"}).error),
              HasSubstr("--log-every: found a page, which has no log, wanted a folder after -o"));
  EXPECT_THAT(flat(simulate({"pegArm", "--log-format", "npy", "-o", "no.html"}).error),
              HasSubstr("--log-format: found a page, which has no log, wanted a folder after -o"));
}

// The weight of the arm, and then three newton metres more on one joint.
TEST_F(SimulateCommand, DrivesJointsByAFileOfTorques) {
  REX_NEEDS_GNUPLOT();
  std::ofstream(in("push.csv")) << "# a push\ntime, arm2>peg\n0, 0\n0.1, 3\n";
  const auto run = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"pegArm",    "--hold-by", "gravity", "--seconds", "0.2",
                                   "--no-film", "--json",    "-o",      "out"};
    words.insert(words.end(), options.begin(), options.end());
    const ProcessResult result = simulate(words);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    return nlohmann::json::parse(result.output).at("q");
  };
  const nlohmann::json held = run({}), pushed = run({"--torques", "push.csv"});
  EXPECT_GT(std::abs(pushed[2].get<double>() - held[2].get<double>()), 1e-4);
}

TEST_F(SimulateCommand, NamesThePlaceInAFileOfTorques) {
  const auto expect = [&](const std::string& text, const std::string& message) {
    std::ofstream(in("u.csv")) << text;
    const ProcessResult result = simulate({"claw.ors", "--torques", "u.csv", "-o", "out"});
    EXPECT_EQ(result.exitCode, 64) << text;
    EXPECT_THAT(flat(result.error), HasSubstr(message)) << text;
    EXPECT_FALSE(fs::exists(in("out")));
  };
  std::ofstream(in("claw.ors")) << "body base { mass=1 type=ST_box size=[1 1 1 0] }\n"
                                   "body left { mass=1 } body right { mass=1 } body eye { mass=1 }\n"
                                   "body stone { mass=1 } body post {}\n"
                                   "joint finger (base left) { type=transX }\n"
                                   "joint thumb (base right) { type=transX mimic=finger }\n"
                                   "joint look (base eye) { type=universal }\n"
                                   "joint fly (post stone) { type=free }\n";
  expect("", "u.csv: torques: found no line of column names, wanted 'time', then names of joints");
  expect("time,finger\n", "u.csv: torques: found no row of numbers, wanted a time and torques");
  expect("t,finger\n", "u.csv:1:1: torques: first column: found 't', wanted 'time'");
  expect("time\n", "u.csv:1:1: torques: found no joint after 'time'");
  expect(
      "# u\ntime,finger, fnger\n",
      "u.csv:2:14: torques: found 'fnger', wanted a joint of claw.ors with a motor (did you mean 'finger'?)");
  expect("time,thumb\n",
         "u.csv:1:6: torques: joint 'thumb': found a joint that mimics another, wanted 'finger', whose");
  expect("time,fly\n", "u.csv:1:6: torques: joint 'fly': found a free joint, wanted joints with a motor");
  expect("time,fly [2]\n", "u.csv:1:6: torques: found 'fly [2]', wanted a joint of claw.ors with a motor");
  expect("time,look\n",
         "u.csv:1:6: torques: joint 'look': found 2 coordinates, wanted 'look [0]' or another");
  expect("time,finger,finger\n", "u.csv:1:13: torques: found 'finger' twice, wanted a column per joint");
  expect("time,finger\n0,1,2\n", "u.csv:2:1: torques: found 3 numbers, wanted 2 as in line 1");
  expect("time,finger\n0\n", "u.csv:2:1: torques: found 1 number, wanted 2 as in line 1");
  expect("time,\"finger\",look [1]\n0,1, 1x\n", "u.csv:2:6: torques: found '1x', wanted a number");
  expect("time,finger\n0,nan\n", "u.csv:2:3: torques: found 'nan', wanted a number");
  expect("time,finger\n-1,0\n", "u.csv:2:1: torques: time: found -1, wanted 0 or later");
  expect("time,finger\n1,0\n1,2\n", "u.csv:3:1: torques: time: found 1 after 1, wanted times that increase");
  std::ofstream(in("u.csv")) << "time,finger\n0,1\n";
  EXPECT_THAT(flat(simulate({"claw.ors", "--torques", "u.csv", "--engine", "bullet", "--hold-by", "motor",
                             "-o", "out"})
                       .error),
              HasSubstr("--torques: found joints that are held by motors, wanted no --hold, or --hold-by"));
  EXPECT_THAT(flat(simulate({"claw.ors", "--torques", "none.csv", "-o", "out"}).error),
              HasSubstr("none.csv: cannot read the torques"));
}

TEST_F(SimulateCommand, SaysWhatIsInOverlapAtFirst) {
  REX_NEEDS_GNUPLOT();
  std::ofstream(in("heap.ors")) << "body post {}\n"
                                   "body pole {}\n"
                                   "body a { type=ST_box size=[0.2 0.2 0.2 0] mass=1 contact }\n"
                                   "body b { type=ST_box size=[0.2 0.2 0.2 0] mass=1 contact }\n"
                                   "joint one (post a) { type=free A=<T t(0 0 0.05)> }\n"
                                   "joint two (pole b) { type=free A=<T t(0.15 0 0.1)> }\n";
  const std::vector<std::string> words{"heap.ors", "--engine",  "bullet", "--floor", "0",  "--seconds",
                                       "0.5",      "--no-film", "--json", "-o",      "out"};
  const ProcessResult result = simulate(words);
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(flat(result.error),
              HasSubstr("overlaps at the start, pushed apart at 1 m/s at most, 2 pairs: "));
  EXPECT_THAT(flat(result.error), HasSubstr("'a' and 'b' by 0.05 m"));
  EXPECT_THAT(flat(result.error), HasSubstr("'floor' and 'a' by 0.05 m"));
  const nlohmann::json answer = nlohmann::json::parse(result.output);
  EXPECT_EQ(answer.at("overlaps").size(), 2u);
  for (const nlohmann::json& v : answer.at("v")) EXPECT_LT(std::abs(v.get<double>()), 3);
  std::vector<std::string> strict = words;
  strict.insert(strict.end(), {"--refuse-overlap", "-o", "strict"});
  strict.erase(strict.begin() + 9, strict.begin() + 11);
  const ProcessResult refused = simulate(strict);
  EXPECT_EQ(refused.exitCode, 64);
  EXPECT_THAT(flat(refused.error), HasSubstr("--refuse-overlap: found overlaps at the start, 2 pairs: "));
  EXPECT_FALSE(fs::exists(in("strict")));
}

// Fingers of which one mimics the other, ten seconds in the hands of gravity and Bullet.
TEST_F(SimulateCommand, MovesWhatMimics) {
  REX_NEEDS_GNUPLOT();
  std::ofstream(in("claw.ors"))
      << "body base {} body hand { mass=1 } body left { mass=0.1 } body right { mass=0.1 }\n"
         "joint wrist (base hand) { type=hingeY B=<T t(0 0 -0.3)> }\n"
         "joint finger (hand left) { type=transX limits=[-0.02 0.02] }\n"
         "joint thumb (hand right) { type=transX mimic=finger mimic_ratio=-1 }\n";
  std::ofstream(in("u.csv")) << "time,finger\n0,-5\n5,5\n";
  const ProcessResult result =
      simulate({"claw.ors", "--engine", "bullet", "--seconds", "10", "--q", "wrist=1", "--torques", "u.csv",
                "--no-film", "--json", "-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_NEAR(nlohmann::json::parse(result.output).at("q").at(1).get<double>(), 0.02, 1e-3);
}

TEST_F(SimulateCommand, RefusesAMotionFasterThanLight) {
  expectRefusal({"--v", "1e9,-1e9,1e9"}, "joint '");
  expectRefusal({"--v", "1e9,-1e9,1e9"}, " s");
}

TEST_F(SimulateCommand, NamesTheBodyWithoutMass) {
  std::ofstream(in("light.ors")) << "body a { mass=1 }\nbody b { }\njoint turn (a b) { }\n";
  const ProcessResult result = simulate({"light.ors", "--no-film", "-o", "out"});
  EXPECT_EQ(result.exitCode, 64) << result.error;
  EXPECT_THAT(flat(result.error), HasSubstr("'b'"));
  EXPECT_FALSE(fs::exists(in("out")));
}

TEST_F(SimulateCommand, DoesWhatItsExamplesSay) {
  REX_NEEDS_GNUPLOT();
  const auto examples = examplesOf("simulate");
  EXPECT_GE(examples.size(), 3u);
  for (std::vector<std::string> example : examples) {
    example.push_back("--no-film");
    const ProcessResult result = rex(example);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    EXPECT_TRUE(fs::exists(in(example.end()[-2] + "/energy.png")));
  }
}

}  // namespace rex::cli::simulate_test
