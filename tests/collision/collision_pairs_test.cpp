#include "collision/collision_pairs.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "collision/contacts.h"
#include "collision/motion_clearance.h"
#include "formats/ors_reader.h"
#include "formats/urdf_reader.h"
#include "formats/urdf_writer.h"
#include "support/paths.h"
#include "support/random_scene.h"

namespace rex::collision_pairs_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Links with a ball of 0.1 m, or nothing at all if their name begins with a small letter.
std::string urdf(const std::vector<std::string>& links, const std::string& joints) {
  std::string text = "<robot name='r'>";
  for (const std::string& link : links) {
    const bool isFrame = link[0] >= 'a';
    const char* const ball = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
    text += fmt::format("<link name='{}'>{}</link>", link, isFrame ? "" : ball);
  }
  return text + joints + "</robot>";
}

std::string joint(const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& xyz = "0 0 1", const std::string& rest = "<axis xyz='1 0 0'/>") {
  return fmt::format(
      "<joint name='{0}{1}' type='{2}'><parent link='{0}'/><child link='{1}'/><origin xyz='{3}'/>{4}"
      "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint>",
      parent, child, type, xyz, rest);
}

std::string mimic(const std::string& joint, double ratio, const std::string& axis) {
  return fmt::format("<axis xyz='{}'/><mimic joint='{}' multiplier='{}'/>", axis, joint, ratio);
}

Model modelOf(const std::string& text) { return compile(parseUrdf(text, "r.urdf").spec); }

// "AB neighbours, AC may collide".
std::string reasons(const Model& model) {
  std::string text;
  for (const PairVerdict& verdict : pairVerdicts(model)) {
    text += fmt::format("{}{}{} {}", text.empty() ? "" : ", ", model[verdict.a].name, model[verdict.b].name,
                        toString(verdict, model));
    EXPECT_EQ(verdict.mayCollide,
              verdict.reason == PairReason::kNone || toString(verdict, model).starts_with("enabled"));
  }
  return text;
}
std::string reasons(const std::string& text) { return reasons(modelOf(text)); }

TEST(CollisionPairs, LeavesOutNeighboursOnly) {
  EXPECT_EQ(reasons(urdf({"A", "B", "C"}, joint("revolute", "A", "B") + joint("revolute", "B", "C"))),
            "AB neighbours, AC may collide, BC neighbours");
}

TEST(CollisionPairs, TakesWhatIsFixedToEachOtherForOnePart) {
  // A turns B, which carries C; D turns on B.
  EXPECT_EQ(
      reasons(urdf({"base", "A", "B", "C", "D"}, joint("revolute", "base", "A") +
                                                     joint("revolute", "A", "B") + joint("fixed", "B", "C") +
                                                     joint("revolute", "B", "D"))),
      "AB neighbours, AC neighbours, AD may collide, BC fixed to each other, BD neighbours, CD neighbours");
}

TEST(CollisionPairs, TakesPinnedBodiesForNeighbours) {
  // A, B and C stand apart, T is fixed to A; F is a frame without shapes on the post P, which stands still.
  std::string scene;
  for (const auto& [body, x] : {std::pair("A", 0), std::pair("B", 1), std::pair("C", 2), std::pair("P", 3)})
    scene += fmt::format(
        "body {0} {{ contact type=ST_sphere size=[0 0 0 .1] }} joint (world {0}) {{ type={2} A=<T t({1} 0 "
        "0)> }}\n",
        body, x, body[0] == 'P' ? "rigid" : "hingeX");
  scene +=
      "body T { contact type=ST_sphere size=[0 0 0 .1] } joint (A T) { type=rigid A=<T t(0 0 1)> }\n"
      "body F {} joint (P F) { type=rigid }\npin (A B) {}\npin (C F) {}\n";
  const std::string all =
      "AB neighbours, AC may collide, AP may collide, AT fixed to each other, BC may collide, "
      "BP may collide, BT neighbours, CP neighbours, CT may collide, PT may collide";
  for (const char* rule : {"four_generations", "all_but_neighbours"}) {
    std::string found =
        reasons(compile(parseOrs(scene + fmt::format("collisions {{ rule={} }}", rule), "s.ors").spec));
    EXPECT_EQ(found, all) << rule;
  }
}

TEST(CollisionPairs, SeesThroughFramesThatAreFixed) {
  EXPECT_EQ(reasons(urdf({"base", "A", "flange", "B", "C"},
                         joint("revolute", "base", "A") + joint("revolute", "A", "flange") +
                             joint("fixed", "flange", "B") + joint("revolute", "B", "C"))),
            "AB neighbours, AC may collide, BC neighbours");
}

TEST(CollisionPairs, TakesJointsInOnePlaceForOne) {
  const auto hip = [](const std::string& xyz) {
    return urdf({"base", "A", "yaw", "roll", "B"},
                joint("revolute", "base", "A") + joint("revolute", "A", "yaw") +
                    joint("revolute", "yaw", "roll", xyz) + joint("revolute", "roll", "B", "0 0 0"));
  };
  EXPECT_EQ(reasons(hip("0 0 0")), "AB neighbours");
  EXPECT_EQ(reasons(hip("0 0 0.3")), "AB may collide");
}

TEST(CollisionPairs, TellsThingsApartThatStandFixedInTheWorld) {
  // A carries the arm; the shelf is as fixed, but elsewhere.
  const std::string arm = joint("fixed", "world", "A") + joint("fixed", "world", "S", "0.5 0 2") +
                          joint("revolute", "A", "B") + joint("revolute", "B", "C");
  EXPECT_EQ(
      reasons(urdf({"world", "A", "S", "B", "C"}, arm)),
      "AS fixed to each other, AB neighbours, AC may collide, SB may collide, SC may collide, BC neighbours");
  // A frame below the joint stands for the body that carries it.
  EXPECT_EQ(
      reasons(urdf({"world", "A", "frame", "B"}, joint("fixed", "world", "A") + joint("fixed", "A", "frame") +
                                                     joint("revolute", "frame", "B"))),
      "AB neighbours");
}

TEST(CollisionPairs, NeverStopsAPlanForShelves) {
  const std::string shelves =
      "body shelf2 { type=ST_box size=[1 1 0.02] contact fixed }\n"
      "body shelf3 { X=<T t(0 0 0.01)> type=ST_box size=[1 1 0.02] contact fixed }\n"
      "body cart { type=ST_sphere size=[0 0 0 0.1] contact }\n"
      "joint (world cart) { type=free A=<T t(0 0 1)> }\n";
  for (const char* rule : {"", "collisions { rule=all_but_neighbours }"}) {
    const Model model = compile(parseOrs(shelves + rule, "shelves.ors").spec);
    EXPECT_EQ(reasons(model),
              "shelf2shelf3 fixed to each other, shelf2cart may collide, shelf3cart may collide");
    EXPECT_GT(
        motionClearance(model, ContactModel(model), model.initialPositions(), model.initialPositions(), 1e-6),
        0.5);
    EXPECT_THAT(collisionWarnings(model), IsEmpty());
  }
}

TEST(CollisionPairs, FreeJointsMakeNoNeighbours) {
  const std::string text = urdf({"A", "B"}, joint("floating", "A", "B", "0 0 0.1", ""));
  EXPECT_EQ(reasons(text), "AB may collide") << "and the overlap at home is not for ever";
}

TEST(CollisionPairs, KnowsTheRuleOfScenesOfTheCourse) {
  const std::string arm =
      "body a { type=ST_sphere size=[0 0 0 0.1] contact }\n"
      "body b { type=ST_sphere size=[0 0 0 0.1] contact }\n"
      "body c { type=ST_sphere size=[0 0 0 0.1] contact }\n"
      "joint (a b) { A=<T t(0 0 1)> }\n joint (b c) { A=<T t(0 0 1)> }\n";
  EXPECT_EQ(reasons(compile(parseOrs(arm, "a.ors").spec)),
            "ab neighbours, ac within four generations, bc neighbours");
  EXPECT_EQ(reasons(compile(parseOrs(arm + "collisions { rule=all_but_neighbours }", "a.ors").spec)),
            "ab neighbours, ac may collide, bc neighbours");
}

// A robot that is folded at 0, at an end of its limits, but not in their middle.
TEST(CollisionPairs, KeepsWhatOverlapsOnlyAtAnEndOfTheLimits) {
  for (const bool isFolded : {true, false}) {
    const std::string range = isFolded ? "<limit lower='0' upper='3' effort='1' velocity='1'/>"
                                       : "<limit lower='-3' upper='3' effort='1' velocity='1'/>";
    const std::string axis = "<axis xyz='0 0 1'/>";
    std::string hinge = joint("revolute", "A", "B", "0.25 0 0", axis),
                arm = joint("revolute", "B", "C", "-0.2 0 0", axis);
    for (std::string* one : {&hinge, &arm})
      if (const std::size_t at = one->find("<limit"); at != one->npos)
        one->replace(at, one->find("/>", at) + 2 - at, range);
    const std::string text = urdf({"base", "A", "B", "C"}, joint("revolute", "base", "A") + hinge + arm);
    EXPECT_EQ(reasons(text),
              isFolded ? "AB neighbours, AC may collide, BC neighbours"
                       : "AB neighbours, AC overlap at home by 0.15 m ('A' and 'C'), BC neighbours");
  }
}

TEST(CollisionPairs, LeavesOutWhatOverlapsAtHomeAndSaysSo) {
  const auto chain = [](double height) {
    return urdf({"base", "A", "B", "C"}, joint("revolute", "base", "A") +
                                             joint("revolute", "A", "B", "0 0 0.1") +
                                             joint("revolute", "B", "C", fmt::format("0 0 {}", height)));
  };
  EXPECT_EQ(reasons(chain(0.05)), "AB neighbours, AC overlap at home by 0.05 m ('A' and 'C'), BC neighbours");
  EXPECT_EQ(reasons(chain(0.1 - 2 * kHomeTolerance)),
            "AB neighbours, AC overlap at home by 2e-06 m ('A' and 'C'), BC neighbours");
  EXPECT_EQ(reasons(chain(0.1 - 0.5 * kHomeTolerance)), "AB neighbours, AC may collide, BC neighbours");
  const Model model = modelOf(chain(0.05));
  const Diagnostics warnings = collisionWarnings(model);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(
      toString(warnings[0]),
      "r.urdf: warning: 'A' and 'C' overlap at home by 0.05 m (shapes 'A' and 'C'), so their collisions are "
      "never checked: <disable_collisions link1=\"A\" link2=\"C\"/> in an SRDF says that this is intended, "
      "<enable_collisions .../> lets them collide");
  EXPECT_THAT(collidingPairs(model), IsEmpty());
}

Model chosen(std::vector<CollisionChoice> choices, double height = 0.05) {
  SceneSpec spec = parseUrdf(urdf({"base", "A", "B", "C"},
                                  joint("revolute", "base", "A") + joint("revolute", "A", "B", "0 0 0.1") +
                                      joint("revolute", "B", "C", fmt::format("0 0 {}", height))),
                             "r.urdf")
                       .spec;
  spec.collisionChoices = std::move(choices);
  return compile(spec);
}

TEST(CollisionPairs, DoesWhatTheSceneChooses) {
  EXPECT_EQ(reasons(chosen({{"C", "A", false, "Always"}})),
            "AB neighbours, AC disabled: Always, BC neighbours");
  EXPECT_THAT(collisionWarnings(chosen({{"C", "A", false}})), IsEmpty());
  EXPECT_EQ(reasons(chosen({{"A", "C", true}, {"A", "B", true, "User"}})),
            "AB enabled: User, AC enabled, BC neighbours");
  EXPECT_EQ(reasons(chosen({{"A", "C", true}, {"A", "C", false, "no"}, {"A", "C", true}})),
            "AB neighbours, AC disabled: no, BC neighbours")
      << "not counts more than may";
  EXPECT_EQ(reasons(chosen({{"A", "", false}, {"A", "C", true}}, 1)),
            "AB disabled, AC enabled, BC neighbours")
      << "a pair counts more than all";
  EXPECT_EQ(reasons(chosen({{"A", "", true}, {"C", "", false}})), "AB enabled, AC disabled, BC disabled")
      << "nor does all of a body help where another wants none";
}

TEST(CollisionPairs, SaysWhatIsEnabledToNoEffect) {
  SceneSpec spec = parseUrdf(urdf({"A", "B"}, joint("fixed", "A", "B")), "r.urdf").spec;
  spec.collisionChoices = {{"A", "B", true}};
  const Model model = compile(spec);
  EXPECT_EQ(reasons(model), "AB fixed to each other");
  const Diagnostics warnings = collisionWarnings(model);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(toString(warnings[0]),
            "r.urdf: warning: 'A' and 'B' are enabled, which has no effect: fixed to each other");
}

// Coupled joints.

TEST(CollisionPairs, LeavesOutWhatCoupledJointsKeepInPlace) {
  // Two jaws that slide the same way.
  EXPECT_EQ(reasons(urdf({"base", "A", "B"},
                         joint("prismatic", "base", "A") +
                             joint("prismatic", "base", "B", "0 0 0.1", mimic("baseA", 1, "2 0 0")))),
            "AB coupled joints keep them in place");
  // The other way they meet.
  EXPECT_EQ(reasons(urdf({"base", "A", "B"},
                         joint("prismatic", "base", "A", "0 0 0") +
                             joint("prismatic", "base", "B", "0 0 1", mimic("baseA", -1, "1 0 0")))),
            "AB may collide");
  // A hinge that turns back what carries it, about the same line and beside it.
  const auto back = [](const std::string& xyz) {
    return urdf({"base", "A", "B", "C"}, joint("fixed", "base", "A") + joint("revolute", "A", "B", "0 0 1") +
                                             joint("revolute", "B", "C", xyz, mimic("AB", -1, "1 0 0")));
  };
  EXPECT_EQ(reasons(back("0.5 0 0")), "AB neighbours, AC coupled joints keep them in place, BC neighbours");
  EXPECT_EQ(reasons(back("0.5 0.3 0")), "AB neighbours, AC may collide, BC neighbours");
  // One that follows at the ratio 0 stands still.
  EXPECT_EQ(reasons(urdf({"base", "A", "B", "C"},
                         joint("revolute", "base", "A") + joint("revolute", "A", "B", "0 0 1") +
                             joint("revolute", "B", "C", "0 0 1", mimic("AB", 0, "1 0 0")))),
            "AB neighbours, AC neighbours, BC fixed to each other");
}

// A parallelogram: the second crank follows the first, the coupler turns back.
TEST(CollisionPairs, KeepsWhatIsOnlyParallel) {
  EXPECT_EQ(
      reasons(urdf({"base", "A", "B", "C"},
                   joint("fixed", "base", "A") + joint("revolute", "A", "B", "0 0 1", "<axis xyz='0 1 0'/>") +
                       joint("revolute", "B", "C", "0 0 1", mimic("AB", -1, "0 1 0")))),
      "AB neighbours, AC may collide, BC neighbours");
}

// A second opinion: bodies move against each other if random postures say so.
double change(const Model& model, BodyId a, BodyId b, Rng& rng) {
  double most = 0;
  std::optional<Pose> first;
  for (int k = 0; k < 5; ++k) {
    const BodyPoses poses = forwardKinematics(model, randomPositions(rng, model.nq()));
    const Pose X = poses[a].inverse() * poses[b];
    if (!first) first = X;
    most = std::max({most, (X.R - first->R).cwiseAbs().maxCoeff(), (X.p - first->p).cwiseAbs().maxCoeff()});
  }
  return most;
}

// Random trees whose joints follow others a lot: about few lines, so that some cancel.
SceneSpec coupledScene(Rng& rng) {
  SceneSpec spec;
  spec.name = "coupled";
  const int bodies = 4 + rng.index(5);
  for (int i = 0; i < bodies; ++i) {
    BodySpec body{.name = fmt::format("b{}", i), .X_WB = {}};
    body.shapes.push_back(
        {.name = "", .X_BS = {}, .shape = {.type = ShapeType::kSphere, .radius = 1e-3}, .contact = true});
    spec.bodies.push_back(body);
    JointSpec joint{.name = fmt::format("j{}", i),
                    .parent = i == 0 ? "world" : fmt::format("b{}", rng.index(i)),
                    .child = body.name,
                    .X_PF = {},
                    .X_MC = {}};
    const JointType types[] = {JointType::kHinge, JointType::kSlider, JointType::kScrew,
                               JointType::kUniversal, JointType::kRigid};
    joint.type = types[rng.index(i == 0 ? 1 : 5)];
    joint.pitch = 0.3;
    joint.axis = Eigen::Vector3d::Unit(rng.index(2));
    joint.X_PF.p = 0.2 * rng.index(2) * Eigen::Vector3d::UnitX();
    const int leader = rng.index(std::max(1, i));
    if (i > 0 && spec.joints[static_cast<std::size_t>(leader)].mimic.empty() &&
        positionCount(spec.joints[static_cast<std::size_t>(leader)].type) == 1 &&
        positionCount(joint.type) == 1) {
      joint.mimic = fmt::format("j{}", leader);
      joint.mimicRatio = rng.index(3) - 1;
      joint.mimicOffset = 0.4 * rng.index(2);
    }
    spec.joints.push_back(joint);
  }
  return spec;
}

TEST(CollisionPairs, CannotMoveIsNeverWrong) {
  int still = 0, coupled = 0, missed = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Rng rng(seed);
    const Model model = compile(coupledScene(rng));
    for (const PairVerdict& verdict : pairVerdicts(model)) {
      const bool moves = change(model, verdict.a, verdict.b, rng) > 1e-9;
      const bool isStill =
          verdict.reason == PairReason::kSamePart || verdict.reason == PairReason::kCannotMove;
      EXPECT_FALSE(isStill && moves) << "seed " << seed << ": " << toString(verdict, model);
      still += isStill;
      coupled += verdict.reason == PairReason::kCannotMove;
      missed += !moves && !isStill;
    }
  }
  EXPECT_GT(still, 500);
  EXPECT_GT(coupled, 20);
  EXPECT_LT(missed, 20) << "allowed where it cannot be proven, but rare";
}

TEST(CollisionPairs, JudgesARobotLikeItsUrdf) {
  // Ball hips and planar bases become chains of frames.
  SceneSpec spec;
  spec.name = "chains";
  const auto ball = [](const std::string& name) {
    BodySpec body{.name = name, .X_WB = {}, .mass = 1};
    body.shapes.push_back(
        {.name = name, .X_BS = {}, .shape = {.type = ShapeType::kSphere, .radius = 0.1}, .contact = true});
    return body;
  };
  for (const char* name : {"a", "b", "c", "d"}) spec.bodies.push_back(ball(name));
  const auto hung = [](const char* parent, const char* child, JointType type) {
    JointSpec joint{.name = std::string(parent) + child,
                    .parent = parent,
                    .child = child,
                    .type = type,
                    .X_PF = {},
                    .X_MC = {}};
    joint.X_PF.p.z() = 1;
    return joint;
  };
  spec.joints = {hung("world", "a", JointType::kPlanarXYPhi), hung("a", "b", JointType::kUniversal),
                 hung("b", "c", JointType::kCylindrical), hung("c", "d", JointType::kPlanarXY)};
  const Model model = compile(spec), again = modelOf(writeUrdf(spec).text);
  EXPECT_EQ(reasons(model), reasons(again));
  EXPECT_THAT(reasons(model), AllOf(HasSubstr("ab neighbours"), HasSubstr("bd may collide")));
}

// The legs of the humanoid.

Model humanoid() { return compile(readUrdf(sourcePath("data/robots/humanoid/humanoid.urdf")).spec); }

Eigen::VectorXd spread(const Model& model, double left, double right) {
  Eigen::VectorXd q = model.initialPositions();
  for (const Joint& joint : model.joints()) {
    if (joint.name == "left_hip_roll") q[joint.qIndex] = left;
    if (joint.name == "right_hip_roll") q[joint.qIndex] = right;
  }
  return q;
}

TEST(CollisionPairs, SeesOneLegOfTheHumanoidInTheOther) {
  const Model model = humanoid();
  const ContactModel contacts(model);
  const Eigen::VectorXd apart = spread(model, 0.3, -0.3), crossed = spread(model, -0.45, 0.45);
  EXPECT_LT(motionClearance(model, contacts, apart, crossed, 1e-3), -0.05);
  const auto isThigh = [&](int shape) {
    const std::string& name = model[contacts.body(shape)].name;
    return name == "left_thigh" || name == "right_thigh";
  };
  const auto near = proxies(contacts, forwardKinematics(model, crossed), 0);
  EXPECT_TRUE(std::any_of(near.begin(), near.end(),
                          [&](const Proxy& one) { return isThigh(one.pair.a) && isThigh(one.pair.b); }));
  // By the rule of the course nothing touches where the legs are crossed.
  SceneSpec spec = readUrdf(sourcePath("data/robots/humanoid/humanoid.urdf")).spec;
  spec.collisionRule = CollisionRule::kFourGenerations;
  spec.collisionChoices.clear();
  const Model before = compile(spec);
  EXPECT_THAT(proxies(ContactModel(before), forwardKinematics(before, crossed), 0), IsEmpty());
}

TEST(CollisionPairs, FindsNoFaultWithOurOwnRobots) {
  for (const char* name : {"humanoid", "humanoid_hands", "quadruped", "hand", "gripper", "balancer",
                           "arm6dof", "arm7dof", "arm7offset"}) {
    const std::filesystem::path folder = sourcePath("data/robots") / name;
    const Model model = compile(readUrdf((folder / name).replace_extension(".urdf")).spec);
    for (const Diagnostic& one : collisionWarnings(model)) ADD_FAILURE() << toString(one);
  }
}

TEST(CollisionPairs, NeedsNoPairsForManyFixedBoxes) {
  SceneSpec spec;
  for (int i = 0; i < 1000; ++i) {
    BodySpec body{.name = fmt::format("box{}", i), .X_WB = {}};
    body.shapes.push_back({.name = "", .X_BS = {}, .shape = {.type = ShapeType::kBox}, .contact = true});
    spec.bodies.push_back(body);
  }
  EXPECT_THAT(collidingPairs(compile(spec)), IsEmpty());
}

}  // namespace rex::collision_pairs_test
