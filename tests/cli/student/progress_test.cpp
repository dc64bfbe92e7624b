#include "cli/student/progress.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/rng.h"
#include "support/file_text.h"
#include "support/temporary_folder.h"

namespace rex::cli::progress_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ProgressFileTest : public ::testing::Test {
 protected:
  fs::path folder() const { return temporary_.path() / ".rex"; }
  fs::path file() const { return folder() / "progress.json"; }
  ProgressFile progress() const { return ProgressFile(temporary_.path()); }

  void write(const std::string& text) const {
    fs::create_directories(folder());
    std::ofstream(file()) << text;
  }
  // What is read, and what is told meanwhile.
  std::pair<AllProgress, std::string> readAloud() const {
    ::testing::internal::CaptureStderr();
    AllProgress all = progress().read();
    return {std::move(all), ::testing::internal::GetCapturedStderr()};
  }
  // Counts one more hint, as another program would.
  void countOne(const std::string& part) const {
    progress().change("01-demo", [&](Progress& one) { ++one.hints[part]; });
  }
  template <class Work>
  static pid_t inAnotherProcess(const Work& work) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    work();
    ::_exit(0);
  }

  TemporaryFolder temporary_;
};

TEST_F(ProgressFileTest, RemembersWhatWasTested) {
  EXPECT_TRUE(progress().read().exercises.empty());
  EXPECT_FALSE(fs::exists(folder())) << "looking leaves nothing behind";
  progress().change("01-demo", [](Progress& one) {
    one = {.tested = true, .points = 3, .maxPoints = 9, .solved = false, .fileSha256 = "ab"};
  });
  progress().change("02-next", [](Progress& one) { one.hints["a"] = 2; });
  const auto [all, told] = readAloud();
  EXPECT_EQ(told, "");
  EXPECT_EQ(all.last, "01-demo");
  EXPECT_EQ(all.exercises.at("01-demo").points, 3);
  EXPECT_EQ(all.exercises.at("01-demo").maxPoints, 9);
  EXPECT_EQ(all.exercises.at("01-demo").fileSha256, "ab");
  EXPECT_FALSE(all.exercises.at("02-next").tested);
  EXPECT_EQ(all.exercises.at("02-next").hints.at("a"), 2);
}

grading::GradeResult tested(const std::string& hash,
                            const std::vector<std::pair<std::string, bool>>& checks) {
  grading::GradeResult result{.snapshotSha256 = hash};
  for (const auto& [part, passes] : checks)
    result.checks.push_back(
        {.part = part, .status = passes ? grading::Outcome::kPass : grading::Outcome::kFail});
  return result;
}

TEST(Work, IsTheTimeBetweenSavesThatIsNoPause) {
  struct Row {
    std::int64_t now;
    const char* hash;
    std::int64_t seconds;
  };
  Work work;
  for (const Row& row : std::initializer_list<Row>{{1000, "a", 0},     // the first
                                                   {1600, "a", 0},     // not saved
                                                   {1660, "b", 660},   // since the last save
                                                   {1660, "c", 660},   //
                                                   {2560, "d", 1560},  // just no pause
                                                   {3461, "e", 1560},  // a pause
                                                   {3400, "f", 1560},  // a clock that was set back
                                                   {3500, "g", 1660}}) {
    addTest(work, tested(row.hash, {}), true, row.now);
    EXPECT_EQ(work.seconds, row.seconds) << row.hash;
  }
  EXPECT_EQ(work.lastSave, 3500);
}

TEST(Work, NotesWhenPartsPassedForTheFirstTime) {
  Work work;
  addTest(work, tested("a", {{"one", true}, {"two", true}, {"two", false}}), true, 1000);
  addTest(work, tested("b", {{"one", false}, {"two", true}, {"two", true}}), true, 1100);
  addTest(work, tested("c", {{"one", true}, {"three", true}}), false, 1200);  // only some checks
  EXPECT_EQ(work.parts.size(), 2u);
  EXPECT_EQ(work.parts.at("one").at, 1000);
  EXPECT_EQ(work.parts.at("one").worked, 0);
  EXPECT_EQ(work.parts.at("two").at, 1100);
  EXPECT_EQ(work.parts.at("two").worked, 100);
  EXPECT_EQ(work.seconds, 200);
}

TEST_F(ProgressFileTest, RemembersTheWork) {
  countOne("a");
  EXPECT_EQ(fileText(file()).find("work"), std::string::npos);
  progress().change("01-demo", [](Progress& one) {
    one.work = {.seconds = 90,
                .lastSave = 1'795'215'540,
                .fileSha256 = "ab",
                .parts = {{"one", {1'795'215'000, 60}}}};
  });
  EXPECT_THAT(fileText(file()), HasSubstr("\"last_save\": \"2026-11-20T22:59:00Z\""));
  const Work back = progress().read().exercises.at("01-demo").work;
  EXPECT_EQ(back.seconds, 90);
  EXPECT_EQ(back.lastSave, 1'795'215'540);
  EXPECT_EQ(back.fileSha256, "ab");
  EXPECT_EQ(back.parts.at("one").at, 1'795'215'000);
  EXPECT_EQ(back.parts.at("one").worked, 60);
}

TEST_F(ProgressFileTest, RemembersTheRecords) {
  progress().change("01-demo", [](Progress& one) {
    one.records = {{"length", {.unit = "m", .values = {2.5, 1.0 / 3}, .fileSha256 = "ab"}},
                   {"rides", {.isMoreBetter = true, .values = {7}}}};
  });
  countOne("a");
  const Records back = progress().read().exercises.at("01-demo").records;
  EXPECT_EQ(back.size(), 2u);
  EXPECT_EQ(back.at("length").unit, "m");
  EXPECT_EQ(back.at("length").values, (std::vector{2.5, 1.0 / 3}));
  EXPECT_EQ(back.at("length").fileSha256, "ab");
  EXPECT_FALSE(back.at("length").isMoreBetter);
  EXPECT_TRUE(back.at("rides").isMoreBetter);
}

TEST_F(ProgressFileTest, KeepsKeysThatItDoesNotKnow) {
  write(R"({"schema": "rex-progress/1", "exercises": {"01-demo": {"badge": "gold"}}, "later": 7})");
  countOne("a");
  EXPECT_THAT(fileText(file()), HasSubstr("\"badge\": \"gold\""));
  EXPECT_THAT(fileText(file()), HasSubstr("\"later\": 7"));
}

TEST_F(ProgressFileTest, MovesABrokenFileAsideAndSaysSo) {
  int count = 0;
  for (const char* broken :
       {"{\"schema\": \"rex-pro", "", "[]", "{\"exercises\": {}}",
        R"({"schema": "rex-progress/1", "exercises": {"01-demo": {"points": "many"}}})",
        R"({"schema": "rex-progress/1", "exercises": {"01-demo": {"records": {"length": 3}}}})"}) {
    write(broken);
    const auto [all, told] = readAloud();
    EXPECT_TRUE(all.exercises.empty()) << broken;
    EXPECT_THAT(told, HasSubstr("cannot be understood")) << broken;
    const std::string aside = "progress.json.broken-" + std::to_string(++count);
    EXPECT_THAT(told, HasSubstr(aside));
    EXPECT_EQ(fileText(folder() / aside), broken);
    countOne("a");
    EXPECT_EQ(progress().read().exercises.at("01-demo").hints.at("a"), 1);
  }
}

TEST_F(ProgressFileTest, FailsNoCommandWhereNothingCanBeKept) {
  std::ofstream(folder()) << "a file where a folder should be";
  ::testing::internal::CaptureStderr();
  countOne("a");
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("cannot keep progress in"));
}

// Whenever it is killed, what was counted before is there, and the text is whole.
TEST_F(ProgressFileTest, SurvivesAKillAtAnyMoment) {
  Rng rng(1);
  int counted = 0;
  for (int round = 0; round < 60; ++round) {
    const pid_t child = inAnotherProcess([&] {
      for (;;) countOne("a");
    });
    std::this_thread::sleep_for(std::chrono::microseconds(1000 + static_cast<int>(rng.uniform(0, 15000))));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const auto [all, told] = readAloud();
    EXPECT_EQ(told, "");
    const int now = all.exercises.empty() ? 0 : all.exercises.at("01-demo").hints.at("a");
    EXPECT_GE(now, counted);
    counted = now;
  }
  EXPECT_GT(counted, 0);
}

TEST_F(ProgressFileTest, LosesNothingOfTwoProgramsAtOnce) {
  constexpr int kPrograms = 4, kTimes = 30;
  std::vector<pid_t> programs;
  for (int k = 0; k < kPrograms; ++k)
    programs.push_back(inAnotherProcess([&, part = "part" + std::to_string(k)] {
      for (int n = 0; n < kTimes; ++n) countOne("all"), countOne(part);
    }));
  for (const pid_t program : programs) ::waitpid(program, nullptr, 0);
  const auto hints = progress().read().exercises.at("01-demo").hints;
  EXPECT_EQ(hints.at("all"), kPrograms * kTimes);
  for (int k = 0; k < kPrograms; ++k) EXPECT_EQ(hints.at("part" + std::to_string(k)), kTimes);
}

}  // namespace rex::cli::progress_test
