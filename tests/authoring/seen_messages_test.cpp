#include "authoring/seen_messages.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/fresh_folder.h"

namespace rex::authoring::seen_messages_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

grading::GradeResult graded() {
  grading::GradeResult result;
  const auto add = [&](const char* id, grading::Group group, grading::Outcome status, const char* message) {
    result.checks.push_back({.id = id, .group = group, .status = status, .message = message});
  };
  add("hidden", grading::Group::kHidden, grading::Outcome::kFail, "x: does not hold");
  add("passed", grading::Group::kVisible, grading::Outcome::kPass, "");
  add("first", grading::Group::kVisible, grading::Outcome::kFail, "y: got 1");
  add("second", grading::Group::kVisible, grading::Outcome::kFail, "z: got 2");
  return result;
}

TEST(SeenMessage, IsThatOfTheFirstVisibleCheckThatFails) {
  EXPECT_EQ(seenMessage(graded(), {"second", "first", "hidden"}), "first: y: got 1");
  EXPECT_EQ(seenMessage(graded(), {"second", "passed"}), "second: z: got 2");
  EXPECT_EQ(seenMessage(graded(), {"hidden", "passed"}), "hidden (hidden): x: does not hold");
}

TEST(SeenMessage, IsTheCompilersIfNothingWasGraded) {
  grading::GradeResult result{.message = "does not compile"};
  EXPECT_EQ(seenMessage(result, {"first"}), "does not compile");
  result.compile.diagnostics = {
      {.file = "main.cpp", .line = 2, .column = 1, .severity = "warning", .message = "unused"},

      {.file = "main.cpp", .line = 3, .column = 1, .severity = "error", .message = "no"}};
  EXPECT_EQ(seenMessage(result, {"first"}), "main.cpp:3:1: error: no");
}

class SeenMessagesFile : public ::testing::Test {
 protected:
  const std::filesystem::path file_ = freshFolderOfTest("seen_messages") / "seen.txt";
};

TEST_F(SeenMessagesFile, ReturnsWhatWasWritten) {
  const SeenMessages messages{{"one", "first: y: got 1"}, {"two", "second: z: got 2"}};
  writeSeenMessages(messages, file_);
  EXPECT_EQ(fileText(file_), "one\n    first: y: got 1\ntwo\n    second: z: got 2\n");
  EXPECT_EQ(readSeenMessages(file_), messages);
}

TEST_F(SeenMessagesFile, NamesAMessageWithoutVariant) {
  std::ofstream(file_) << "    first: y: got 1\n";
  EXPECT_REX_ERROR(static_cast<void>(readSeenMessages(file_)),
                   file_.string() + ":1: a message without the name of a wrong variant");
}

TEST(ChangedMessages, LeaveNumbersAside) {
  EXPECT_THAT(
      changedMessages({{"one", "y: got -1.5e-07 m, wanted 0.1"}}, {{"one", "y: got 2 m, wanted 3e+10"}}),
      IsEmpty());
}

TEST(ChangedMessages, NameWhatIsNewGoneOrOtherwise) {
  EXPECT_THAT(
      changedMessages({{"new", "a"}, {"other", "b: got 1"}}, {{"gone", "c"}, {"other", "d: got 1"}}),
      ElementsAre("new: seen.txt does not say what a student reads: a",
                  "other: a student reads: b: got 1\n  seen.txt says: d: got 1",
                  "gone: is in seen.txt, but there is no such variant", HasSubstr("REX_UPDATE_GOLDEN=1")));
}

TEST(MessagesThatExplainNothing, PrintGotAndWantedAlike) {
  struct Row {
    const char* message;
    bool explains;
  };
  for (const Row& row : std::initializer_list<Row>{
           {"c: y: got 0.5 m, wanted 0.5 m, off by 1e-17 m (seed 1)", false},
           {"c: y: got (1, 2), wanted (1, 2), off by 1e-17 (tolerance 0) (seed 1)", false},
           {"c: y: got 0.2 m, wanted at most 0.2 m (seed 1). Is it far?", false},
           {"c: y: got 0.2 m at time 3 s, wanted at least 0.2 m, at worst 0.1 m at time 4 s (seed 1)", false},
           {"c: y: got 7 at (10, 0), wanted 7 at (10, 0), off by 0 (seed 1)", false},
           {"c: y: got 0.5 m, wanted 0.50000001 m, off by 1e-8 m (seed 1)", true},
           {"c: y: got 0.5 m, wanted -0.5 m, off by 1 m (seed 1)", true},
           {"c: y: got 3 at (10, 0), wanted 7 at (10, 0), off by 4 (seed 1)", true},
           {"c: y: wrong shape: got 1 x 2, wanted 1 x 21 (seed 1)", true},
           {"c: y: does not hold (seed 1)", true}}) {
    const std::vector<std::string> complaints = messagesThatExplainNothing({{"one", row.message}});
    if (row.explains)
      EXPECT_THAT(complaints, IsEmpty()) << row.message;
    else
      EXPECT_THAT(complaints,
                  ElementsAre(std::string("one: got and wanted are printed alike: ") + row.message));
  }
}

}  // namespace rex::authoring::seen_messages_test
