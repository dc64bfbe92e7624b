#include "base/isolated_call.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interruption.h"
#include "support/expect_error.h"

namespace rex::isolated_call_test {

std::string nothing() { return {}; }

std::size_t openDescriptors() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

// Whether no process of ours is left, running or not waited for.
bool isChildless() { return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD; }

TEST(CallIsolated, ReturnsBytes) {
  const std::string bytes("a\0b", 3);
  const IsolatedResult result = callIsolated([&] { return bytes; });
  EXPECT_EQ(result.end, IsolatedEnd::kReturned);
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.bytes, bytes);
  EXPECT_EQ(callIsolated(nothing).end, IsolatedEnd::kReturned);
}

TEST(CallIsolated, ReturnsManyBytes) {
  std::string large(100'000'000, '\0');
  std::iota(large.begin(), large.end(), '\0');
  EXPECT_TRUE(callIsolated([&] { return large; }).bytes == large);
}

TEST(CallIsolated, ChangesNothingHere) {
  int value = 1;
  EXPECT_EQ(callIsolated([&] { return std::to_string(++value); }).bytes, "2");
  EXPECT_EQ(value, 1);
}

TEST(CallIsolated, ThrowsTheErrorOfTheFunction) {
  const ErrorParts sent{.what = "what",
                        .where = {.file = "file", .line = 12, .column = 3},
                        .found = "found",
                        .wanted = std::string("wan\0ted", 7),
                        .nearest = {"one", "", "three"}};
  try {
    static_cast<void>(callIsolated([&]() -> std::string { throw Error(sent); }));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), Error(sent).what());
    EXPECT_EQ(error.parts().wanted, sent.wanted);
    EXPECT_EQ(error.parts().nearest, sent.nearest);
  }
}

TEST(CallIsolated, SurvivesCrashes) {
  const IsolatedResult aborted = callIsolated([]() -> std::string { std::abort(); });
  EXPECT_EQ(aborted.end, IsolatedEnd::kCrashed);
  EXPECT_EQ(aborted.signal, SIGABRT);
  EXPECT_EQ(aborted.exitCode, -1);
  EXPECT_EQ(callIsolated([] { return ::raise(SIGSEGV), std::string("unseen"); }).signal, SIGSEGV);
  EXPECT_EQ(callIsolated([] { return ::kill(::getpid(), SIGKILL), std::string("unseen"); }).end,
            IsolatedEnd::kCrashed);
  EXPECT_EQ(callIsolated([]() -> std::string { throw std::runtime_error("other"); }).signal, SIGABRT);
}

TEST(CallIsolated, TellsOfAnExit) {
  const IsolatedResult result = callIsolated([]() -> std::string { ::_exit(7); });
  EXPECT_EQ(result.end, IsolatedEnd::kCrashed);
  EXPECT_EQ(result.exitCode, 7);
  EXPECT_EQ(callIsolated([]() -> std::string { ::_exit(0); }).end, IsolatedEnd::kCrashed);
}

TEST(CallIsolated, EndsWhatTakesTooLong) {
  const auto loop = []() -> std::string {
    for (;;) static_cast<void>(::getppid());
  };
  const IsolatedResult busy = callIsolated(loop, {.cpuSeconds = 1});
  EXPECT_EQ(busy.end, IsolatedEnd::kTookTooLong);
  EXPECT_EQ(busy.signal, SIGXCPU);
  const auto wait = [] { return ::pause(), std::string(); };
  EXPECT_EQ(callIsolated(wait, {.wallSeconds = 0.1}).end, IsolatedEnd::kTookTooLong);
  EXPECT_TRUE(isChildless());
}

#ifndef __SANITIZE_ADDRESS__  // sanitizers reserve all addresses
TEST(CallIsolated, BoundsMemoryBeyondThatOfTheCaller) {
  const std::vector<char> ours(400u << 20);
  const auto fill = [](std::size_t bytes) {
    return [=] { return std::to_string(std::vector<char>(bytes, 'x').size()); };
  };
  EXPECT_EQ(callIsolated(fill(100u << 20), {.memory = 200u << 20}).bytes, "104857600");
  const IsolatedResult result = callIsolated(fill(300u << 20), {.memory = 200u << 20});
  EXPECT_EQ(result.end, IsolatedEnd::kOutOfMemory);
  EXPECT_EQ(result.signal, 0);
}
#endif

TEST(CallIsolated, RefusesMoreBytesThanMemory) {
  const auto claim = [] { return std::string(2u << 20, 'x'); };
  EXPECT_NE(callIsolated(claim, {.memory = 1u << 20}).end, IsolatedEnd::kReturned);
}

TEST(CallIsolated, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_EQ(callIsolated([] {
              std::puts("lost"), std::fputs("lost", stderr), std::fflush(nullptr);
              return std::string("x");
            }).bytes,
            "x");
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST(CallIsolated, LeavesNoProcessAndNoDescriptor) {
  const std::size_t before = openDescriptors();
  static_cast<void>(callIsolated(nothing));
  static_cast<void>(callIsolated([]() -> std::string { std::abort(); }));
  EXPECT_REX_ERROR(callIsolated([]() -> std::string { throw Error({.what = "no"}); }), "no");
  EXPECT_EQ(openDescriptors(), before);
  EXPECT_TRUE(isChildless());
}

TEST(CallIsolated, RunsNoHandlerOfTheCaller) {
  static volatile std::sig_atomic_t seen = 0;
  const auto before = ::signal(SIGUSR1, [](int) { seen = 1; });
  EXPECT_EQ(callIsolated([] { return ::raise(SIGUSR1), std::string("unseen"); }).signal, SIGUSR1);
  ::signal(SIGUSR1, before);
  EXPECT_EQ(seen, 0);
}

TEST(CallIsolated, GivesWayToARequestToStop) {
  const HeldSignals held;
  const auto askAndWait = [] { return ::kill(::getppid(), SIGTERM), ::pause(), std::string(); };
  EXPECT_THROW(static_cast<void>(callIsolated(askAndWait)), Interrupted);
  EXPECT_TRUE(isChildless());
}

TEST(CallIsolated, WorksBesideThreadsThatAllocate) {
  std::atomic<bool> stop = false;
  std::vector<std::thread> threads;
  for (int i = 0; i < 2; ++i)
    threads.emplace_back([&] {
      while (!stop) static_cast<void>(std::vector<int>(1'000).data());
    });
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(callIsolated([] { return std::to_string(std::string(100'000, 'x').size()); }).bytes, "100000");
  stop = true;
  for (std::thread& thread : threads) thread.join();
}

TEST(CallIsolated, WorksInAnyThread) {
  std::string bytes;
  std::thread([&] { bytes = callIsolated([] { return std::string("there"); }).bytes; }).join();
  EXPECT_EQ(bytes, "there");
}

TEST(CallIsolated, TellsThatThereIsNoProcessLeft) {
  const auto starve = []() -> std::string {
    const rlimit none{0, 0};
    if (::geteuid() == 0 && (::setgid(65534) != 0 || ::setuid(65534) != 0)) return "root";
    ::setrlimit(RLIMIT_NPROC, &none);
    return callIsolated(nothing).bytes;
  };
  EXPECT_REX_ERROR(callIsolated(starve), "cannot start a process: found Resource temporarily unavailable");
}

}  // namespace rex::isolated_call_test
