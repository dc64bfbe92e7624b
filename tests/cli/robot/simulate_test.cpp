// `rex simulate` as a user meets it.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "render/png.h"
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
    const ProcessResult result = simulate(arguments);
    EXPECT_EQ(result.exitCode, 64) << message;
    EXPECT_THAT(flat(result.error), HasSubstr(message));
    EXPECT_FALSE(fs::exists(in("out"))) << message;
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
  expectRefusal({"--tau", "0"}, "--tau: found 0, wanted 1e-06 to 1");
  expectRefusal({"--tau", "nan"}, "--tau: found nan");
  expectRefusal({"--seconds", "-1"}, "--seconds: found -1, wanted 1e-06 to 120");
  expectRefusal({"--seconds", "0.01", "--tau", "0.1"},
                "--seconds / --tau, steps: found 0.1, wanted 1 to 200000");
  expectRefusal({"--seconds", "100", "--tau", "1e-5"}, "--seconds / --tau, steps: found 1e+07");
  expectRefusal({"--speed", "1001"}, "--speed: found 1001, wanted 0.001 to 1000");
  expectRefusal({"--noise", "-1"}, "--noise: found -1, wanted 0 to 1e+06");
  expectRefusal({"--engine", "rk5"}, "--engine: found 'rk5', wanted rk4, beeman, leapfrog");
  expectRefusal({"--engine", "bulet"}, "did you mean 'bullet'?");
  expectRefusal({"--engine", "bullet", "--noise", "1"},
                "--noise: found --engine bullet, wanted another engine");
  expectRefusal({"--floor", "0"},
                "--floor: found --engine rk4, wanted --engine bullet, which knows contacts");
  expectRefusal({"--floor", "nan", "--engine", "bullet"}, "--floor: found nan, wanted -1000 to 1000");
  expectRefusal({"--trace", "pge"}, "--trace: scene 'pegArm.ors' has no body 'pge' (did you mean 'peg'?)");
  expectRefusal({"--q", "1,2"}, "--q: found 2 numbers, wanted 3");
  expectRefusal({"--v", "1,2"}, "--v: found 2 numbers, wanted 3");
  expectRefusal({"--v", "0,inf,0"}, "--v: found 'inf', wanted a number");
  expectRefusal({"--size", "0x0"}, "--size: found '0x0'");
  expectRefusal({"--camera", "frnt"}, "did you mean 'front'?");
  std::ofstream(in("still.ors")) << "body a { type=ST_box size=[1 1 1 0] mass=1 }";
  EXPECT_THAT(flat(simulate({"still.ors", "-o", "out"}).error),
              HasSubstr("still.ors: found no joint that moves"));
}

TEST_F(SimulateCommand, RefusesAFilmThatShowsNothing) {
  std::ofstream(in("bare.ors"))
      << "body a { mass=1 } body b { mass=1 } joint (a b) { type=hingeX B=<T t(0 0 1)> }\n";
  const ProcessResult result = simulate({"bare.ors", "-o", "out"});
  EXPECT_EQ(result.exitCode, 64);
  EXPECT_THAT(flat(result.error), HasSubstr("found no shape that a film could show, wanted --no-film"));
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

TEST_F(SimulateCommand, ReportsABlowUpAndWritesNothing) {
  const std::vector<std::string> words = {"--engine", "euler",           "--tau",     "1",
                                          "--v",      "1000,-1000,1000", "--seconds", "100"};
  expectRefusal(words, "joint '");
  expectRefusal(words, " s");
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
