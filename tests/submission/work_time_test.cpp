#include "submission/work_time.h"

#include <gtest/gtest.h>

namespace rex::submission::work_time_test {

TEST(WorkTime, ComesBackAsItWasWritten) {
  const WorkTime work{.seconds = 5400, .parts = {{"lagrange", 3600}, {"lqr", 5400}}};
  EXPECT_EQ(workTimeText(work), R"({"seconds":5400,"parts":{"lagrange":3600,"lqr":5400}})");
  EXPECT_EQ(readWorkTime(workTimeText(work)), work);
  EXPECT_EQ(readWorkTime(workTimeText({})), WorkTime{});
}

TEST(WorkTime, IsNotReadFromAnythingElse) {
  for (const char* text :
       {"", "7", "[]", "{}", R"({"seconds":1})", R"({"seconds":"1","parts":{}})",
        R"({"seconds":1.5,"parts":{}})", R"({"seconds":-1,"parts":{}})", R"({"seconds":99999999,"parts":{}})",
        R"({"seconds":18446744073709551615,"parts":{}})", R"({"seconds":1,"parts":[]})",
        R"({"seconds":1,"parts":{"a":2}})", R"({"seconds":1,"parts":{"a":null}})"})
    EXPECT_FALSE(readWorkTime(text)) << text;
}

}  // namespace rex::submission::work_time_test
