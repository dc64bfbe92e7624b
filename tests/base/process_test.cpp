#include "base/process.h"

#include <chrono>
#include <csignal>

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/expect_error.h"

namespace rex::process_test {

TEST(RunProcess, FeedsInputAndKeepsBothOutputs) {
  const ProcessResult result = runProcess({"sh", "-c", "cat; echo trouble >&2; exit 3"}, {.input = "hello"});
  EXPECT_TRUE(result.started);
  EXPECT_FALSE(result.ok());
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.output, "hello");
  EXPECT_EQ(result.error, "trouble\n");
}

TEST(RunProcess, PassesArgumentsUntouchedByAnyShell) {
  const std::string hostile = "a'b\"c`id`$(id)\nd;e";
  EXPECT_EQ(runProcess({"printf", "%s", hostile}).output, hostile);
}

TEST(RunProcess, SurvivesAProgramThatReadsNothing) {
  EXPECT_TRUE(runProcess({"true"}, {.input = std::string(1 << 22, 'x')}).ok());
}

TEST(RunProcess, MovesLargeDataBothWaysWithoutDeadlock) {
  const std::string data(3 << 20, 'y');
  EXPECT_EQ(runProcess({"cat"}, {.input = data, .outputLimit = 4u << 20}).output, data);
}

TEST(RunProcess, DropsOutputBeyondTheLimitAndStillDrainsIt) {
  const ProcessResult result = runProcess({"head", "-c", "5000000", "/dev/zero"}, {.outputLimit = 1000});
  EXPECT_TRUE(result.ok());
  EXPECT_EQ(result.output.size(), 1000u);
}

TEST(RunProcess, KillsAtTheTimeout) {
  const auto start = std::chrono::steady_clock::now();
  const ProcessResult result = runProcess({"sh", "-c", "sleep 30 & sleep 30"}, {.timeout = 0.2});
  EXPECT_TRUE(result.timedOut);
  EXPECT_EQ(result.signal, SIGKILL);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(RunProcess, ReportsSignalsAndMissingPrograms) {
  EXPECT_EQ(runProcess({"sh", "-c", "kill -SEGV $$"}).signal, SIGSEGV);
  const ProcessResult missing = runProcess({"no-such-program-here"});
  EXPECT_FALSE(missing.started);
  EXPECT_EQ(missing.exitCode, -1);
  EXPECT_EQ(missing.error, "No such file or directory");
  EXPECT_FALSE(runProcess({"true"}, {.directory = "no/such/folder"}).started);
  EXPECT_REX_ERROR(runProcess({}), "no program to run");
}

TEST(RunProcess, LimitsTimeMemoryAndFileSize) {
  const ProcessResult spinning =
      runProcess({"sh", "-c", "while :; do :; done"}, {.timeout = 30, .cpuSeconds = 0.5});
  EXPECT_FALSE(spinning.timedOut);
  EXPECT_GE(spinning.cpuSeconds, 0.5);
  EXPECT_LT(runProcess({"sleep", "0.3"}).cpuSeconds, 0.2);
  EXPECT_TRUE(spinning.signal == SIGXCPU || spinning.signal == SIGKILL) << spinning.signal;
  EXPECT_EQ(runProcess({"sh", "-c", "ulimit -v"}, {.addressSpace = 512u << 20}).output, "524288\n");
  EXPECT_EQ(runProcess({"sh", "-c", "ulimit -f"}, {.fileSize = 51200}).output, "100\n");
  EXPECT_EQ(runProcess({"sh", "-c", "ulimit -v; ulimit -f; ulimit -t"}).output,
            "unlimited\nunlimited\nunlimited\n");
}

TEST(RunProcess, LeavesNoProgramBehindWhenTheCallerDies) {
  int fds[2];
  ASSERT_EQ(::pipe(fds), 0);
  const pid_t caller = ::fork();
  ASSERT_GE(caller, 0);
  if (caller == 0) {
    static_cast<void>(runProcess(
        {"bash", "-c",
         "exec " + std::to_string(fds[0]) + "<&-; echo >&" + std::to_string(fds[1]) + "; exec sleep 60"}));
    ::_exit(0);
  }
  ::close(fds[1]);
  char started = 0;
  ASSERT_EQ(::read(fds[0], &started, 1), 1);
  ::kill(caller, SIGKILL);
  ::waitpid(caller, nullptr, 0);
  // The program holds the other end of the pipe for as long as it lives.
  pollfd ended{fds[0], POLLIN, 0};
  EXPECT_EQ(::poll(&ended, 1, 20'000), 1);
  EXPECT_EQ(::read(fds[0], &started, 1), 0);
  ::close(fds[0]);
}

TEST(RunProcess, SetsVariablesBesideOurs) {
  ::setenv("REX_OURS", "ours", 1);
  ::setenv("REX_BOTH", "ours", 1);
  const ProcessResult run =
      runProcess({"sh", "-c", "echo $REX_OURS $REX_BOTH $REX_NEW; env | grep -c REX_BOTH="},
                 {.environment = {"REX_BOTH=new", "REX_NEW=a b"}});
  EXPECT_EQ(run.output, "ours new a b\n1\n");
  EXPECT_STREQ(::getenv("REX_BOTH"), "ours");
}

TEST(RunProcess, WorksInTheGivenFolder) { EXPECT_EQ(runProcess({"pwd"}, {.directory = "/"}).output, "/\n"); }

}  // namespace rex::process_test
