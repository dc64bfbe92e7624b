#include "base/process.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interruption.h"
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

ChildProcess::Deadline soon() { return ChildProcess::after(30); }

// Every test ends without a child, running or not yet waited for.
class ChildProcessTest : public testing::Test {
 protected:
  void TearDown() override {
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
  }
};

TEST_F(ChildProcessTest, IsFedPieceByPiece) {
  ChildProcess child({"sh", "-c", "cat; echo trouble >&2; exit 3"});
  EXPECT_TRUE(child.write("one ", soon()));
  EXPECT_TRUE(child.write("", soon()));
  EXPECT_TRUE(child.write("two", soon()));
  const ProcessResult result = child.finish(soon());
  EXPECT_EQ(result.output, "one two");
  EXPECT_EQ(result.error, "trouble\n");
  EXPECT_EQ(result.exitCode, 3);
}

TEST_F(ChildProcessTest, CollectsOutputWhileItIsFed) {
  const std::string piece(1 << 20, 'y');
  ChildProcess child({"cat"}, {.outputLimit = 8u << 20});
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(child.write(piece, soon()));
  EXPECT_EQ(child.finish(soon()).output.size(), 4 * piece.size());
}

TEST_F(ChildProcessTest, TellsThatNobodyReads) {
  ChildProcess child({"sh", "-c", "head -c 5 >/dev/null; exit 4"});
  EXPECT_FALSE(child.write(std::string(1 << 22, 'x'), soon()));
  EXPECT_FALSE(child.write("more", soon()));
  EXPECT_EQ(child.finish(soon()).exitCode, 4);
}

TEST_F(ChildProcessTest, IsKilledAtTheDeadline) {
  ChildProcess deaf({"sh", "-c", "sleep 60 & sleep 60"});
  EXPECT_FALSE(deaf.write(std::string(1 << 22, 'x'), ChildProcess::after(0.1)));
  const ProcessResult result = deaf.finish(soon());
  EXPECT_TRUE(result.timedOut);
  EXPECT_EQ(result.signal, SIGKILL);
  ChildProcess endless({"sleep", "60"});
  EXPECT_TRUE(endless.finish(ChildProcess::after(0.1)).timedOut);
}

TEST_F(ChildProcessTest, EndsWithItsObject) {
  const auto start = std::chrono::steady_clock::now();
  { const ChildProcess child({"sleep", "60"}); }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST_F(ChildProcessTest, CanBeCancelledFromAnotherThread) {
  ChildProcess child({"sleep", "60"});
  std::thread other([&] { child.cancel(); });
  EXPECT_FALSE(child.write(std::string(1 << 22, 'x'), soon()));
  other.join();
  EXPECT_EQ(child.finish(soon()).signal, SIGKILL);
}

TEST_F(ChildProcessTest, StopsForAHeldSignal) {
  const HeldSignals held;
  ChildProcess child({"sh", "-c", "kill -TERM " + std::to_string(::getpid()) + "; sleep 60"});
  EXPECT_THROW(static_cast<void>(child.write(std::string(1 << 22, 'x'), soon())), Interrupted);
}

TEST_F(ChildProcessTest, SaysWhatCannotBeStarted) {
  ChildProcess missing({"no-such-program-here"});
  EXPECT_FALSE(missing.write(std::string(1 << 22, 'x'), soon()));
  const ProcessResult result = missing.finish(soon());
  EXPECT_FALSE(result.started);
  EXPECT_EQ(result.error, "No such file or directory");
  EXPECT_REX_ERROR(ChildProcess({}), "no program to run");
}

}  // namespace rex::process_test
