#include <fstream>

#include <gtest/gtest.h>

#include "base/instant.h"
#include "classroom/platform_time.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::submission_times_test {

class SubmissionTimesTest : public ::testing::Test {
 protected:
  SubmissionTimes read(const std::string& text) const {
    std::ofstream(file()) << text;
    std::vector<submission::ExerciseInfo> exercises(2);
    exercises[0].name = "01-kinematics";
    exercises[1].name = "02-control";
    return {file(), exercises};
  }
  void expectError(const std::string& text, const std::string& message) const {
    EXPECT_REX_ERROR(read(text), file() + message);
  }
  std::string file() const { return (folder_.path() / "times.csv").string(); }

  TemporaryFolder folder_;
};

TEST_F(SubmissionTimesTest, TellsThoseOfOneExerciseBeforeThoseOfAll) {
  const SubmissionTimes times = read(
      "name,student,exercise,submitted\n"
      "A,alice,kinematics,2026-11-20T10:00:00+01:00\n"
      "A,alice,,2026-11-21T10:00:00+01:00\n"
      "B,bob,01,\n");
  EXPECT_EQ(instantText(times.of("alice", "01-kinematics").value()), "2026-11-20T09:00:00Z");
  EXPECT_EQ(instantText(times.of("alice", "02-control").value()), "2026-11-21T09:00:00Z");
  EXPECT_FALSE(times.of("bob", "01-kinematics"));
}

TEST_F(SubmissionTimesTest, RefusesOtherTables) {
  expectError("who,when\n",
              ":1: not a table of submission times: found the columns who, when, wanted a column 'student'");
  expectError("student,submitted\nalice\n", ":2: not a table of submission times: found 1 fields, wanted 2");
  expectError("student,submitted\nalice,2026-11-20 10:00\n",
              ":2: not a time: found '2026-11-20 10:00', wanted a time with its zone, such as "
              "2026-11-20T23:59:00+01:00");
  expectError("student,submitted,exercise\na,2026-11-20T10:00:00Z,03\n",
              ":2: no exercise is called '03': wanted one of 01-kinematics, 02-control");
  expectError("student,submitted\na,2026-11-20T10:00:00Z\na,2026-11-20T11:00:00Z\n",
              ":3: a second time for the same submission: found 'a' again, wanted one row");
}

}  // namespace rex::classroom::submission_times_test
