#include "classroom/forgetting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "classroom/gradebook.h"
#include "support/class_results.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/temporary_folder.h"

namespace rex::classroom::forgetting_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::int64_t kTime = 1'700'000'000;
const std::string kEx = "01-kinematics";

/// adam and zoe are a pair, and adam handed in for both; bob and carl are alone.
class ForgettingTest : public ::testing::Test {
 protected:
  ForgettingTest() {
    course_.students = {{.id = "adam", .group = "pair"},
                        {.id = "bob", .name = "Bob B.", .email = "bob@uni.example", .number = "4711"},
                        {.id = "carl"},
                        {.id = "zoe", .group = "pair"}};
    for (const char* student : {"adam", "bob", "carl", "ghost"}) {
      writeTextFile(handedIn() / student / kEx / "main.cpp", "int main() {}\n");
      save(student, kEx, kTime);
    }
    save("bob", "02-control", kTime + 100);
    writeTextFile(handedIn() / "dora.zip", "not read");
    writeTextFile(out() / "grades.csv", "student\nbob\n");
    writeTextFile(out() / "slurm-1-1.log", "bob\n");
    writeTextFile(out() / "tasks.tsv", toManifest(tasks_));
    writeTextFile(out() / "not_taken.tsv", rejectedText({{"bob", kEx, "a link"}, {"carl", kEx, "a link"}}));
    imported_.students = {{.student = "bob", .name = "Bob B."}, {.student = "carl"}};
    for (ImportedStudent& person : imported_.students)
      person.exercises[kEx] = {.platform = "folders",
                               .status = SubmissionStatus::kHandedIn,
                               .handedInBy = person.student,
                               .submitted = kTime,
                               .timeFrom = "file"};
    writeTextFile(handedIn() / kImportTable, importTableText(imported_));
  }
  void save(const std::string& student, const std::string& exercise, std::int64_t time) {
    tasks_.push_back(sampleTask(student, exercise, time));
    saveSample(out(), tasks_.back(), sampleResult(3, 4, 3));
  }
  fs::path handedIn() const { return folder_.path() / "in"; }
  fs::path out() const { return folder_.path() / "results"; }
  Traces traces(const ForgetOptions& options) const {
    const Forgetting forgetting(course_, imported_, tasks_, options);
    Traces found;
    forgetting.addFolder(handedIn(), found), forgetting.addFolder(out(), found);
    forgetting.addSimilar(folder_.path() / "similar", found);
    return found;
  }

  TemporaryFolder folder_;
  Course course_;
  ImportTable imported_;
  std::vector<Task> tasks_;
};

TEST_F(ForgettingTest, RemovesOnePersonAndNobodyElse) {
  const fs::path similar = folder_.path() / "similar";
  writeTextFile(similar / kEx / "submissions" / "bob" / "main.cpp", "");
  writeTextFile(similar / kEx / "submissions" / "carl" / "main.cpp", "");
  writeTextFile(similar / (kEx + ".html"), "bob");
  const Traces found = traces({.student = "bob"});
  EXPECT_THAT(found.removed,
              ElementsAre(handedIn() / "bob", out() / "bob", out() / "grades.csv", out() / "slurm-1-1.log",
                          similar / kEx / "submissions" / "bob", similar / (kEx + ".html")));
  EXPECT_THAT(found.kept, IsEmpty());
  EXPECT_TRUE(fs::exists(out() / "bob")) << "until they are removed";
  removeTraces(found);
  for (const fs::path& path : found.removed) EXPECT_FALSE(fs::exists(path)) << path;
  for (const char* file : {"tasks.tsv", "not_taken.tsv"}) {
    EXPECT_THAT(fileText(out() / file), Not(HasSubstr("bob"))) << file;
    EXPECT_THAT(fileText(out() / file), HasSubstr("carl")) << file;
  }
  EXPECT_EQ(readManifest(out() / "tasks.tsv").size(), 3u);
  EXPECT_EQ(importTableIn(handedIn()).find("bob"), nullptr);
  EXPECT_NE(importTableIn(handedIn()).find("carl"), nullptr);
  EXPECT_TRUE(fs::exists(out() / "carl" / kEx / "results.json"));
  EXPECT_THAT(traces({.student = "nobody"}).removed, IsEmpty());
}

TEST_F(ForgettingTest, KeepsWhatCountsForAPartner) {
  for (const char* student : {"adam", "zoe"}) {
    const Traces found = traces({.student = student});
    EXPECT_THAT(found.removed, IsEmpty());
    const std::string other = student == std::string("adam") ? "zoe" : "adam";
    EXPECT_THAT(found.kept,
                ElementsAre((handedIn() / "adam" / kEx).string() + ": it counts for " + other + ", too",
                            (out() / "adam" / kEx).string() + ": it counts for " + other + ", too"));
  }
}

TEST_F(ForgettingTest, RemovesFoldersAndArchivesOfPeopleWhoAreOnNoList) {
  const Traces ghost = traces({.student = "ghost"});
  EXPECT_THAT(ghost.removed, ::testing::Contains(out() / "ghost"));
  EXPECT_EQ(traces({.student = "Dora"}).removed.front(), handedIn() / "dora.zip");
}

TEST_F(ForgettingTest, RemovesWhatWasHandedInBeforeADay) {
  fs::last_write_time(handedIn() / "dora.zip", fs::file_time_type::clock::now());
  const Traces found = traces({.before = kTime + 50});
  EXPECT_THAT(found.removed,
              ElementsAre(handedIn() / "adam", handedIn() / "bob", handedIn() / "carl", handedIn() / "ghost",
                          out() / "adam", out() / "bob" / kEx, out() / "carl", out() / "ghost",
                          out() / "grades.csv", out() / "slurm-1-1.log"));
  removeTraces(found);
  const std::vector<Task> left = readManifest(out() / "tasks.tsv");
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].student + left[0].exercise, "bob02-control");
  EXPECT_TRUE(importTableIn(handedIn()).students.empty());
  EXPECT_THAT(traces({.before = kTime - 50}).removed, IsEmpty());
}

TEST_F(ForgettingTest, FindsWhereFilesNameAPerson) {
  const fs::path file = folder_.path() / "students.csv";
  writeTextFile(file, "id,name\nbob,\nbobby,\nx,Bob B.\ny,-4711-\nz,47110\nw,bob@uni.example\n");
  const std::string at = file.string() + ":";
  EXPECT_THAT(mentionsIn(file, course_.students[1]), ElementsAre(at + "2", at + "4", at + "5", at + "7"));
}

}  // namespace rex::classroom::forgetting_test
