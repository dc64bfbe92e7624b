#include "base/process.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interruption.h"
#include "support/expect_error.h"

namespace rex::child_process_test {

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

}  // namespace rex::child_process_test
