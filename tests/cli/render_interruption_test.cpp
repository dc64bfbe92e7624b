// Ctrl-C while `rex render` draws.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/process.h"
#include "support/needs_osmesa.h"
#include "support/temporary_folder.h"

namespace rex::cli::render_interruption_test {

namespace fs = std::filesystem;

class RenderInterruption : public ::testing::Test {
 protected:
  // Starts `rex render pegArm` with these arguments in our folder; what it notes goes into the file "notes".
  pid_t start(std::vector<const char*> arguments) const {
    arguments.insert(arguments.begin(), {REX_BINARY_DIR "/rex-robot", "render", "pegArm"});
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

  static bool waitUntil(const std::function<bool()>& holds) {
    for (int k = 0; k < 3000; ++k) {
      if (holds()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
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

}  // namespace rex::cli::render_interruption_test
