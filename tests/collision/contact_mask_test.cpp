// Who may touch whom by MuJoCo's rule.
#include <bit>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "collision/collision_pairs.h"
#include "collision/contacts.h"
#include "formats/mjcf_reader.h"
#include "formats/ors_reader.h"
#include "formats/ors_writer.h"

namespace rex::contact_mask_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SceneFile world(const std::string& inside, const std::string& before = "", const std::string& after = "") {
  return parseMjcf("<mujoco>" + before + "<worldbody>" + inside + "</worldbody>" + after + "</mujoco>",
                   "m.xml");
}

std::string ball(const std::string& name, const std::string& bits, double x) {
  return fmt::format("<body name='{0}' pos='{2} 0 1'><freejoint/><geom name='{0}' size='.1' {1}/></body>",
                     name, bits, x);
}

// "a b" for each pair of shapes that may collide.
std::vector<std::string> pairsOf(const Model& model) {
  std::vector<std::string> pairs;
  for (const auto& [a, b] : collidingPairs(model))
    pairs.push_back(model.shapes()[static_cast<std::size_t>(a)].name + " " +
                    model.shapes()[static_cast<std::size_t>(b)].name);
  return pairs;
}

SceneSpec withFloor(SceneSpec spec) {
  spec.worldShapes.push_back({.name = "floor", .X_BS = translation(0, 0, -1), .shape = {}, .contact = true});
  return spec;
}

// Bits of one geom meet those of another; what is added has 1 and 1.
TEST(ContactMasks, AreThoseOfMujoco) {
  const std::string oneWay = "contype='1' conaffinity='0'";
  const SceneSpec two = world(ball("a", oneWay, 0) + ball("b", oneWay, 1)).spec;
  EXPECT_THAT(pairsOf(compile(two)), IsEmpty()) << "neither has an affinity for the other";
  EXPECT_THAT(pairsOf(compile(withFloor(two))), ElementsAre("floor a", "floor b"));
  const SceneSpec apart = world(ball("a", "contype='2' conaffinity='2'", 0) +
                                ball("b", "conaffinity='2'", 1) + ball("c", "contype='0' conaffinity='1'", 2))
                              .spec;
  EXPECT_THAT(pairsOf(compile(withFloor(apart))), ElementsAre("floor b", "floor c", "a b", "b c"));
}

// All bits of two geoms: a table of random masks against the rule itself.
TEST(ContactMasks, FollowTheRuleForAnyBits) {
  Rng rng(17);
  const auto word = [&] { return rng.index(4) == 0 ? ~0u : 1u << rng.index(32) | 1u << rng.index(3); };
  for (int i = 0; i < 200; ++i) {
    const std::uint32_t a = word(), b = word(), c = word(), d = word();
    const auto bits = [](std::uint32_t type, std::uint32_t affinity) {
      return fmt::format("contype='{}' conaffinity='{}'", static_cast<std::int32_t>(type), affinity);
    };
    const Model model = compile(world(ball("a", bits(a, b), 0) + ball("b", bits(c, d), 1)).spec);
    const bool touches = std::popcount(a & d) + std::popcount(c & b) > 0;
    EXPECT_EQ(collidingPairs(model).size(), touches ? 1u : 0u) << bits(a, b) << " " << bits(c, d);
    EXPECT_EQ(toString(pairVerdicts(model).at(0), model),
              touches ? "may collide" : "no common bit of contype and conaffinity");
  }
}

// They stay with shapes: of one body, one geom may touch what another may not.
TEST(ContactMasks, StayWithShapes) {
  const SceneSpec spec = world(
                             "<body name='a'><freejoint/><geom name='one' size='.1'/>"
                             "<geom name='two' size='.1' contype='2' conaffinity='2'/></body>" +
                             ball("b", "", 1) + ball("c", "contype='2' conaffinity='2'", 2))
                             .spec;
  EXPECT_THAT(pairsOf(compile(withFloor(spec))), ElementsAre("floor one", "floor b", "one b", "two c"));
}

// A <pair> touches whatever bits, neighbours, exclusions and overlaps at home say.
TEST(ContactMasks, KnowPairs) {
  const std::string none = " contype='0' conaffinity='0'/>";
  const std::string bodies =
      "<geom name='ground' type='plane' size='1 1 1' contype='0' conaffinity='0'/>"
      "<body name='a'><joint/><geom name='a' size='.5'" +
      none + "<body name='b' pos='0 0 .2'><joint/><geom name='b' size='.5'" + none +
      "<geom name='c' size='.5'" + none + "</body></body>";
  const auto contact = [](const std::string& inside) { return "<contact>" + inside + "</contact>"; };
  const std::string both = "<pair geom1='b' geom2='a'/><pair geom1='ground' geom2='b' condim='3'/>";
  const SceneFile scene = world(bodies, "", contact(both + "<exclude body1='a' body2='b'/>"));
  const Model model = compile(scene.spec);
  EXPECT_THAT(pairsOf(model), ElementsAre("ground b", "a b"));
  EXPECT_THAT(collisionWarnings(model), IsEmpty()) << "that they overlap is meant";
  EXPECT_EQ(toString(pairVerdicts(model).at(2), model), "enabled: pairs of shapes");
  EXPECT_THAT(pairsOf(compile(parseOrs(writeOrs(scene.spec), "again.ors").spec)),
              ElementsAre("ground b", "a b"));
  // A pair of one body does nothing.
  EXPECT_THAT(pairsOf(compile(world(bodies, "", contact("<pair geom1='b' geom2='c'/>")).spec)), IsEmpty());
}

TEST(ContactMasks, AreWrittenAndReadAgain) {
  const SceneSpec spec = withFloor(world(ball("a", "contype='4294967295' conaffinity='0'", 0) +
                                         ball("b", "contype='6' conaffinity='8'", 1) + ball("c", "", 2))
                                       .spec);
  const SceneSpec again = parseOrs(writeOrs(spec), "again.ors").spec;
  for (std::size_t i = 0; i < spec.bodies.size(); ++i)
    EXPECT_EQ(again.bodies[i].shapes[0].mask, spec.bodies[i].shapes[0].mask);
  EXPECT_THAT(writeOrs(spec), HasSubstr("contact contact_bits=[6 8]"));
}

// Bodies left out of everything are told, whatever is added to the scene later.
TEST(ContactMasks, WarnOfWhatNothingTouches) {
  const auto warningsOf = [](const SceneFile& scene) {
    std::vector<std::string> all;
    for (const Diagnostic& one : scene.notes)
      if (one.severity == Severity::kWarning) all.push_back(one.message);
    return all;
  };
  const std::string off = "contype='0' conaffinity='0'", two = "contype='2' conaffinity='2'";
  EXPECT_THAT(warningsOf(world(ball("a", "contype='1' conaffinity='0'", 0))), IsEmpty());
  EXPECT_THAT(
      warningsOf(world(ball("a", off, 0) + ball("b", "", 1) + "<body name='frame'/>")),
      ElementsAre("nothing can touch 'a': no geom of theirs has a bit of contype or conaffinity to share"));
  EXPECT_THAT(
      warningsOf(world(ball("a", two, 0) + ball("b", two, 1))),
      ElementsAre("what is added to the scene, such as a floor or obstacles, cannot touch 'a', 'b': it has "
                  "contype 1 and conaffinity 1"));
  std::string many;
  for (int i = 0; i < 7; ++i) many += ball(fmt::format("b{}", i), off, i);
  EXPECT_THAT(warningsOf(world(many)),
              ElementsAre(HasSubstr("nothing can touch 'b0', 'b1', 'b2', 'b3', 'b4' and 2 more: no geom")));
}

}  // namespace rex::contact_mask_test
