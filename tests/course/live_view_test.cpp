#include "course/live_view.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "course/simulator.h"
#include "render/picture.h"
#include "support/temporary_folder.h"

namespace rex::live_view_test {

using testing::HasSubstr;

std::string textOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// As in the grader: no terminal, nobody who looks.
class LiveViewTest : public testing::Test {
 protected:
  void SetUp() override { ::setenv("REX_LIVE", "0", 1); }
  void TearDown() override { ::unsetenv("REX_LIVE"); }
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }

 private:
  TemporaryFolder folder_;
};

TEST_F(LiveViewTest, WritesAReplayWhereNobodyLooks) {
  {
    Simulator simulator("arm3");
    LiveView view(simulator, in("arm"));
    for (int k = 0; k < 2000; ++k) {
      const double angle = view.slider("angle", 0, 1, 0.25);
      EXPECT_EQ(angle, 0.25);
      EXPECT_FALSE(view.button("next"));
      EXPECT_EQ(view.handle("goal", {1, 2, 3}), Eigen::Vector3d(1, 2, 3));
      simulator.setJointAngles(Eigen::Vector3d::Constant(angle * k / 2000));
      view.plot("angle", k, angle);
      view.show(simulator);
      view.pause();
    }
    EXPECT_FALSE(view.isWatched());
  }
  EXPECT_THAT(textOf(in("arm.html")), HasSubstr("<html"));
}

TEST_F(LiveViewTest, ShowsPictures) {
  {
    LiveView view(in("dots"));
    for (int k = 0; k < 3; ++k) view.show(Picture{.pointSets = {{.points = {{0.1 * k, 0, 0}, {1, 1, 1}}}}});
  }
  EXPECT_THAT(textOf(in("dots.html")), HasSubstr("<html"));
}

TEST_F(LiveViewTest, SaysWhatItIsAbout) {
  ::setenv("REX_LIVE_ABOUT", "PID control\nabout\tThree masses.\ntry\tSet \"load\" to <zero>.", 1);
  {
    LiveView view(in("pid"));
    ::unsetenv("REX_LIVE_ABOUT");
    for (int k = 0; k < 3; ++k) {
      view.plot("height", 10 * k, 1);
      view.show(Picture{.pointSets = {{.points = {{0.1 * k, 0, 0}, {1, 1, 1}}}}});
    }
  }
  const std::string page = textOf(in("pid.html"));
  EXPECT_THAT(page, HasSubstr("<h1>PID control</h1>"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\">about</th><td>Three masses.</td>"));
  EXPECT_THAT(page, HasSubstr("<td>Set &#34;load&#34; to &#60;zero&#62;.</td>"));
  EXPECT_THAT(page, HasSubstr("data-marks=\"0.000 0.1900 0.033 0.5750 0.067 0.9600 \""));
}

// `rex run` leaves programs the terminal for their output, and nothing to read.
TEST(LiveViewInATerminal, SaysItsAddress) {
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    for (const char* variable : {"REX_LIVE", "DISPLAY", "WAYLAND_DISPLAY", "SSH_CONNECTION"})
      ::unsetenv(variable);
    if (::freopen("/dev/null", "r", stdin) == nullptr) ::_exit(1);
    { const LiveView view("page"); }
    ::_exit(0);
  }
  ASSERT_GT(child, 0);
  std::string said;
  char bytes[1024];
  for (ssize_t n = 0; (n = ::read(terminal, bytes, sizeof bytes)) > 0;)
    said.append(bytes, static_cast<std::size_t>(n));
  int status = -1;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_THAT(said, testing::StartsWith("http://127.0.0.1:"));
  EXPECT_THAT(said, HasSubstr("open this page"));
  ::close(terminal);
}

TEST_F(LiveViewTest, WritesNothingIfNothingWasShown) {
  { LiveView view(in("empty")); }
  EXPECT_FALSE(std::filesystem::exists(in("empty.html")));
}

TEST_F(LiveViewTest, RefusesSlidersOutOfOrderAndTooManyControls) {
  LiveView view(in("none"));
  EXPECT_THAT([&] { view.slider("gain", 0, 1, 2); },
              testing::ThrowsMessage<Error>(
                  HasSubstr("slider 'gain': found 2 from 0 to 1, wanted finite numbers in order")));
  EXPECT_THAT(
      [&] {
        view.handle("goal", {0, NAN, 0});
      },
      testing::ThrowsMessage<Error>(HasSubstr("handle 'goal': found a place or a normal that is not "
                                              "finite, wanted three numbers each")));
  for (int k = 0; k < 64; ++k) view.button(std::to_string(k));
  EXPECT_THAT([&] { view.button("one more"); },
              testing::ThrowsMessage<Error>(HasSubstr("button 'one more': found 64 others on the page")));
}

}  // namespace rex::live_view_test
