#include "collision/touch_sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "formats/urdf_reader.h"
#include "support/expect_error.h"

namespace rex::touch_sample_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A wheel that turns between two posts: `near` is in its way for a third of a turn, `far` never, and `core`
// always overlaps its spoke's end at home.
Model wheel(const std::string& limits) {
  return compile(parseOrs("body axle {}\n"
                          "body spoke { mass=1 }\n"
                          "shape tip (spoke) { rel=<T t(0 0 1)> type=ST_sphere size=[0 0 0 0.1] contact }\n"
                          "body near { X=<T t(0 1 0)> type=ST_sphere size=[0 0 0 0.9] contact }\n"
                          "body far { X=<T t(0 5 0)> type=ST_sphere size=[0 0 0 0.1] contact }\n"
                          "body core { X=<T t(0 0 0.95)> type=ST_sphere size=[0 0 0 0.1] contact }\n"
                          "joint turn (axle spoke) { type=hingeX " +
                              limits + " }\ncollisions { rule=all_but_neighbours }\n",
                          "wheel.ors")
                     .spec);
}

// The touches of the pairs of the spoke, and the reasons suggested, by the other body's name.
std::vector<std::string> touchesOf(const Model& model, const TouchSample& sample) {
  std::vector<std::string> all;
  for (const auto& [verdict, touches] : sample.pairs) {
    EXPECT_EQ(model[verdict.a].name == "spoke" || model[verdict.b].name == "spoke", true);
    const BodyId other = model[verdict.a].name == "spoke" ? verdict.b : verdict.a;
    const char* much = touches == 0 ? "never" : touches == sample.postures ? "always" : "at times";
    all.push_back(model[other].name + " " + much);
  }
  return all;
}

std::vector<std::string> reasonsOf(const Model& model, const TouchSample& sample) {
  std::vector<std::string> all;
  for (const CollisionChoice& choice : suggestedChoices(model, sample)) {
    EXPECT_FALSE(choice.mayCollide);
    all.push_back((choice.a == "spoke" ? choice.b : choice.a) + " " + choice.reason);
  }
  return all;
}

TEST(TouchSample, SaysWhoNeverTouches) {
  const Model model = wheel("");
  Rng rng(1);
  const TouchSample sample = sampleTouches(model, 3000, rng);
  EXPECT_EQ(sample.postures, 3000);
  EXPECT_THAT(sample.held, IsEmpty());
  EXPECT_THAT(touchesOf(model, sample),
              ::testing::UnorderedElementsAre("near at times", "far never", "core at times"));
  EXPECT_THAT(reasonsOf(model, sample), ::testing::UnorderedElementsAre("far Never", "core Default"));
  // In closed form: two balls at distance 1 from the axis touch while the angle between them is below
  // 2 asin(1.0 / 2) = 60 degrees to each side, a third of the turn.
  for (const auto& [verdict, touches] : sample.pairs) {
    if (model[verdict.a].name != "near" && model[verdict.b].name != "near") continue;
    EXPECT_NEAR(touches / 3000., 1. / 3, 4 * std::sqrt(2. / 9 / 3000));
  }
}

TEST(TouchSample, KeepsWithinLimits) {
  const Model model = wheel("limits=[-0.01 0.01]");
  Rng rng(1);
  const TouchSample sample = sampleTouches(model, 100, rng);
  EXPECT_THAT(touchesOf(model, sample),
              ::testing::UnorderedElementsAre("near never", "far never", "core always"));
  EXPECT_THAT(reasonsOf(model, sample),
              ::testing::UnorderedElementsAre("near Never", "far Never", "core Always"));
}

TEST(TouchSample, LeavesAtHomeWhatHasNoRange) {
  const Model model =
      compile(parseOrs("body a {} body b { contact type=ST_sphere size=[0 0 0 1] } body c {}\n"
                       "joint rail (a b) { type=transX } joint turn (b c) { type=hingeX limits=[0 inf] }",
                       "r.ors")
                  .spec);
  Rng rng(1);
  EXPECT_THAT(sampleTouches(model, 1, rng).held, ElementsAre("rail", "turn"));
}

TEST(TouchSample, IsTheSameForTheSameSeed) {
  const Model model = wheel("");
  Rng one(7), same(7), other(8);
  const auto touches = [&](Rng& rng) {
    std::vector<int> all;
    for (const auto& [verdict, count] : sampleTouches(model, 500, rng).pairs) all.push_back(count);
    return all;
  };
  const std::vector<int> first = touches(one);
  EXPECT_EQ(first, touches(same));
  EXPECT_NE(first, touches(other));
}

TEST(TouchSample, SuggestsNothingAboutWhatIsChosen) {
  SceneSpec spec =
      parseUrdf(
          "<robot name='r'>"
          "<link name='a'><collision><geometry><sphere radius='.1'/></geometry></collision></link>"
          "<link name='b'><collision><geometry><sphere radius='.1'/></geometry></collision></link>"
          "<joint name='j' type='continuous'><parent link='a'/><child link='b'/>"
          "<origin xyz='0 0 1'/></joint></robot>",
          "r.urdf")
          .spec;
  spec.collisionChoices = {{"a", "b", true}};
  const Model model = compile(spec);
  Rng rng(1);
  const TouchSample sample = sampleTouches(model, 10, rng);
  ASSERT_EQ(sample.pairs.size(), 1u);
  EXPECT_THAT(suggestedChoices(model, sample), IsEmpty());
}

TEST(TouchSample, NeedsAPosture) {
  Rng rng(1);
  EXPECT_REX_ERROR(static_cast<void>(sampleTouches(wheel(""), 0, rng)),
                   "number of random postures: found 0, wanted at least 1");
}

}  // namespace rex::touch_sample_test
