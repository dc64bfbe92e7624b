// `rex slam` as a user meets it.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "estimation/g2o_file.h"
#include "support/paths.h"

namespace rex::cli::slam_test {

using ::testing::HasSubstr;

class SlamCommand : public RexCommand {
 protected:
  std::string example() const { return (homeFolder() / "data/graphs/streets.g2o").string(); }
  std::string write(const std::string& text) const {
    const std::string file = in("map.g2o").string();
    std::ofstream(file) << text;
    return file;
  }
};

TEST_F(SlamCommand, FitsTheMap) {
  const std::string out = in("better.g2o").string(), plot = in("map.png").string();
  const ProcessResult result = rex({"slam", example(), "-o", out, "--plot", plot, "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const nlohmann::json json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json["poses"], 400);
  EXPECT_EQ(json["status"], "converged");
  EXPECT_GT(json["initial_cost"].get<double>(), 10 * json["cost"].get<double>());
  EXPECT_GE(json["seconds"].get<double>(), 0);
  const auto better = std::get<PlanarPoseGraph>(readG2o(out).graph);
  EXPECT_EQ(json["edges"], better.edges.size());
  EXPECT_NEAR(poseGraphCost(better), json["cost"].get<double>(), 1e-9 * json["cost"].get<double>());
  EXPECT_GT(std::filesystem::file_size(plot), 5000u);

  const ProcessResult sesync = rex({"slam", example(), "--objective", "sesync", "--start", "file", "--json"});
  ASSERT_EQ(sesync.exitCode, 0) << sesync.error;
  auto graph = std::get<PlanarPoseGraph>(readG2o(example()).graph);
  const PoseGraphResult own = optimize(graph, {.objective = PoseGraphObjective::kSESync});
  EXPECT_NEAR(nlohmann::json::parse(sesync.output)["cost"].get<double>(), own.cost, 1e-9 * own.cost);
}

TEST_F(SlamCommand, SaysWhatItDidAndWhenItDidNot) {
  const ProcessResult full =
      rex({"slam", example(), "--start", "odometry", "--kernel", "huber", "--kernel-size", "3"});
  EXPECT_EQ(full.exitCode, 0) << full.error;
  EXPECT_THAT(full.output, HasSubstr("400 poses, 438 edges; converged after"));
  const ProcessResult spent = rex({"slam", example(), "--iterations", "1", "--start", "file"});
  EXPECT_EQ(spent.exitCode, 1);
  EXPECT_THAT(spent.output, HasSubstr("stopped after 1 iteration, the limit, before it converged"));
}

TEST_F(SlamCommand, PlacesLandmarks) {
  const std::string file = write(
      "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 0 5 1 1 1 0 1\nEDGE_SE2_XY 1 5 0 1.2 1 0 1\nVERTEX_X 3\n");
  const std::string plot = in("map.svg").string();
  const ProcessResult result = rex({"slam", file, "--plot", plot});
  EXPECT_EQ(result.exitCode, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("2 poses, 1 landmark, 1 edge, 2 sightings; converged after"));
  EXPECT_THAT(flat(result.error), HasSubstr("map.g2o:4:1: warning: VERTEX_X: not a tag that rex reads"));
  EXPECT_GT(std::filesystem::file_size(plot), 1000u);
  const nlohmann::json json = nlohmann::json::parse(rex({"slam", file, "--json"}).output);
  EXPECT_EQ(json["landmarks"], 1);
  EXPECT_EQ(json["sightings"], 2);
}

TEST_F(SlamCommand, HasExamplesThatRun) {
  const auto examples = examplesOf("slam");
  EXPECT_EQ(examples.size(), 2u);
  for (const auto& words : examples) EXPECT_EQ(rex(words).exitCode, 0);
}

TEST_F(SlamCommand, SaysWhatIsWrong) {
  const auto expect = [&](std::vector<std::string> words, const char* text) {
    words.insert(words.begin(), "slam");
    const ProcessResult result = rex(words);
    EXPECT_EQ(result.exitCode, 64) << result.error;
    EXPECT_THAT(flat(result.error), HasSubstr(text));
  };
  expect({}, "file is required");
  expect({"none.g2o"}, "none.g2o: pose graph: found a file that cannot be read");
  expect({example(), "--objective", "chi"},
         "--objective: found 'chi', wanted chi2, sesync (did you mean 'chi2'?)");
  expect({example(), "--kernel", "hubber"}, "--kernel: found 'hubber'");
  expect({example(), "--start", "chord"}, "--start: found 'chord'");
  expect({example(), "--kernel-size", "0"}, "--kernel-size: found 0");
  expect({example(), "--iterations", "-1"}, "--iterations: found -1");
  expect({example(), "--plot", "map.jpg"}, "--plot: found 'map.jpg', wanted a .png or .svg file");
  expect({write("EDGE_SE2 0 1 1 0 0 1 0 0 1 0\n")}, "map.g2o:1:28: EDGE_SE2: found 10 numbers, wanted 11");
  expect(
      {write("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_SE2 2 0 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n")},
      "map.g2o:3:12: pose graph: found pose 2, which no edges join to pose 0");
}

}  // namespace rex::cli::slam_test
