#include "cli/build_on_demand.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interruption.h"
#include "base/process.h"
#include "support/file_text.h"
#include "support/temporary_folder.h"

namespace rex::cli::build_on_demand_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// A build folder whose build.ninja makes files by shell commands.
class BuildOnDemand : public ::testing::Test {
 protected:
  // Of one target; "out" without a command is there for others to need.
  void addTarget(const std::string& name, const std::string& command, const std::string& inputs = "") const {
    std::ofstream(folder() / "build.ninja", std::ios::app)
        << "rule make-" << name << "\n  command = " << command << "\nbuild " << name << ": make-" << name
        << " " << inputs << "\n";
  }
  // What it says on standard error.
  std::string build(const std::vector<std::string>& targets) const {
    ::testing::internal::CaptureStderr();
    bringUpToDate({folder(), folder()}, targets, "the tool");
    return ::testing::internal::GetCapturedStderr();
  }
  std::string failureOf(const std::string& target) const {
    ::testing::internal::CaptureStderr();
    std::string text;
    try {
      bringUpToDate({folder(), folder()}, {target}, "the tool");
    } catch (const BuildFailure& failure) {
      text = failure.what();
    }
    static_cast<void>(::testing::internal::GetCapturedStderr());
    return text;
  }
  fs::path folder() const { return folder_.path(); }
  fs::path in(const std::string& name) const { return folder() / name; }

 private:
  TemporaryFolder folder_;
};

TEST_F(BuildOnDemand, BuildsWhatIsAskedForAndNothingElse) {
  addTarget("tool", "echo tool > $out");
  addTarget("other", "echo other > $out");
  EXPECT_EQ(build({"tool"}), "building the tool ...\n");
  EXPECT_EQ(fileText(in("tool")), "tool\n");
  EXPECT_FALSE(fs::exists(in("other")));
}

TEST_F(BuildOnDemand, IsSilentWithoutWork) {
  addTarget("tool", "echo tool > $out; echo once >> count");
  EXPECT_NE(build({"tool"}), "");
  EXPECT_EQ(build({"tool"}), "");
  EXPECT_EQ(fileText(in("count")), "once\n");
}

TEST_F(BuildOnDemand, BuildsAgainWhatHasChanged) {
  std::ofstream(in("source")) << "one";
  addTarget("tool", "cp $in $out", "source");
  EXPECT_NE(build({"tool"}), "");
  std::ofstream(in("source")) << "two";
  fs::last_write_time(in("source"), fs::file_time_type::clock::now() + std::chrono::hours(1));
  EXPECT_NE(build({"tool"}), "");
  EXPECT_EQ(fileText(in("tool")), "two");
}

TEST_F(BuildOnDemand, LeavesAnInstalledTreeAlone) {
  EXPECT_EQ(build({"tool"}), "");
  EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(BuildOnDemand, PassesOnWhatTheCompilerSaid) {
  addTarget("tool", "echo 'tool.cpp:3:1: error: no such thing'; exit 1");
  const std::string text = failureOf("tool");
  EXPECT_THAT(text, ::testing::StartsWith("the tool does not build:\n"));
  EXPECT_THAT(text, HasSubstr("tool.cpp:3:1: error: no such thing"));
  EXPECT_THAT(failureOf("toool"), HasSubstr("unknown target 'toool'"));
}

TEST_F(BuildOnDemand, KeepsTheEndOfALongMessage) {
  addTarget("tool", "seq 1 5000; echo the end; exit 1");
  const std::string text = failureOf("tool");
  EXPECT_THAT(text, HasSubstr("the end"));
  EXPECT_LT(text.size(), 7000u);
}

TEST_F(BuildOnDemand, LeavesADepfileToTheBuildThatIsUnderWay) {
  std::ofstream(in("header")) << "one";
  std::ofstream(in("build.ninja")) << "rule compile\n  command = cp header $out; echo '$out: header' > "
                                      "$out.d; while [ ! -e asked ]; do sleep "
                                      ".01; done\n  depfile = $out.d\n  deps = gcc\nbuild tool: compile\n";
  // The second one asks what would be done, and then waits for the lock of the first.
  std::thread first([&] {
    static_cast<void>(runProcess({"flock", in(".lock").string(), "ninja", "-C", folder().string(), "tool"},
                                 {.timeout = 60}));
  });
  while (!fs::exists(in("tool.d"))) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    std::ofstream(in("asked")) << "yes";
  });
  build({"tool"});
  first.join();
  later.join();
  std::ofstream(in("header")) << "two";
  fs::last_write_time(in("header"), fs::file_time_type::clock::now() + std::chrono::hours(1));
  EXPECT_NE(build({"tool"}), "");
  EXPECT_EQ(fileText(in("tool")), "two");
}

TEST_F(BuildOnDemand, WaitsForABuildThatIsUnderWay) {
  addTarget("slow", "touch started; sleep 0.3; test ! -e second && echo slow > $out");
  addTarget("second", "echo second > $out");
  std::thread first([&] { bringUpToDate({folder(), folder()}, {"slow"}, "the first"); });
  while (!fs::exists(in("started"))) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  bringUpToDate({folder(), folder()}, {"second"}, "the second");
  first.join();
  EXPECT_TRUE(fs::exists(in("slow"))) << "nothing was built beside it";
}

TEST_F(BuildOnDemand, EndsTheBuildWhenItIsInterrupted) {
  addTarget("endless", "echo $$$$ > process.new; mv process.new process; exec sleep 1000");
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      const HeldSignals held;
      bringUpToDate({folder(), folder()}, {"endless"}, "the tool");
      ::_exit(0);
    } catch (const Interrupted&) {
      ::_exit(99);
    }
  }
  while (!fs::exists(in("process"))) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 99);
  const pid_t made = std::stoi(fileText(in("process")));
  bool isGone = false;
  for (int k = 0; k < 500 && !isGone; ++k) {
    isGone = ::kill(made, 0) != 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(isGone);
}

TEST(BuildProgress, TellsTheShareAndWhatIsLeft) {
  const std::string log = "[1/200] Building a.o\n[74/200] Building b.o\n";
  EXPECT_EQ(buildProgress("rex-robot", log, 29), "building rex-robot: 37 %, about 50 s left");
  EXPECT_EQ(buildProgress("rex-robot", log, 290), "building rex-robot: 37 %, about 8 min left");
  EXPECT_EQ(buildProgress("rex-robot", log + "warning: some [3/4]\n", 29),
            "building rex-robot: 37 %, about 50 s left");
}

TEST(BuildProgress, TellsNoMoreThanIsKnown) {
  EXPECT_EQ(buildProgress("rex", "", 29), "building rex");
  EXPECT_EQ(buildProgress("rex", "[0/1] Re-running CMake...\n-- Generating done\n", 29), "building rex: 0 %");
  EXPECT_EQ(buildProgress("rex", "[1/2] a", 1), "building rex: 50 %");
  EXPECT_EQ(buildProgress("rex", "[2/2] a", 29), "building rex: 100 %");
  for (const char* log : {"[x/2]", "[1/y]", "[1/0]", "[1", "[1/2 a", "[", "\n\n"})
    EXPECT_EQ(buildProgress("rex", log, 29), "building rex") << log;
}

}  // namespace rex::cli::build_on_demand_test
