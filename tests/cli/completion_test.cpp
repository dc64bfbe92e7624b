#include "cli/template_project.h"

namespace rex::cli {
namespace {

class Completion : public TemplateProject {
 protected:
  std::string after(std::vector<std::string> words) const {
    words.insert(words.begin(), "--complete");
    return rex(std::move(words)).output;
  }
};

TEST_F(Completion, KnowsTheCommandsOfAllPrograms) {
  EXPECT_EQ(after({"s"}), "scene\nsearch\nshow\nsimulate\nslam\nsolution\nsubmit\n");
}

TEST_F(Completion, KnowsTheExercises) {
  EXPECT_EQ(after({"test", ""}), "98-template\n");
  EXPECT_EQ(after({"test", "98-template", "9"}), "98-template\n");
  EXPECT_EQ(after({"test", "01"}), "");
}

TEST_F(Completion, KnowsTheVerbsAndOptionsOfEachCommand) {
  EXPECT_EQ(after({"dev", "st"}), "stats\nstrip\n");
  EXPECT_EQ(after({"dev", "check", "--g"}), "--gate\n");
  EXPECT_EQ(after({"submit", "01", "--o"}), "--out\n");
}

TEST_F(Completion, LeavesFilesToTheShell) { EXPECT_EQ(after({"render", "ma"}), ""); }

TEST(ManualPage, ListsAllCommands) {
  ::testing::internal::CaptureStdout();
  const char* const words[] = {"rex", "--man"};
  EXPECT_EQ(runRex(2, words, {"/", "/"}), 0);
  const std::string page = ::testing::internal::GetCapturedStdout();
  for (const TableEntry& entry : commandTable())  // hyphens are written in another way
    EXPECT_THAT(page,
                ::testing::HasSubstr("\n.B " + std::string(entry.name.substr(0, entry.name.find('-')))));
  EXPECT_THAT(page, ::testing::HasSubstr(".SH EXIT STATUS"));
}

}  // namespace
}  // namespace rex::cli
