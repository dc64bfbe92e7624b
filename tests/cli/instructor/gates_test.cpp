#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "base/process.h"
#include "submission/exercise_info.h"
#include "support/registered_tests.h"

namespace rex::cli::gates_test {

std::set<std::string> linesOf(const std::string& output) {
  std::set<std::string> lines;
  std::istringstream text(output);
  for (std::string line; std::getline(text, line);) lines.insert(line);
  return lines;
}

// The tests that CMake registered for an exercise, without "  Test #12: exercise/01-kinematics/".
std::set<std::string> registered(const std::string& exercise) {
  std::set<std::string> gates;
  for (const std::string& line : linesOf(registeredTests({"-L", exercise}))) {
    const std::string prefix = "exercise/" + exercise + "/";
    const std::size_t at = line.find(prefix);
    if (at != std::string::npos) gates.insert(line.substr(at + prefix.size()));
  }
  return gates;
}

std::set<std::string> listed(const std::string& exercise) {
  const ProcessResult result =
      runProcess({REX_BINARY_DIR "/rex-instructor", "dev", "check", exercise, "--list-gates"});
  EXPECT_TRUE(result.ok()) << result.error;
  return linesOf(result.output);
}

TEST(Gates, AreAllTestsOfTheSuite) {
  const auto exercises = grading::listExercises(REX_SOURCE_DIR "/exercises");
  ASSERT_FALSE(exercises.empty());
  for (const grading::ExerciseInfo& exercise : exercises) {
#ifdef __SANITIZE_ADDRESS__
    EXPECT_EQ(registered(exercise.name), std::set<std::string>{"hostile"}) << "see RexGates.cmake";
#else
    EXPECT_EQ(registered(exercise.name), listed(exercise.name));
#endif
  }
}

}  // namespace rex::cli::gates_test
