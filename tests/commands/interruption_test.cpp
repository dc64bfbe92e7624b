#include "base/interruption.h"

#include <csignal>
#include <fstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "commands/all_commands.h"
#include "support/paths.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace rex::cli::interruption_test {

namespace fs = std::filesystem;

constexpr int kDefinitelyInterrupted = 99;

// A project whose build folder nobody else uses, and the program working on it in a process of its own.
class InterruptionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* file : {"exercise.h", "exercise.toml"}) {
      fs::create_directories(root() / "exercises" / "98-template");
      fs::copy(buildPath("tests/template/source") / file, root() / "exercises" / "98-template");
    }
    fs::create_directories(build());
    fs::create_directories(temporary());
    for (const char* file : {"build.json", "grader"})
      fs::create_symlink(buildPath("tests/template/exercises/98-template") / file, build() / file);
  }

  fs::path root() const { return temporary_.path(); }
  fs::path temporary() const { return root() / "tmp"; }
  fs::path build() const { return root() / "build" / "exercises" / "98-template"; }

  // Starts `rex test 98` on a file with this text.
  pid_t start(const std::string& source) const {
    std::ofstream(root() / "exercises" / "98-template" / "main.cpp") << source;
    return start(std::vector<std::string>{"test", "98"});
  }
  pid_t start(const std::vector<std::string>& words) const {
    const pid_t rex = ::fork();
    if (rex < 0) throw std::runtime_error("cannot fork");
    if (rex > 0) return rex;
    const int quiet = ::open("/dev/null", O_WRONLY);
    ::dup2(quiet, STDOUT_FILENO);
    ::dup2(quiet, STDERR_FILENO);
    try {
      const HeldSignals held;
      std::vector<const char*> arguments = {"rex"};
      for (const std::string& word : words) arguments.push_back(word.c_str());
      ::setenv("TMPDIR", temporary().c_str(), 1);
      ::_exit(runRex(static_cast<int>(arguments.size()), arguments.data(), {root(), root() / "build"}));
    } catch (const Interrupted&) {
      ::_exit(kDefinitelyInterrupted);
    }
  }

  static int exitCodeAfter(int signal, pid_t rex) {
    ::kill(rex, signal);
    int status = 0;
    ::waitpid(rex, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  // Processes that work in our folders: compilers, the worker and what it started.
  int processes() const {
    int count = 0;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::error_code gone;
      const std::string folder = fs::read_symlink(entry.path() / "cwd", gone).string();
      if (folder.starts_with(root().string())) ++count;
    }
    return count;
  }

  void expectNothingLeft() const {
    EXPECT_TRUE(waitUntil([&] { return processes() == 0; })) << processes();
    for (const auto& entry : fs::directory_iterator(build())) EXPECT_TRUE(entry.is_symlink()) << entry.path();
    EXPECT_TRUE(fs::is_empty(temporary()));
  }

  TemporaryFolder temporary_;
};

TEST_F(InterruptionTest, EndsAStudentsProgramThatHangsAndWhatItStarted) {
  const fs::path mark = root() / "started";
  const std::string source = fmt::format(R"(#include <fstream>
#include <functional>
#include <unistd.h>
#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d&, double) {{
  if (fork() == 0) {{
    setsid();
    if (fork() == 0) std::ofstream("{}") << "yes";
    for (;;) sleep(1000);
  }}
  for (;;) sleep(1000);
}}
int main() {{}}
)",
                                         mark.string());
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t rex = start(source);
    ASSERT_TRUE(waitUntil([&] { return fs::exists(mark); }));
    EXPECT_GE(processes(), 3);
    EXPECT_EQ(exitCodeAfter(signal, rex), kDefinitelyInterrupted);
    expectNothingLeft();
    fs::remove(mark);
  }
}

TEST_F(InterruptionTest, EndsACompilerThatWorks) {
  const pid_t rex = start(
      "template <int N, long M> struct F { static const int v = F<N - 1, 2 * M>::v + F<N - 1, 2 * M + "
      "1>::v; };\ntemplate <long M> struct F<0, M> { static const int v = 1; };\nint x = F<60, 0>::v;\n");
  ASSERT_TRUE(waitUntil([&] { return processes() >= 2; }));
  EXPECT_EQ(exitCodeAfter(SIGINT, rex), kDefinitelyInterrupted);
  expectNothingLeft();
}

// A class of two: what is graded stays graded, what is not begins again.
class GradingManyInterrupted : public InterruptionTest {
 protected:
  void handIn(const std::string& student, const std::string& body) const {
    fs::create_directories(root() / "in" / student / "98");
    std::ofstream(root() / "in" / student / "98" / "main.cpp")
        << "#include \"exercise.h\"\n#include <fstream>\n#include <unistd.h>\n"
           "Eigen::Vector2d rotated(const Eigen::Vector2d& p, double) {\n"
        << body << "return p;\n}\nint main() {}\n";
  }
  pid_t startGrading() const {
    return start({"grade", (root() / "in").string(), "--out", (root() / "out").string(), "-j2", "--level",
                  "0", "--i-accept-level", "0"});
  }
  fs::path result(const std::string& student) const {
    return root() / "out" / student / "98-template" / "results.json";
  }
  // What is known before the hidden checks, which wait until everybody's visible ones are graded.
  fs::path firstPass(const std::string& student) const {
    return result(student).parent_path() / "visible" / "results.json";
  }
};

TEST_F(GradingManyInterrupted, KeepsWhatIsDoneAndGoesOn) {
  const fs::path mark = root() / "started";
  handIn("done", "");
  handIn("hangs", fmt::format("std::ofstream(\"{}\") << 1; for (;;) sleep(1000);\n", mark.string()));
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    SCOPED_TRACE(signal);
    const pid_t rex = startGrading();
    ASSERT_TRUE(waitUntil([&] { return fs::exists(mark) && fs::exists(firstPass("done")); }));
    const auto first = fs::last_write_time(firstPass("done"));
    EXPECT_EQ(exitCodeAfter(signal, rex), signal == SIGKILL ? -1 : kDefinitelyInterrupted);
    // Nobody can tidy up after a kill.
    EXPECT_TRUE(waitUntil([&] { return processes() == 0; }));
    if (signal == SIGKILL) fs::remove_all(temporary()), fs::create_directories(temporary());
    expectNothingLeft();
    EXPECT_FALSE(fs::exists(result("hangs")));
    EXPECT_EQ(fs::last_write_time(firstPass("done")), first) << "graded once";
    fs::remove(mark);
  }
  handIn("hangs", "");
  EXPECT_EQ(exitCodeAfter(0, startGrading()), 0);
  for (const char* student : {"done", "hangs"}) {
    EXPECT_TRUE(fs::exists(result(student)));
    EXPECT_FALSE(fs::exists(firstPass(student).parent_path()));
  }
}

}  // namespace rex::cli::interruption_test
