#include "classroom/task_list.h"

#include <set>

#include <gtest/gtest.h>

#include "base/text_file.h"
#include "classroom/grade_task.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::task_list_test {

Task sample() {
  return {.student = "zoe",
          .exercise = "01-kinematics",
          .sourceSha256 = "s",
          .graderSha256 = "g",
          .level = sandbox::Level{2},
          .seed = 7,
          .secretId = "abcd",
          .submitted = 1'700'000'000,
          .timeFrom = "file",
          .file = "zoe/01-kinematics/main.cpp"};
}

class TaskListTest : public ::testing::Test {
 protected:
  std::filesystem::path file() const { return folder_.path() / "tasks.tsv"; }
  std::vector<Task> read(const std::string& text) const {
    writeTextFile(file(), text);
    return readManifest(file());
  }
  // The list of the sample, with one text in place of another.
  std::string changed(const std::string& from, const std::string& to) const {
    std::string text = toManifest({sample()});
    return text.replace(text.rfind(from), from.size(), to);
  }
  TemporaryFolder folder_;
};

TEST_F(TaskListTest, ReadsWhatItWrote) {
  Task second = sample();
  second.seed.reset();
  second.secretId.clear();
  second.student = "Müller, \"Ä\"";
  const std::string text = toManifest({sample(), second});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  const std::vector<Task> tasks = read(text);
  ASSERT_EQ(tasks.size(), 2u);
  EXPECT_EQ(toManifest(tasks), text);
  EXPECT_EQ(tasks[0].seed, 7u);
  EXPECT_FALSE(tasks[1].seed);
  EXPECT_EQ(tasks[1].student, second.student);
  EXPECT_EQ(tasks[1].file, second.file);
}

TEST_F(TaskListTest, HashesAllThatAResultDependsOn) {
  std::set<std::string> hashes = {sample().inputsSha256()};
  const auto add = [&](auto change) {
    Task task = sample();
    change(task);
    hashes.insert(task.inputsSha256());
  };
  add([](Task& task) { task.exercise = "02"; });
  add([](Task& task) { task.sourceSha256 = "t"; });
  add([](Task& task) { task.graderSha256 = "h"; });
  add([](Task& task) { task.level = sandbox::Level::kControlGroup; });
  add([](Task& task) { task.seed = 8; });
  add([](Task& task) { task.seed.reset(); });
  add([](Task& task) { task.secretId = ""; });
  EXPECT_EQ(hashes.size(), 8u);
  add([](Task& task) { task.student = "adam"; });
  add([](Task& task) { task.submitted = 0; });
  add([](Task& task) { task.file = "elsewhere"; });
  EXPECT_EQ(hashes.size(), 8u);
}

TEST_F(TaskListTest, RefusesOtherTexts) {
  EXPECT_REX_ERROR(read(""), "tasks.tsv:1: not a list of tasks: wanted the headings");
  EXPECT_REX_ERROR(read(changed("\tzoe", "\tzoe\tzoe")),
                   "tasks.tsv:2: not a list of tasks: found 13 columns");
  EXPECT_REX_ERROR(read(changed("\n1\t", "\n2\t")), "found task 2, wanted task 1");
  EXPECT_REX_ERROR(read(changed("\t2\t", "\tx\t")), "found 'x', wanted a sandbox level");
  EXPECT_REX_ERROR(read(changed("\t2\t", "\t4\t")), "sandbox level: found 4, wanted 0, 1, 2 or 3");
  EXPECT_REX_ERROR(read(changed("\t7\t", "\t-7\t")), "found '-7', wanted a seed, or nothing");
  EXPECT_REX_ERROR(read(changed("1700000000", "now")), "found 'now', wanted a time in seconds");
  EXPECT_REX_ERROR(read(changed("\tzoe\t", "\t../..\t")), "wanted a plain name");
  EXPECT_REX_ERROR(read(changed("\t7\t", "\t8\t")), "found another hash of the inputs");
  Task task = sample();
  task.file = "a\tb";
  EXPECT_REX_ERROR(toManifest({task}), "cannot be in a list of tasks: wanted no tab and no line break");
}

TEST(Ranges, JoinNeighbours) {
  EXPECT_EQ(numberRanges({}), "");
  EXPECT_EQ(numberRanges({3}), "3");
  EXPECT_EQ(numberRanges({9, 4, 6, 5, 1}), "1,4-6,9");
  EXPECT_EQ(numberRanges({2, 1}), "1-2");
}

}  // namespace rex::classroom::task_list_test
