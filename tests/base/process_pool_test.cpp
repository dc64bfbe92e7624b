#include "base/process_pool.h"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/interruption.h"
#include "support/temporary_folder.h"

namespace rex::process_pool_test {

namespace fs = std::filesystem;

class ProcessPoolTest : public ::testing::Test {
 protected:
  fs::path file(const std::string& kind, int k) const { return folder_.path() / (kind + std::to_string(k)); }
  static void write(const fs::path& file) { std::ofstream(file) << "x"; }
  int count(const std::string& kind) const {
    int found = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      if (entry.path().filename().string().starts_with(kind)) ++found;
    return found;
  }
  // Waits, but not for ever.
  bool waitUntil(const std::function<bool()>& holds) const {
    for (int k = 0; k < 6000; ++k, std::this_thread::sleep_for(std::chrono::milliseconds(5)))
      if (holds()) return true;
    return false;
  }

  TemporaryFolder folder_;
};

TEST_F(ProcessPoolTest, CallsEachOnceAndTellsItsCode) {
  for (const int parallel : {1, 3, 50}) {
    std::map<int, int> codes;
    forkMap(
        20, parallel, [](int k) { return k % 7; }, [&](int k, int code) { codes[k] += 1 + 10 * code; });
    EXPECT_EQ(codes.size(), 20u);
    for (const auto& [k, code] : codes) EXPECT_EQ(code, 1 + 10 * (k % 7)) << k;
  }
}

TEST_F(ProcessPoolTest, EndsCopiesThatWorkTooLong) {
  std::map<int, int> codes;
  const auto work = [](int k) {
    [[maybe_unused]] volatile int steps = 0;
    for (int i = 0; k == 0; i ^= 1) steps = i;
    return k;
  };
  forkMap(
      2, 2, work, [&](int k, int code) { codes[k] = code; }, 1);
  EXPECT_EQ(codes, (std::map<int, int>{{0, -SIGXCPU}, {1, 1}}));
}

TEST_F(ProcessPoolTest, RunsAsManyAtOnceAsAsked) {
  // Each waits until three have begun: with fewer at once it would give up.
  std::map<int, int> codes;
  forkMap(
      3, 3,
      [&](int k) {
        write(file("begun", k));
        return waitUntil([&] { return count("begun") == 3; }) ? 0 : 1;
      },
      [&](int k, int code) { codes[k] = code; });
  EXPECT_EQ(codes, (std::map<int, int>{{0, 0}, {1, 0}, {2, 0}}));
  int most = 0;
  forkMap(
      12, 2,
      [&](int k) {
        write(file("working", k));
        const int together = count("working");
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        fs::remove(file("working", k));
        return together;
      },
      [&](int, int code) { most = std::max(most, code); });
  EXPECT_LE(most, 2);
}

TEST_F(ProcessPoolTest, OutlivesWhatBreaksInOne) {
  std::map<int, int> codes;
  forkMap(
      5, 2,
      [](int k) {
        if (k == 1) ::raise(SIGKILL);
        if (k == 2) throw 42;
        if (k == 3) std::abort();
        return 0;
      },
      [&](int k, int code) { codes[k] = code; });
  EXPECT_EQ(codes, (std::map<int, int>{{0, 0}, {1, -SIGKILL}, {2, 3}, {3, -SIGABRT}, {4, 0}}));
}

TEST_F(ProcessPoolTest, PassesARequestToStopOnAndWaits) {
  const HeldSignals held;
  const pid_t self = ::getpid();
  const auto job = [&](int k) {
    write(file("begun", k));
    if (k == 1 && waitUntil([&] { return count("begun") == 2; })) ::kill(self, SIGTERM);
    try {
      static_cast<void>(waitUntil([] {
        throwIfInterrupted();
        return false;
      }));
    } catch (const Interrupted&) {
      write(file("tidied", k));
      throw;
    }
    return 0;
  };
  try {
    forkMap(9, 2, job, [](int, int) {});
    FAIL() << "was not interrupted";
  } catch (const Interrupted& stop) {
    EXPECT_EQ(stop.signal, SIGTERM);
  }
  EXPECT_EQ(count("begun"), 2);
  EXPECT_EQ(count("tidied"), 2);
}

}  // namespace rex::process_pool_test
