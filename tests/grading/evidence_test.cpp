#include "grading/evidence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/pose.h"
#include "render/image.h"
#include "render/text.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/fresh_folder.h"
#include "support/needs_osmesa.h"

namespace rex::grading::evidence_test {

using ::testing::HasSubstr;

TEST(Comparison, DrawsTheRowsThatDifferMost) {
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(6, 9), got = wanted;
  for (int row = 0; row < 6; ++row) got(row, 3) = row;  // so that the first two differ least
  const Figure figure = comparison("states", got, wanted);
  ASSERT_EQ(figure.series.size(), 8u);
  EXPECT_EQ(figure.title, "states");
  EXPECT_EQ(figure.series[0].label, "row 2, got");
  EXPECT_EQ(figure.series[1].label, "row 2, wanted");
  EXPECT_EQ(figure.series[6].label, "row 5, got");
  EXPECT_EQ(figure.series[6].y[3], 5);
  EXPECT_EQ(figure.series[7].y[3], 0);
  EXPECT_EQ(figure.series[0].y.size(), 9u);
  for (std::size_t k = 0; k < 8; k += 2) {
    EXPECT_EQ(figure.series[k].color, figure.series[k + 1].color) << "both of a row";
    EXPECT_TRUE(figure.series[k + 1].dashed);
    EXPECT_NE(figure.series[k].color, figure.series[(k + 2) % 8].color);
  }
}

TEST(Comparison, ShowsOfManyColumnsThoseAroundTheWorst) {
  Eigen::MatrixXd got = Eigen::MatrixXd::Zero(2, 1000);
  got(1, 990) = 3;
  const Figure figure = comparison("band", got, Eigen::MatrixXd::Zero(2, 1000));
  EXPECT_EQ(figure.series[2].x.front(), 600);
  EXPECT_EQ(figure.series[2].x.back(), 999);
  EXPECT_EQ(figure.series[2].y[390], 3);
}

TEST(Comparison, LaysTallOnesDown) {
  const Figure figure = comparison("x", Eigen::VectorXd::Constant(9, 2), Eigen::VectorXd::Ones(9));
  ASSERT_EQ(figure.series.size(), 2u);
  EXPECT_EQ(figure.series[0].label, "got");
  EXPECT_EQ(figure.series[0].y, std::vector<double>(9, 2.));
  EXPECT_REX_ERROR(static_cast<void>(comparison("x", Eigen::VectorXd::Ones(9), Eigen::VectorXd::Ones(8))),
                   "comparison: x: found 9 x 1 numbers, wanted 8 x 1");
}

Film ball() {
  Film film;
  for (int i = 0; i < 3; ++i) {
    Picture picture;
    picture.solids = {
        {{.type = ShapeType::kSphere, .radius = .2}, translation(.3 * i, 0, .5), {1, 0, 0}, "ball"}};
    film.push_back({1. * i, picture});
  }
  return film;
}

class WriteEvidence : public ::testing::Test {
 protected:
  const std::filesystem::path folder_ = freshFolderOfTest("evidence") / "checks";
};

TEST_F(WriteEvidence, DrawsTheFirstFigure) {
  const Evidence evidence{.figures = {comparison("x", Eigen::VectorXd::Zero(9), Eigen::VectorXd::Ones(9))}};
  const EvidenceFiles files = writeEvidence(evidence, "line", {"A line", "x: got 0, wanted 1"}, folder_);
  EXPECT_EQ(files.picture, "line.png");
  EXPECT_EQ(files.replay, "");
  EXPECT_EQ(readPng(folder_ / "line.png").width, 800);
}

TEST_F(WriteEvidence, DrawsFiguresInARow) {
  Figure narrow = comparison("y", Eigen::VectorXd::Zero(9), Eigen::VectorXd::Ones(9));
  narrow.width = 500;
  narrow.height = 700;
  const Evidence evidence{
      .figures = {comparison("x", Eigen::VectorXd::Zero(9), Eigen::VectorXd::Ones(9)), narrow}};
  EXPECT_EQ(writeEvidence(evidence, "row", {"A row", "x: got 0"}, folder_).picture, "row.png");
  const Image row = readPng(folder_ / "row.png");
  EXPECT_EQ(row.width, 1300);
  const int heading = textSize("").height + 24;  // one line and its margins
  EXPECT_EQ(row.height, heading + 700);
  int red = 0;
  for (int y = 0; y < heading; ++y)
    for (int x = 0; x < 200; ++x) red += row.at(x, y)[0] > row.at(x, y)[1] + 80 ? 1 : 0;
  EXPECT_GT(red, 20);                                        // "x: got 0"
  EXPECT_EQ(row.at(400, 650), (std::array{255, 255, 255}));  // below the lower one
  const auto isDark = [&](int x, int y) { return row.at(x, y)[0] < 128; };
  int dark = 0;
  for (int x = 800; x < 1300; ++x)
    for (int y = 0; y < 700; ++y) dark += isDark(x, y) ? 1 : 0;
  EXPECT_GT(dark, 500);
}

TEST_F(WriteEvidence, OpensAFilmAtItsMoment) {
  REX_NEEDS_OSMESA();
  const EvidenceFiles files =
      writeEvidence({.film = ball(), .moment = 1.5}, "ball", {"A <ball>", "ball: got 1 m"}, folder_);
  EXPECT_EQ(files.picture, "ball.png");
  EXPECT_EQ(files.replay, "ball.html");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "ball.png"));
  const std::string page = fileText(folder_ / "ball.html");
  EXPECT_THAT(page, HasSubstr("data-start=\"1.5\""));
  EXPECT_THAT(page, HasSubstr("A &#60;ball&#62;"));
}

TEST_F(WriteEvidence, LeavesNothingOfNothing) {
  const EvidenceFiles files = writeEvidence({}, "none", {"None", ""}, folder_);
  EXPECT_EQ(files.picture + files.replay, "");
  EXPECT_FALSE(std::filesystem::exists(folder_));
}

Solid ballAt(double x) {
  return {{.type = ShapeType::kSphere, .radius = .2}, translation(x, 0, .5), {1, 0, 0}, "ball"};
}

Picture pictureOf(const std::vector<Solid>& solids) {
  Picture picture;
  picture.solids = solids;
  return picture;
}

TEST(WithWanted, DrawsPaleWhatIsElsewhere) {
  Picture wanted = pictureOf({ballAt(0), ballAt(3)});
  wanted.polylines = {{.points = {{0, 0, 0}, {1, 0, 0}}, .color = {1, 0, 0}}};
  const Picture both = withWanted(pictureOf({ballAt(0), ballAt(2)}), wanted);
  ASSERT_EQ(both.solids.size(), 3u);  // the first is where it should be
  EXPECT_EQ(both.solids[1].X_WS.p.x(), 2);
  EXPECT_EQ(both.solids[1].color.a, 1);
  EXPECT_EQ(both.solids[2].X_WS.p.x(), 3);
  EXPECT_LT(both.solids[2].color.a, 1);
  ASSERT_EQ(both.polylines.size(), 1u);
  EXPECT_EQ(both.polylines[0].color.r, both.solids[2].color.r);
  ASSERT_EQ(both.captions.size(), 1u);
  EXPECT_EQ(both.captions[0].text, "wanted: pale green");
}

TEST(WithWanted, DrawsWhatOneOfThemLacks) {
  EXPECT_EQ(withWanted(pictureOf({}), pictureOf({ballAt(1)})).solids.size(), 1u);
  EXPECT_EQ(withWanted(pictureOf({ballAt(1)}), pictureOf({})).solids.size(), 1u);
}

Film rolling(int frames, double speed) {
  Film film;
  for (int i = 0; i < frames; ++i) film.push_back({.1 * i, pictureOf({ballAt(1 + speed * i)})});
  return film;
}

// Where both balls are in the last picture.
void expectLast(const Film& film, double got, double wanted) {
  ASSERT_EQ(film.back().picture.solids.size(), 2u);
  EXPECT_EQ(film.back().picture.solids[0].X_WS.p.x(), got);
  EXPECT_EQ(film.back().picture.solids[1].X_WS.p.x(), wanted);
}

TEST(WithWanted, LetsTheShorterFilmStay) {
  const Film longer = withWanted(rolling(5, 3), rolling(3, 2));
  ASSERT_EQ(longer.size(), 5u);
  EXPECT_EQ(longer.back().time, .4);
  expectLast(longer, 13, 5);
  const Film shorter = withWanted(rolling(2, -1), rolling(3, 2));
  ASSERT_EQ(shorter.size(), 3u);
  EXPECT_EQ(shorter.back().time, .2);
  expectLast(shorter, 0, 5);
}

TEST(WithWanted, LeavesAFilmAloneWithoutAnother) {
  EXPECT_EQ(withWanted(rolling(2, 1), {}).back().picture.solids.size(), 1u);
  EXPECT_TRUE(withWanted(Film{}, rolling(2, 1)).empty());
}

TEST(Curves, TellWhatCameOutFromWhatWasWanted) {
  const Series got = gotCurve("a", {1, 2}, {3, 4}), wanted = wantedCurve("b", {1, 2}, {5, 6});
  EXPECT_FALSE(got.dashed);
  EXPECT_TRUE(wanted.dashed);
  EXPECT_GT(got.size, wanted.size);  // so that both show where they agree
  EXPECT_EQ(got.y, (std::vector<double>{3, 4}));
  EXPECT_EQ(wanted.label, "b");
  EXPECT_EQ(wrongPoint("c", 1, 2).style, SeriesStyle::kPoints);
  EXPECT_EQ(wrongFrom(1.5).at, 1.5);
}

}  // namespace rex::grading::evidence_test
