#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "base/process.h"
#include "submission/exercise_info.h"

namespace rex::cli::gates_test {

std::set<std::string> linesOf(const std::vector<std::string>& command) {
  const ProcessResult result = runProcess(command);
  EXPECT_TRUE(result.ok()) << result.error;
  std::set<std::string> lines;
  std::istringstream text(result.output);
  for (std::string line; std::getline(text, line);) lines.insert(line);
  return lines;
}

// The tests that CMake registered for an exercise, without "  Test #12: exercise/01-kinematics/".
std::set<std::string> registered(const std::string& exercise) {
  std::set<std::string> gates;
  for (const std::string& line : linesOf({"ctest", "--test-dir", REX_BINARY_DIR, "-N", "-L", exercise})) {
    const std::string prefix = "exercise/" + exercise + "/";
    const std::size_t at = line.find(prefix);
    if (at != std::string::npos) gates.insert(line.substr(at + prefix.size()));
  }
  return gates;
}

TEST(Gates, AreAllTestsOfTheSuite) {
  const auto exercises = grading::listExercises(REX_SOURCE_DIR "/exercises");
  ASSERT_FALSE(exercises.empty());
  for (const grading::ExerciseInfo& exercise : exercises)
    EXPECT_EQ(registered(exercise.name),
              linesOf({REX_BINARY_DIR "/rex-instructor", "dev", "check", exercise.name, "--list-gates"}));
}

}  // namespace rex::cli::gates_test
