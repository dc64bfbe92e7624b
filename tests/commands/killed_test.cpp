// Commands that change what students would miss, killed before each of their calls to the system: between two
// of them nothing changes on the disk, so these are all moments that there are.
#include <csignal>
#include <functional>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include "commands/built_project.h"

namespace rex::cli::killed_test {

class Killed : public BuiltProject {
 protected:
  fs::path main() const { return exercise() / "main.cpp"; }

  // Runs the command and kills it at the `stop`-th time that it enters or leaves the system; false: it had
  // ended before. Nothing: this machine lets nobody trace.
  std::optional<bool> killAt(int stop, const std::vector<const char*>& words) const {
    const pid_t child = ::fork();
    if (child == 0) run(words);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (!WIFSTOPPED(status)) return {};
    ::ptrace(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_EXITKILL);
    for (int k = 0; k < stop; ++k) {
      ::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
      ::waitpid(child, &status, 0);
      if (!WIFSTOPPED(status)) return false;
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    return true;
  }

  // Before each round `prepare`, after each `look`. The number of moments.
  int atEveryMoment(const std::vector<const char*>& words, const std::function<void()>& prepare,
                    const std::function<void()>& look) const {
    for (int stop = 1;; ++stop) {
      prepare();
      const std::optional<bool> killed = killAt(stop, words);
      if (!killed) return 0;
      look();
      if (!*killed || HasFailure()) return stop;
    }
  }

 private:
  [[noreturn]] void run(const std::vector<const char*>& words) const {
    const int quiet = ::open("/dev/null", O_WRONLY);
    ::dup2(quiet, STDOUT_FILENO), ::dup2(quiet, STDERR_FILENO);
    if (::ptrace(PTRACE_TRACEME) != 0) ::_exit(99);
    ::raise(SIGSTOP);
    std::vector<const char*> argv = {"rex"};
    argv.insert(argv.end(), words.begin(), words.end());
    ::_exit(runRex(static_cast<int>(argv.size()), argv.data(), {root(), build()}));
  }
};

TEST_F(Killed, ResetLosesNothing) {
  const std::string starter = fileText(main()), mine = kGood;
  const fs::path backup = exercise() / "main.backup-1.cpp";
  int mineCount = 0, starterCount = 0;
  const int moments = atEveryMoment(
      {"reset", "98"},
      [&] {
        fs::remove(backup);
        write(main(), mine);
      },
      [&] {
        const std::string now = fileText(main());
        const bool isMine = now == mine;
        EXPECT_TRUE(isMine || now == starter) << now;
        EXPECT_TRUE(isMine || fs::exists(backup));
        EXPECT_TRUE(!fs::exists(backup) || fileText(backup) == mine);
        ++(isMine ? mineCount : starterCount);
      });
  if (moments == 0) GTEST_SKIP() << "no process may trace another here";
  EXPECT_GT(mineCount, 20);
  EXPECT_GT(starterCount, 2);
}

TEST_F(Killed, SubmitLeavesTheOldArchiveOrTheNewOne) {
  const fs::path zip = root() / "handin.zip";
  const std::string target = zip.string(), old = "what was handed in before", mine = kGood;
  write(main(), mine);
  ASSERT_EQ(rex({"submit", "98", "-o", target}).code, 0);
  const std::string whole = fileText(zip);
  for (const bool isFirst : {true, false}) {
    int oldCount = 0, newCount = 0;
    const int moments = atEveryMoment(
        {"submit", "98", "-o", target.c_str()},
        [&] {
          fs::remove(zip);
          if (!isFirst) write(zip, old);
        },
        [&] {
          const bool isOld = isFirst ? !fs::exists(zip) : fileText(zip) == old;
          EXPECT_TRUE(isOld || fileText(zip) == whole);
          EXPECT_EQ(fileText(main()), mine);
          ++(isOld ? oldCount : newCount);
        });
    if (moments == 0) GTEST_SKIP() << "no process may trace another here";
    EXPECT_GT(oldCount, 20);
    EXPECT_GT(newCount, 2);
  }
}

}  // namespace rex::cli::killed_test
