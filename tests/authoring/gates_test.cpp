#include "authoring/gates.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace rex::authoring::gates_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

class DeadNamesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write("src/course/simulator.h", "class Simulator { void jacobianPos(); };  // ghost\n");
    write("exercises/01-demo/exercise.h", "Eigen::VectorXd ikStep(const Eigen::VectorXd& q0);\n");
    write("exercises/01-demo/main.cpp", "int main() { showWay(); }\n");
    write("exercises/01-demo/show.cpp", "void showWay() { plot(\"error\"); }\n");
    write("share/doc/style.md", "");
  }
  void write(const std::string& name, const std::string& text) {
    fs::create_directories((temporary_.path() / name).parent_path());
    std::ofstream(temporary_.path() / name) << text;
  }
  std::vector<std::string> dead(const std::string& readme, const std::string& solution = "") {
    write("exercises/01-demo/README.md", readme);
    write("exercises/01-demo/solution.cpp", solution);
    places_.clear();
    std::vector<std::string> names;
    for (const DeadName& name : deadNames(temporary_.path(), temporary_.path() / "exercises/01-demo")) {
      names.push_back(name.name);
      places_.push_back(name);
    }
    return names;
  }
  TemporaryFolder temporary_;
  std::vector<DeadName> places_;
};

TEST_F(DeadNamesTest, AcceptWhatExists) {
  EXPECT_THAT(dead("Edit `main.cpp`: `ikStep(q0)` uses `Simulator::jacobianPos`, `S.jacobianPos`... `q0`.\n"
                   "See `share/doc/style.md`, `share/doc/`, `out/01-demo/frames`, `plots/error.png`.\n"
                   "`std::vector` `Eigen::MatrixXd` `J^T J` `x` `2:29` `rex test 01` `0.3`\n"
                   "```\n`nothing` here counts\n```\nodd ` quote\n"),
              ElementsAre());
}

TEST_F(DeadNamesTest, FindWhatDoesNotAndSayWhere) {
  EXPECT_THAT(dead("\nUse `ikSteps` and `ghost`.\nSee `share/doc/styles.md`.\n"),
              ElementsAre("ikSteps", "ghost", "share/doc/styles.md"));
  EXPECT_EQ(places_[0].where.line, 2);
  EXPECT_EQ(places_[0].where.column, 6);
  EXPECT_THAT(places_[0].nearest, ElementsAre("ikStep"));
}

TEST_F(DeadNamesTest, ReadTheTodosOfTheSolutionOnly) {
  EXPECT_THAT(dead("", "// `nobody` asks\n//| // TODO: call `jacobianPoss`.\n"), ElementsAre("jacobianPoss"));
}

TEST_F(DeadNamesTest, FindForbiddenFunctionsThatTheLibraryDoesNotHave) {
  write("exercises/01-demo/exercise.toml",
        "[[forbidden]]\nfunction = \"Simulator::jacobianPos\"\nreason = \"`nothing` here counts\"\n"
        "[[forbidden]]\nfunction = \"Simulator::jacobianPoss\"\n"
        "[[forbidden]]\nfunction = \"ikStep\"\n");  // the exercise has it, the library does not
  EXPECT_THAT(dead(""), ElementsAre("Simulator::jacobianPoss", "ikStep"));
  EXPECT_EQ(places_[0].where.line, 5);
  EXPECT_EQ(places_[0].where.column, 13);
  EXPECT_THAT(places_[0].nearest, ElementsAre("jacobianPos"));
}

}  // namespace rex::authoring::gates_test
