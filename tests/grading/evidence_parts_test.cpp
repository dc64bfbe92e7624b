#include <gtest/gtest.h>

#include "grading/evidence.h"

namespace rex::grading::evidence_parts_test {

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

}  // namespace rex::grading::evidence_parts_test
