#include "grading/worker_failure.h"

#include <csignal>

#include <gtest/gtest.h>

#include "remote/worker.h"

namespace rex::grading::worker_failure_test {

const Limits kLimits{.cpuSeconds = 2, .memory = 64 * kMegabyte};

Failure bySignal(int signal, double cpuSeconds = 0, bool ready = true) {
  return explainEnd(
      {.status = signal, .cpuSeconds = cpuSeconds, .ready = ready, .function = ready ? "f" : ""}, kLimits);
}

Failure byExit(int code, bool ready = true) {
  return explainEnd(
      {.status = code << 8, .ready = ready, .function = ready ? "f" : "", .errorTail = "no such library"},
      kLimits);
}

TEST(ExplainEnd, NamesTheSignal) {
  EXPECT_EQ(bySignal(SIGSEGV).message,
            "crashed with a segmentation fault in f (an index out of range, or infinite recursion?)");
  EXPECT_EQ(bySignal(SIGBUS).message, bySignal(SIGSEGV).message);
  EXPECT_EQ(
      bySignal(SIGSEGV, 0, false).message,
      "crashed with a segmentation fault before the first call (in the constructor of a global variable, or "
      "do the global variables need more than 64 MB?)");
  EXPECT_EQ(bySignal(SIGFPE).message, "crashed with an integer division by zero in f");
  EXPECT_EQ(bySignal(SIGILL).message, "crashed with an illegal instruction in f (a missing return?)");
  EXPECT_EQ(bySignal(SIGABRT).message, "aborted in f");
  EXPECT_EQ(bySignal(SIGTERM).message, "was ended by signal 15 (Terminated) in f");
  EXPECT_EQ(bySignal(SIGXFSZ).outcome, Outcome::kOutputLimit);
  EXPECT_EQ(bySignal(SIGXFSZ).message, "wrote a file that is too large in f");
}

TEST(ExplainEnd, KnowsWhatTheSandboxForbids) {
  EXPECT_EQ(bySignal(SIGSYS).outcome, Outcome::kSecurityEvent);
  EXPECT_EQ(bySignal(SIGSYS).message.find("tried something that the sandbox forbids in f"), 0u);
}

TEST(ExplainEnd, BelievesTheKernelAboutMemory) {
  const Failure failure = explainEnd({.status = SIGKILL, .function = "f", .outOfMemory = true}, kLimits);
  EXPECT_EQ(failure.outcome, Outcome::kMemoryLimit);
  EXPECT_EQ(failure.message, "used more than 64 MB of memory in f");
}

TEST(ExplainEnd, TellsTheTimeLimitFromOtherKills) {
  EXPECT_EQ(bySignal(SIGXCPU).outcome, Outcome::kTimeLimit);
  EXPECT_EQ(bySignal(SIGXCPU).message, "stopped after 2.0 s of CPU time in f");
  EXPECT_EQ(bySignal(SIGKILL, 3).outcome, Outcome::kTimeLimit);
  EXPECT_EQ(bySignal(SIGKILL, 1).outcome, Outcome::kRuntimeError);
  EXPECT_EQ(bySignal(SIGKILL, 1).message, "was killed in f");
  EXPECT_TRUE(bySignal(SIGKILL, 1).mayBeOfMachine);
  EXPECT_FALSE(bySignal(SIGKILL, 3).mayBeOfMachine);
}

TEST(ExplainEnd, NamesTheExitCode) {
  EXPECT_EQ(byExit(0).message, "called exit(0) in f");
  EXPECT_EQ(byExit(3, false).message,
            "called exit(3) before the first call (in the constructor of a global variable?)");
  EXPECT_EQ(byExit(127, false).message, "could not be loaded");
  EXPECT_EQ(byExit(127, false).detail, "no such library");
  EXPECT_EQ(byExit(remote::kProtocolFailure).outcome, Outcome::kProtocolError);
  EXPECT_EQ(byExit(remote::kProtocolFailure).message, "lost its connection to the grader in f");
  EXPECT_EQ(failurePlace(true, ""), "between two calls");
}

TEST(ExplainEnd, KnowsAnExceptionForWantOfMemory) {
  for (const char* type : {"std::bad_alloc", "St9bad_alloc"}) {
    const Failure failure = explainEnd(
        {.status = SIGABRT,
         .ready = true,
         .function = "f",
         .errorTail = std::string("terminate called after throwing an instance of '") + type + "'\n"},
        kLimits);
    EXPECT_EQ(failure.outcome, Outcome::kMemoryLimit);
    EXPECT_EQ(failure.message, "used more than 64 MB of memory in f");
  }
}

TEST(ExplainThrow, KeepsTheStudentsTextApart) {
  const Failure failure =
      explainThrow({"f", {.kind = remote::Thrown::Kind::kException, .type = "E", .text = "secret"}}, kLimits);
  EXPECT_EQ(failure.outcome, Outcome::kRuntimeError);
  EXPECT_EQ(failure.message, "threw E in f");
  EXPECT_EQ(failure.detail, "secret");
  const Failure memory = explainThrow({"f", {.kind = remote::Thrown::Kind::kBadAlloc}}, kLimits);
  EXPECT_EQ(memory.outcome, Outcome::kMemoryLimit);
  EXPECT_EQ(memory.message, "used more than 64 MB of memory in f");
  EXPECT_EQ(failure.function, "f");
  EXPECT_EQ(memory.function, "f");
}

TEST(TellsOfCrash, OfSignalsButNotOfOtherEnds) {
  const auto ended = [](int status) {
    return explainEnd({.status = status, .function = "f"}, kLimits).message;
  };
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP})
    EXPECT_TRUE(tellsOfCrash(ended(signal))) << ended(signal);
  for (const int status : {SIGXCPU, SIGXFSZ, 0, 3 << 8}) EXPECT_FALSE(tellsOfCrash(ended(status)));
  EXPECT_FALSE(tellsOfCrash("threw E in f"));
  EXPECT_FALSE(tellsOfCrash("position: got 1 m, wanted 2 m"));
}

}  // namespace rex::grading::worker_failure_test
