#include "base/interruption.h"

#include <chrono>
#include <csignal>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/process.h"

namespace rex::interruption_test {

// A shell that sends this process a signal, then tells by its own end how it was treated.
std::vector<std::string> signalling(const std::string& name, const std::string& then) {
  return {"bash", "-c", "kill -" + name + " " + std::to_string(::getpid()) + "; " + then};
}

int interruptedBy(const std::vector<std::string>& program) {
  try {
    static_cast<void>(runProcess(program, {.timeout = 30}));
  } catch (const Interrupted& stop) {
    return stop.signal;
  }
  return 0;
}

TEST(HeldSignals, EndTheProgramThatRuns) {
  const HeldSignals held;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(interruptedBy(signalling("INT", "sleep 60")), SIGINT);
  EXPECT_EQ(interruptedBy(signalling("TERM", "sleep 60 & sleep 60")), SIGTERM);
  EXPECT_EQ(interruptedBy(signalling("HUP", "trap '' HUP; while :; do sleep 60; done")), SIGHUP);
  // Also when its output has ended.
  EXPECT_EQ(
      interruptedBy({"bash", "-c",
                     "exec >&- 2>&-; sleep 0.1; kill -TERM " + std::to_string(::getpid()) + "; sleep 60"}),
      SIGTERM);
  EXPECT_EQ(interruptedBy({"true"}), 0);
  // Each of the sleeps would have taken a minute.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST(HeldSignals, WaitForTheNextProgram) {
  const HeldSignals held;
  ::kill(::getpid(), SIGINT);
  EXPECT_EQ(interruptedBy({"sleep", "60"}), SIGINT);
}

TEST(HeldSignals, ArePassedToAProgramThatSharesOurOutput) {
  const HeldSignals held;
  const auto run = [](const std::string& name) {
    return runProcess(signalling(name, "sleep 0.5; exit 7"), {.inheritOutput = true});
  };
  EXPECT_EQ(run("TERM").signal, SIGTERM);
  EXPECT_EQ(run("INT").exitCode, 7) << "Ctrl-C comes from the terminal";
}

TEST(HeldSignals, LeaveIgnoredSignalsIgnored) {
  void (*before)(int) = std::signal(SIGINT, SIG_IGN);
  const HeldSignals held;
  EXPECT_EQ(interruptedBy(signalling("INT", "exit 0")), 0);
  std::signal(SIGINT, before);
}

int caught() {
  try {
    throwIfInterrupted();
  } catch (const Interrupted& stop) {
    return stop.signal;
  }
  return 0;
}

TEST(ThrowIfInterrupted, TakesEachHeldSignalOnce) {
  const HeldSignals held;
  EXPECT_EQ(caught(), 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    ::kill(::getpid(), signal);
    EXPECT_EQ(caught(), signal);
    EXPECT_EQ(caught(), 0);
  }
  ::kill(::getpid(), SIGTERM);
  ::kill(::getpid(), SIGINT);
  EXPECT_EQ(caught() + caught(), SIGINT + SIGTERM);
  EXPECT_EQ(caught(), 0);
}

volatile std::sig_atomic_t handled = 0;

TEST(ThrowIfInterrupted, LeavesSignalsAloneThatNobodyHolds) {
  void (*before)(int) = std::signal(SIGTERM, [](int signal) { handled = signal; });
  ::kill(::getpid(), SIGTERM);
  EXPECT_EQ(caught(), 0);
  EXPECT_EQ(handled, SIGTERM);
  std::signal(SIGTERM, before);
}

TEST(ThrowIfInterrupted, LeavesIgnoredSignalsIgnored) {
  void (*before)(int) = std::signal(SIGHUP, SIG_IGN);
  {
    const HeldSignals held;
    ::kill(::getpid(), SIGHUP);
    EXPECT_EQ(caught(), 0);
  }
  std::signal(SIGHUP, before);
}

}  // namespace rex::interruption_test
