#include <gtest/gtest.h>

#include "collision/contacts.h"
#include "formats/ors_reader.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::contact_model_test {

ShapeSpec ball(bool contact = true) {
  return {.name = "", .X_BS = {}, .shape = {.type = ShapeType::kSphere, .radius = 0.1}, .contact = contact};
}

BodySpec bodyWithBall(const std::string& name) { return {.name = name, .X_WB = {}, .shapes = {ball()}}; }

JointSpec joint(const std::string& parent, const std::string& child, JointType type = JointType::kHinge) {
  return {.name = parent + child, .parent = parent, .child = child, .type = type, .X_PF = {}, .X_MC = {}};
}

// The names of the bodies of all pairs, as "ab cd".
std::string pairsOf(const SceneSpec& spec) {
  const Model model = compile(spec);
  const ContactModel contacts(model);
  std::string names;
  for (const ShapePair& pair : contacts.pairs()) {
    EXPECT_LT(pair.a, pair.b);
    EXPECT_EQ(contacts.body(pair.a), model.shapes()[static_cast<std::size_t>(pair.a)].body);
    names +=
        (names.empty() ? "" : " ") + model[contacts.body(pair.a)].name + model[contacts.body(pair.b)].name;
  }
  return names;
}

SceneSpec sceneWith(const std::vector<std::string>& names) {
  SceneSpec spec;
  for (const std::string& name : names) spec.bodies.push_back(bodyWithBall(name));
  return spec;
}

// Bodies that move freely.
SceneSpec looseBodies(const std::vector<std::string>& names) {
  SceneSpec spec = sceneWith(names);
  for (const std::string& name : names) spec.joints.push_back(joint("world", name, JointType::kFree));
  return spec;
}

TEST(ContactModel, LetsFreeBodiesCollide) { EXPECT_EQ(pairsOf(looseBodies({"a", "b", "c"})), "ab ac bc"); }

TEST(ContactModel, LeavesOutWhatStandsFixedInTheWorld) {
  EXPECT_EQ(pairsOf(sceneWith({"a", "b", "c"})), "");
  SceneSpec spec = sceneWith({"a", "b", "c"});
  spec.collisionRule = CollisionRule::kFourGenerations;
  EXPECT_EQ(pairsOf(spec), "");
}

TEST(ContactModel, LeavesOutWhatIsNotInContact) {
  SceneSpec spec = looseBodies({"a", "b", "c"});
  spec.bodies[1].shapes[0].contact = false;
  spec.bodies[2].shapes.push_back(ball());
  ShapeSpec marker = ball();
  marker.shape = {.type = ShapeType::kMarker};
  spec.bodies[0].shapes.push_back(marker);
  EXPECT_EQ(pairsOf(spec), "ac ac");
}

// In a chain a-b-c-... the fifth generation is the first that may hit the ancestor.
TEST(ContactModel, LeavesOutKinOfFourGenerations) {
  SceneSpec spec = sceneWith({"a", "b", "c", "d", "e", "f", "g"});
  spec.collisionRule = CollisionRule::kFourGenerations;
  for (std::size_t i = 1; i < spec.bodies.size(); ++i)
    spec.joints.push_back(joint(spec.bodies[i - 1].name, spec.bodies[i].name));
  EXPECT_EQ(pairsOf(spec), "af ag bg");
}

// Two arms on one trunk: 1-2-3-4-5 and 6 to 9 below the trunk t.
TEST(ContactModel, CountsGenerationsToTheCommonAncestor) {
  SceneSpec spec = sceneWith({"t", "1", "2", "3", "4", "5", "6", "7", "8", "9"});
  spec.collisionRule = CollisionRule::kFourGenerations;
  for (const char* link : {"t1", "12", "23", "34", "45", "t6", "67", "78", "89"})
    spec.joints.push_back(joint({link[0]}, {link[1]}));
  EXPECT_EQ(pairsOf(spec), "t5 65 75 85 95");
}

TEST(ContactModel, TakesTheWorldForNobodysAncestor) {
  SceneSpec spec = sceneWith({"fixed", "loose", "hung"});
  spec.collisionRule = CollisionRule::kFourGenerations;
  spec.worldShapes = {ball()};
  spec.joints = {joint("world", "loose", JointType::kFree), joint("world", "hung")};
  EXPECT_EQ(pairsOf(spec), "worldloose fixedloose fixedhung loosehung");
}

TEST(ContactModel, FindsThePairsOfTheCourse) {
  const auto model = [](const char* name) { return compile(readOrs(sourcePath("data/robots") / name).spec); };
  const Model peg = model("pegInAHole.ors");
  const ContactModel contacts(peg);
  ASSERT_EQ(contacts.pairs().size(), 12u);
  for (const ShapePair& pair : contacts.pairs()) EXPECT_EQ(peg[contacts.body(pair.a)].name, "hole");
  EXPECT_TRUE(ContactModel(model("man.ors")).pairs().empty());
  EXPECT_TRUE(ContactModel(model("pegArm.ors")).pairs().empty());
}

TEST(ContactModel, KeepsGivenPairs) {
  const Model model = compile(sceneWith({"a", "b", "c"}));
  const std::vector<ShapePair> pairs{{1, 2}, {0, 1}};
  const ContactModel contacts(model, pairs);
  EXPECT_TRUE(std::equal(pairs.begin(), pairs.end(), contacts.pairs().begin(), contacts.pairs().end()));
}

TEST(ContactModel, RefusesPairsThatAreNone) {
  SceneSpec spec = sceneWith({"a", "b"});
  spec.name = "two.ors";
  const Model model = compile(spec);
  for (const ShapePair pair : {ShapePair{0, 0}, {1, 0}, {0, 2}, {-1, 1}}) {
    EXPECT_REX_ERROR(ContactModel(model, std::span(&pair, 1)), "scene 'two.ors': pair of shapes in contact");
  }
  const ShapePair swapped{1, 0};
  EXPECT_REX_ERROR(ContactModel(model, std::span(&swapped, 1)), "found (1, 0), wanted 0 <= a < b < 2");
}

TEST(ContactModel, NamesWhatCannotCollide) {
  SceneSpec spec = looseBodies({"a", "b"});
  spec.name = "two.ors";
  spec.bodies[1].shapes[0].name = "bunny";
  spec.bodies[1].shapes[0].shape = {.type = ShapeType::kMesh};
  EXPECT_REX_ERROR(ContactModel(compile(spec)),
                   "scene 'two.ors': shape 'bunny' of body 'b': found a mesh whose mesh is not loaded");
  spec.bodies[1].shapes[0].shape = {.type = ShapeType::kMarker};
  const Model model = compile(spec);
  const ShapePair pair{0, 1};
  EXPECT_REX_ERROR(ContactModel(model, std::span(&pair, 1)),
                   "scene 'two.ors': shape 'bunny' of body 'b': found a marker");
}

}  // namespace rex::contact_model_test
