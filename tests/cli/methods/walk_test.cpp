// `rex walk` as a user meets it.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "support/file_text.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"
#include "support/rounds.h"

namespace rex::cli::walk_test {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class WalkCommand : public RexCommand {
 protected:
  void expectRefusal(std::vector<std::string> arguments, const std::string& message) const {
    arguments.insert(arguments.begin(), "walk");
    const ProcessResult result = rex(arguments);
    EXPECT_EQ(result.exitCode, 64) << message;
    EXPECT_THAT(flat(result.error), HasSubstr(message));
  }
};

TEST_F(WalkCommand, WalksAndWritesWhatItMeasured) {
  REX_NEEDS_GNUPLOT();
  std::vector<std::string> words{"walk", "--steps", "1", "--length", "0", "--json", "-o", "out"};
  if (!isLongRun()) words.push_back("--no-film");
  const ProcessResult result = rex(words);
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const json answer = json::parse(result.output), run = answer["runs"][0];
  EXPECT_EQ(answer["steps"], 1);
  EXPECT_EQ(run["seed"], 0);
  EXPECT_EQ(run["falls"], false);
  EXPECT_NEAR(run["seconds"], 4.3, 1e-6);
  EXPECT_LT(run["capture_point"], .02);
  EXPECT_LT(run["zmp"], .02);
  EXPECT_LT(run["effort"], .8);
  EXPECT_THAT(fileText(in("out/walk.csv")), StartsWith("time,zmp_x,zmp_y,planned_x"));
  for (const char* file : {"out/zmp.png", "out/zmp_time.png"})
    EXPECT_GT(fs::file_size(in(file)), 1000u) << file;
  EXPECT_EQ(fs::exists(in("out/walk_sheet.png")), isLongRun());
}

TEST_F(WalkCommand, SaysThatItFell) {
  const std::vector<std::string> words{"walk",      "--steps", "1",      "--push", "0,200",
                                       "--push-at", "0.2",     "--seed", "3"};
  const ProcessResult result = rex(words);
  EXPECT_EQ(result.exitCode, 1) << result.error;
  EXPECT_THAT(result.output, StartsWith("seed     walked capture point  ZMP [m rms]   effort\n3 "));
  EXPECT_THAT(result.output, HasSubstr("falls at "));
  EXPECT_EQ(rex(words).output, result.output) << "same seed, same bytes";
}

TEST_F(WalkCommand, SaysWhatIsWrong) {
  expectRefusal({"--steps", "0"}, "--steps: found 0, wanted 1 to 100");
  expectRefusal({"--length", "1"}, "--length: found 1, wanted -0.3 to 0.4");
  expectRefusal({"--unevenness", "-1"}, "--unevenness: found -1, wanted 0 to 0.05");
  expectRefusal({"--push", "0,2000"}, "--push: found 2000, wanted -1000 to 1000");
  expectRefusal({"--push", "1,0", "--push-at", "-1"}, "--push-at: found -1, wanted 0 to ");
  expectRefusal({"--steps", "1", "--push", "1,0", "--push-at", "150"},
                "--push-at: found 150, wanted 0 to 4.2");
  expectRefusal({"--push-at", "2"}, "--push-at: found no push, wanted --push or --largest-push with it");
  expectRefusal({"--seeds", "0"}, "--seeds: found 0, wanted 1 to 1000");
  expectRefusal({"--no-film"}, "--no-film: found no effect on its own, wanted -o with it");
  expectRefusal({"--push", "1,0", "--largest-push"},
                "--largest-push: found --push beside it, wanted one of them");
}

}  // namespace rex::cli::walk_test
