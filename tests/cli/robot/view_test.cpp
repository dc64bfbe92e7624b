#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <unistd.h>

#include "base/interruption.h"
#include "cli/rex_command.h"
#include "cli/robot/view_film.h"
#include "formats/ors_reader.h"
#include "live/live_simulation.h"
#include "support/needs_osmesa.h"
#include "support/paths.h"

namespace rex::cli::view_test {

using testing::HasSubstr;

using ViewTest = RexCommand;

TEST_F(ViewTest, RefusesWhatCannotBeShownOrServed) {
  EXPECT_THAT(rex({"view", "nosuch"}).error, HasSubstr("nosuch"));
  EXPECT_EQ(rex({"view", "nosuch"}).exitCode, 64);
  EXPECT_THAT(flat(rex({"view", "arm3", "--q", "1"}).error), HasSubstr("--q"));
  const ProcessResult elsewhere = rex({"view", "arm3", "--bind", "192.0.2.1", "--no-browser"});
  EXPECT_EQ(elsewhere.exitCode, 64);
  EXPECT_THAT(flat(elsewhere.error), HasSubstr("serving 192.0.2.1:0: found the system refuses it"));
}

class ViewFilmTest : public ::testing::Test {
 protected:
  // As long as films may be, which takes a minute to draw.
  void drawFor(ViewFilm& film) {
    film.setMotion(toTable(arm, {{0, 120}, {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()}}));
    ASSERT_EQ(film.draw(), "The film is being drawn.");
    ASSERT_EQ(film.draw(), "A film is being drawn.");
  }
  const TemporaryFolder folder;
  const Model arm = compile(readOrs(sourcePath("data/robots/pegArm.ors")).spec);
  const HeldSignals held;
};

TEST_F(ViewFilmTest, EndsWithItsOwner) {
  REX_NEEDS_OSMESA();
  {
    ViewFilm film(arm, {}, folder.path());
    EXPECT_EQ(film.draw(), "There is no recording yet.");
    drawFor(film);
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "film.mp4"));
  EXPECT_NO_THROW(throwIfInterrupted());
}

TEST_F(ViewFilmTest, LeavesTheUsersSignalToItsOwner) {
  REX_NEEDS_OSMESA();
  ViewFilm film(arm, {}, folder.path());
  drawFor(film);
  ::kill(::getpid(), SIGINT);
  std::optional<ViewFilm::Drawn> drawn;
  while (!(drawn = film.takeDrawn())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(drawn->text, "");
  EXPECT_THROW(throwIfInterrupted(), Interrupted);
}

}  // namespace rex::cli::view_test
