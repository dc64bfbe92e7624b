// Commands with robots as processes: their ends by signals, and their memory.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/process.h"
#include "commands/rex_program.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"
#include "support/paths.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace rex::cli::processes_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

class RenderInterruption : public ::testing::Test {
 protected:
  // Starts `rex render pegArm` with these arguments in our folder; what it notes goes into the file "notes".
  pid_t start(std::vector<const char*> arguments) const {
    const std::string program = buildPath("rex-robot");
    arguments.insert(arguments.begin(), {program.c_str(), "render", "pegArm"});
    arguments.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child > 0) return child;
    if (::chdir(folder_.path().c_str()) != 0) ::_exit(127);
    ::dup2(::open("notes", O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    ::execv(arguments[0], const_cast<char* const*>(arguments.data()));
    ::_exit(127);
  }

  // The signal that ended the program, or 0. It takes one second at most to draw a picture.
  static int endOf(pid_t child) {
    int status = 0;
    for (int k = 0; k < 1500; ++k) {
      if (::waitpid(child, &status, WNOHANG) == child) return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    return 0;
  }

  bool hasNotes() const {
    return fs::exists(folder_.path() / "notes") && fs::file_size(folder_.path() / "notes") > 0;
  }
  int files() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

  TemporaryFolder folder_;
};

TEST_F(RenderInterruption, EndsAFilmAndLeavesNoPart) {
  REX_NEEDS_OSMESA();
  if (!runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "install ffmpeg";
  const pid_t rex = start({"--size", "1600x1200", "-o", "a.webm"});
  ASSERT_TRUE(waitUntil([&] { return files() == 2; })) << "the video in the making";
  ::kill(rex, SIGINT);
  EXPECT_EQ(endOf(rex), SIGINT);
  EXPECT_EQ(files(), 1);
}

TEST_F(RenderInterruption, EndsFramesAndLeavesWholeOnes) {
  REX_NEEDS_OSMESA();
  const fs::path frames = folder_.path() / "frames";
  const pid_t rex = start({"--size", "1600x1200", "-o", "frames"});
  ASSERT_TRUE(waitUntil([&] { return fs::exists(frames / "0000.png"); }));
  ::kill(rex, SIGINT);
  EXPECT_EQ(endOf(rex), SIGINT);
  EXPECT_FALSE(fs::exists(frames / "0119.png"));
  for (const auto& entry : fs::directory_iterator(frames)) EXPECT_EQ(entry.path().extension(), ".png");
}

// The renderer is noted before the first of 60 pictures is drawn.
TEST_F(RenderInterruption, EndsASheet) {
  REX_NEEDS_OSMESA();
  std::vector<const char*> arguments = {"--size", "1600x1200", "-o", "a.png", "--q", "0,0,0", "--q", "1,1,1"};
  for (int i = 0; i < 10; ++i) arguments.insert(arguments.end(), {"--camera", "front"});
  const pid_t rex = start(arguments);
  ASSERT_TRUE(waitUntil([&] { return hasNotes(); }));
  ::kill(rex, SIGTERM);
  EXPECT_EQ(endOf(rex), SIGTERM);
  EXPECT_EQ(files(), 1);
}

class ViewProcess : public RexProgram {
 protected:
  // Interrupted after a second, as by Ctrl-C.
  ProcessResult view(const std::vector<std::string>& variables,
                     const std::vector<std::string>& options) const {
    std::vector<std::string> words = {"env",     "-u", "SSH_CONNECTION", "-u",
                                      "DISPLAY", "-u", "WAYLAND_DISPLAY"};
    words.insert(words.end(), variables.begin(), variables.end());
    words.insert(words.end(), {"timeout", "--preserve-status", "--signal=INT", "1", buildPath("rex-robot"),
                               "view", "arm3"});
    words.insert(words.end(), options.begin(), options.end());
    return runProcess(words, {.timeout = 60});
  }
};

TEST_F(ViewProcess, SaysItsAddressFirstAndEndsWithoutComplaint) {
  const ProcessResult result = view({}, {"--no-browser"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_THAT(result.output.substr(0, result.output.find('\n')),
              MatchesRegex("http://127\\.0\\.0\\.1:[0-9]+/[0-9a-f]+/"));
  EXPECT_THAT(result.output, ::testing::Not(HasSubstr("ssh")));
}

TEST_F(ViewProcess, SaysHowToForwardThePort) {
  const ProcessResult result =
      view({"SSH_CONNECTION=192.0.2.1 50000 192.0.2.2 22", "USER=ada", "DISPLAY=:9"}, {});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_THAT(result.output, HasSubstr("run: ssh -N -L "));
  EXPECT_THAT(result.output, HasSubstr(" ada@192.0.2.2\n"));
}

using SimulateProcess = RexProgram;

// What a log has written is not kept: ten times the steps take no more memory.
TEST_F(SimulateProcess, KeepsNoStepsOfALog) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "sanitizers keep for a while what is freed";
#endif
  REX_NEEDS_GNUPLOT();
  std::string scene = "body world { }\n";
  for (int i = 0; i < 300; ++i)
    scene += fmt::format(
        "body b{0} {{ type=0 size=[.1 .1 .1 0] mass=1 }}\njoint (world b{0}) {{ type=free A=<T t({1} {2} 5)> "
        "}}\n",
        i, .3 * (i % 20), .3 * (i / 20));
  std::ofstream(in("boxes.ors")) << scene;
  const auto megabytes = [&](const char* seconds) {
    const ProcessResult run =
        runProcess({"python3", "-c",
                    "import resource, subprocess, sys\nsubprocess.run(sys.argv[1:], check=True, stdout=2)\n"
                    "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024)",
                    buildPath("rex-robot"), "simulate", in("boxes.ors").string(), "--engine", "bullet",
                    "--seconds", seconds, "--no-film", "-o", in(seconds).string()},
                   {.timeout = 300});
    EXPECT_TRUE(run.ok()) << run.error;
    return std::stod("0" + run.output);
  };
  const double shortRun = megabytes("0.1"), longRun = megabytes("1");
  EXPECT_GT(shortRun, 5);
  EXPECT_LT(longRun, shortRun + 10);
}

}  // namespace rex::cli::processes_test
