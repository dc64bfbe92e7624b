// The statements `collisions` of .ors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "formats/ors_writer.h"
#include "formats/urdf_reader.h"
#include "formats/urdf_writer.h"
#include "scene/model.h"
#include "support/expect_error.h"

namespace rex::ors_collisions_test {

const std::string kBodies = "body a { contact type=ST_sphere size=[0 0 0 1] } body b {} body c {}\n";

SceneSpec read(const std::string& text) { return parseOrs(kBodies + text, "s.ors").spec; }

TEST(OrsCollisions, HaveTheRuleOfTheCourseUnlessTheySayOtherwise) {
  EXPECT_EQ(read("").collisionRule, CollisionRule::kFourGenerations);
  EXPECT_EQ(read("collisions { rule=all_but_neighbours }").collisionRule, CollisionRule::kAllButNeighbours);
  EXPECT_EQ(
      read("collisions { rule=all_but_neighbours }\ncollisions { rule=four_generations }").collisionRule,
      CollisionRule::kFourGenerations)
      << "the last one counts";
  EXPECT_EQ(compile(read("")).collisionRule(), CollisionRule::kFourGenerations);
  EXPECT_EQ(SceneSpec().collisionRule, CollisionRule::kAllButNeighbours);
  EXPECT_EQ(parseUrdf("<robot name='r'><link name='a'/></robot>", "r.urdf").spec.collisionRule,
            CollisionRule::kAllButNeighbours);
}

TEST(OrsCollisions, ChoosePairs) {
  const SceneSpec spec = read(
      "collisions (a b) { off reason=\"Never seen\" }\ncollisions (world c) { on }\n"
      "collisions (c) { off }\ncollisions (b) { on }\n");
  ASSERT_EQ(spec.collisionChoices.size(), 4u);
  EXPECT_EQ(spec.collisionChoices[0].a + spec.collisionChoices[0].b, "ab");
  EXPECT_EQ(spec.collisionChoices[0].reason, "Never seen");
  EXPECT_FALSE(spec.collisionChoices[0].mayCollide);
  EXPECT_TRUE(spec.collisionChoices[1].mayCollide);
  EXPECT_EQ(spec.collisionChoices[1].a, "world");
  EXPECT_EQ(spec.collisionChoices[2].b, "");
  EXPECT_EQ(spec.collisionChoices[3].a, "b");
  EXPECT_TRUE(spec.collisionChoices[3].mayCollide);
}

TEST(OrsCollisions, AreWrittenAndReadAgain) {
  SceneSpec spec = read(
      "collisions { rule=all_but_neighbours }\ncollisions (a b) { off reason=Never }\n"
      "collisions (a c) { on }\ncollisions (c) { off }\n");
  spec.collisionChoices[1].reason = "the \"user\"\nsaid so";
  const std::string text = writeOrs(spec);
  EXPECT_THAT(text, ::testing::EndsWith("\ncollisions       { rule=all_but_neighbours }\n"
                                        "collisions (a b) { off reason=\"Never\" }\n"
                                        "collisions (a c) { on reason=\"the 'user' said so\" }\n"
                                        "collisions (c)   { off }\n"));
  const SceneSpec again = parseOrs(text, "again.ors").spec;
  EXPECT_EQ(again.collisionRule, CollisionRule::kAllButNeighbours);
  ASSERT_EQ(again.collisionChoices.size(), 3u);
  EXPECT_EQ(writeOrs(again), text);
  EXPECT_EQ(writeOrs(read("")).find("collisions"), std::string::npos);
}

TEST(OrsCollisions, RefuseWithThePlace) {
  EXPECT_REX_ERROR(read("collisions { rule=none }"),
                   "s.ors:2:19: collisions: attribute 'rule': found 'none', wanted four_generations or "
                   "all_but_neighbours");
  EXPECT_REX_ERROR(read("collisions { rule=all_but_neighbors }"), "(did you mean 'all_but_neighbours'?)");
  EXPECT_REX_ERROR(read("collisions { }"), "attribute 'rule': found nothing");
  EXPECT_REX_ERROR(read("collisions { rule=3 }"),
                   "s.ors:2:19: collisions: attribute 'rule': found the number 3");
  EXPECT_REX_ERROR(
      read("collisions all { }"),
      "s.ors:2:12: collisions: found 'all', wanted 'collisions { ... }' or 'collisions (A B) { ... }'");
  EXPECT_REX_ERROR(read("collisions (a b c) { off }"),
                   "s.ors:2:17: collisions (a b c): found 3 bodies, wanted two, or one for all its pairs");
  EXPECT_REX_ERROR(read("collisions (a a) { off }"),
                   "s.ors:2:15: collisions (a a): found one body, wanted two different bodies");
  EXPECT_REX_ERROR(
      read("collisions (a bb) { off }"),
      "s.ors:2:15: collisions (a bb): unknown body: found 'bb', wanted the name of an earlier body "
      "(did you mean 'b'?)");
  EXPECT_REX_ERROR(read("collisions (a b)"),
                   "s.ors:2:1: collisions (a b): found neither 'on' nor 'off', wanted one of them");
  EXPECT_REX_ERROR(read("collisions (a b) { on off }"), "found 'on' and 'off', wanted one of them");
  EXPECT_REX_ERROR(read("collisions (a b) { off reason=3 }"), "attribute 'reason'");
  EXPECT_REX_ERROR(read("collision (a b) { off }"), "(did you mean 'collisions'?)");
}

TEST(OrsCollisions, LoseThemselvesInUrdfWithANote) {
  std::string notes;
  for (const Diagnostic& one : writeUrdf(read("collisions (a b) { off }")).notes) notes += one.message + "\n";
  EXPECT_THAT(notes, ::testing::HasSubstr("collision settings are left out: they belong in an SRDF"));
  EXPECT_THAT(notes,
              ::testing::HasSubstr("bodies within four generations may collide when the file is read again"));
  EXPECT_TRUE(writeUrdf(parseOrs("body b {}", "b.ors").spec).notes.empty());
}

TEST(CompiledChoices, MustNameTwoBodies) {
  SceneSpec spec = read("");
  spec.collisionChoices = {{"a", "bb", false}};
  EXPECT_REX_ERROR(
      compile(spec),
      "collision settings: unknown body: found 'bb', wanted the name of a body (did you mean 'b'?)");
  spec.collisionChoices = {{"a", "a", false}};
  EXPECT_REX_ERROR(compile(spec), "collision settings: a pair: found 'a' twice, wanted two bodies");
}

}  // namespace rex::ors_collisions_test
