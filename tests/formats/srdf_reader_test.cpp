#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/srdf.h"
#include "formats/urdf_reader.h"
#include "scene/model.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::srdf_reader_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kArm =
    "<robot name='arm'><link name='base'/><link name='forearm'/><link name='hand'/>"
    "<joint name='j' type='continuous'><parent link='base'/><child link='forearm'/></joint>"
    "<joint name='k' type='continuous'><parent link='forearm'/><child link='hand'/></joint></robot>";

SceneFile withSrdf(const std::string& inside) {
  SceneFile scene = parseUrdf(kArm, "arm.urdf");
  parseSrdf("<robot name='arm'>\n" + inside + "\n</robot>", "arm.srdf", scene);
  return scene;
}

// Those of one scene, a line each.
std::string notesOf(const std::string& inside) {
  std::string text;
  for (const Diagnostic& one : withSrdf(inside).notes) text += (text.empty() ? "" : "\n") + toString(one);
  return text;
}

void expectChoice(const CollisionChoice& choice, const CollisionChoice& wanted) {
  EXPECT_EQ(choice.a, wanted.a);
  EXPECT_EQ(choice.b, wanted.b);
  EXPECT_EQ(choice.mayCollide, wanted.mayCollide);
  EXPECT_EQ(choice.reason, wanted.reason);
}

TEST(SrdfReader, ReadsWhoMayCollide) {
  const SceneFile scene = withSrdf(
      "<disable_default_collisions link='hand'/>\n"
      "<disable_collisions link1='base' link2='forearm' reason='Adjacent'/>\n"
      "  <enable_collisions link1='hand' link2='world'/>");
  EXPECT_THAT(scene.notes, IsEmpty());
  ASSERT_EQ(scene.spec.collisionChoices.size(), 3u);
  expectChoice(scene.spec.collisionChoices[0], {"hand", "", false});
  expectChoice(scene.spec.collisionChoices[1], {"base", "forearm", false, "Adjacent"});
  expectChoice(scene.spec.collisionChoices[2], {"hand", "world", true});
  EXPECT_EQ(toString(scene.spec.collisionChoices[2].where), "arm.srdf:4:3");
  const Model model = compile(scene.spec);
  ASSERT_EQ(model.collisionChoices().size(), 3u);
  EXPECT_EQ(model.collisionChoices()[0].a, model.body("hand"));
  EXPECT_FALSE(model.collisionChoices()[0].b);
  EXPECT_EQ(model.collisionChoices()[2].b, kWorld);
}

TEST(SrdfReader, WarnsOfLinksThatAreNotThere) {
  EXPECT_EQ(
      notesOf("<disable_collisions link1='base' link2='foream' reason='Never'/>"),
      "arm.srdf:2:41: warning: <robot>: <disable_collisions>: the robot has no link 'foream': ignored (did "
      "you mean 'forearm'?)");
  EXPECT_THAT(notesOf("<enable_collisions link1='x' link2='y'/>"),
              ::testing::AllOf(HasSubstr("no link 'x'"), HasSubstr("no link 'y'")));
  EXPECT_EQ(
      notesOf("<disable_default_collisions link='hnd'/>"),
      "arm.srdf:2:35: warning: <robot>: <disable_default_collisions>: the robot has no link 'hnd': ignored "
      "(did you mean 'hand'?)");
  EXPECT_THAT(withSrdf("<disable_default_collisions link='hnd'/>").spec.collisionChoices, IsEmpty());
}

TEST(SrdfReader, WarnsOfPairsThatAreGivenTwice) {
  EXPECT_EQ(
      notesOf(
          "<disable_collisions link1='base' link2='hand'/>\n<disable_collisions link1='hand' link2='base'/>"),
      "arm.srdf:3:1: warning: <robot>: <disable_collisions>: the pair 'hand' and 'base' is given twice; the "
      "first is at arm.srdf:2:1");
  EXPECT_EQ(
      notesOf(
          "<disable_collisions link1='base' link2='hand'/>\n<enable_collisions link1='base' link2='hand'/>"),
      "arm.srdf:3:1: warning: <robot>: <enable_collisions>: the pair 'base' and 'hand' is both enabled and "
      "disabled: disabled counts; the first is at arm.srdf:2:1");
  EXPECT_THAT(notesOf("<disable_default_collisions link='hand'/><disable_default_collisions link='hand'/>"),
              HasSubstr("'hand' is given twice"));
}

TEST(SrdfReader, SaysInOneNoteWhatElseThereIs) {
  EXPECT_EQ(notesOf("<group name='a'><chain base_link='base' tip_link='hand'/></group>\n<group name='b'/>\n"
                    "<end_effector name='e'/><virtual_joint name='v'/>"),
            "arm.srdf:2:1: note: only collisions and states of an SRDF are read: <end_effector>, <group> (2 "
            "times), "
            "<virtual_joint> skipped");
  const std::string state = "<group_state name='s' group='arm'><joint name='j' value='1'/></group_state>";
  EXPECT_EQ(notesOf("<group name='arm'><joint name='j'/></group>" + state), "");
  EXPECT_THAT(notesOf("<group name='arm'/><group name='leg'/>" + state), HasSubstr("<group> skipped"));
}

TEST(SrdfReader, WarnsOfWhatItDoesNotKnow) {
  EXPECT_EQ(notesOf("<disable_collision link1='base' link2='hand'/>"),
            "arm.srdf:2:1: warning: <robot>: unknown tag <disable_collision> is ignored (did you mean "
            "'disable_collisions'?)");
  EXPECT_EQ(
      notesOf("<disable_collisions link1='base' link2='hand' reson='Never'/>"),
      "arm.srdf:2:47: warning: <robot>: <disable_collisions>: unknown attribute 'reson' is ignored (did you "
      "mean 'reason'?)");
}

TEST(SrdfReader, RefusesWithThePlace) {
  EXPECT_REX_ERROR(withSrdf("<disable_collisions link1='base'/>"),
                   "arm.srdf:2:1: <robot>: <disable_collisions>: attribute 'link2' is missing");
  EXPECT_REX_ERROR(withSrdf("<enable_collisions link1='hand' link2='hand'/>"),
                   "arm.srdf:2:40: <robot>: <enable_collisions>: one link: found 'hand', wanted two links");
  EXPECT_REX_ERROR(withSrdf("<disable_default_collisions link=''/>"),
                   "arm.srdf:2:35: <robot>: <disable_default_collisions>: attribute 'link': found nothing");
  EXPECT_REX_ERROR(withSrdf("<link name='base'/>"),
                   "arm.srdf:2:1: not an SRDF: found <link>, a part of a URDF, wanted a semantic "
                   "description, such as <disable_collisions>");
  EXPECT_REX_ERROR(
      withSrdf("<group name='${side}_arm'/>"),
      "arm.srdf:2:14: this is xacro, not yet SRDF: found '${side}_arm', wanted plain SRDF: run 'xacro "
      "FILE > robot.srdf' and read that");
  EXPECT_REX_ERROR(withSrdf("<group>"), "arm.srdf:3:3: not well-formed XML");
  SceneFile scene = parseUrdf(kArm, "arm.urdf");
  EXPECT_REX_ERROR(parseSrdf("<robt/>", "arm.srdf", scene),
                   "arm.srdf:1:1: not an SRDF: found <robt>, wanted <robot> (did you mean 'robot'?)");
}

class SrdfFile : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
  }
  SceneFile readArm(const ReadOptions& options = {}) const {
    return readUrdf(folder_.path() / "arm.urdf", options);
  }
  fs::path in(const char* name) const { return folder_.path() / name; }

 private:
  TemporaryFolder folder_;
};

TEST_F(SrdfFile, IsReadWhereItLiesBesideTheRobot) {
  write("arm.urdf", kArm);
  EXPECT_THAT(readArm().spec.collisionChoices, IsEmpty());
  write("arm.srdf",
        "<robot name='arm'><disable_collisions link1='base' link2='hand' reason='Never'/></robot>");
  ASSERT_EQ(readArm().spec.collisionChoices.size(), 1u);
  write("other.srdf", "<robot name='arm'/>");
  EXPECT_THAT(readArm({.srdf = in("other.srdf")}).spec.collisionChoices, IsEmpty());
  write("arm.srdf", "<robot");
  EXPECT_REX_ERROR(readArm(), "arm.srdf:1:");
}

// As in packages of MoveIt and example-robot-data; the one beside it comes first.
TEST_F(SrdfFile, IsReadWhereItLiesInASiblingFolder) {
  for (const char* folder : {"urdf", "srdf"}) fs::create_directory(in(folder));
  write("urdf/arm.urdf", kArm);
  write("srdf/arm.srdf",
        "<robot name='arm'><disable_collisions link1='base' link2='hand' reason='Never'/></robot>");
  EXPECT_EQ(readUrdf(in("urdf/arm.urdf")).spec.collisionChoices.size(), 1u);
  write("urdf/arm.srdf", "<robot name='arm'/>");
  EXPECT_THAT(readUrdf(in("urdf/arm.urdf")).spec.collisionChoices, IsEmpty());
}

TEST_F(SrdfFile, MustBeThereWhereItIsAskedFor) {
  write("arm.urdf", kArm);
  write("arms.srdf", "<robot name='arm'/>");
  EXPECT_REX_ERROR(
      readArm({.srdf = in("arm.srdf")}),
      "arm.srdf: cannot read the collision settings: found no such file, wanted an SRDF file (did you mean "
      "'arm.urdf' or 'arms.srdf'?)");
  fs::create_directory(in("arm.srdf"));
  EXPECT_REX_ERROR(readArm(), "cannot read the collision settings: found a folder");
}

TEST(SrdfWriter, WritesWhatIsReadAgain) {
  const std::vector<CollisionChoice> choices = {
      {"hand", "", false}, {"base", "forearm", false, "a \"<&> b"}, {"hand", "world", true}};
  const std::string text = writeSrdf("arm", choices, "A comment.");
  EXPECT_EQ(text,
            "<?xml version=\"1.0\"?>\n<!-- A comment. -->\n<robot name=\"arm\">\n"
            "  <disable_default_collisions link=\"hand\"/>\n"
            "  <disable_collisions link1=\"base\" link2=\"forearm\" reason=\"a &#34;&#60;&#38;&#62; b\"/>\n"
            "  <enable_collisions link1=\"hand\" link2=\"world\"/>\n</robot>\n");
  SceneFile scene = parseUrdf(kArm, "arm.urdf");
  parseSrdf(text, "arm.srdf", scene);
  ASSERT_EQ(scene.spec.collisionChoices.size(), choices.size());
  for (std::size_t i = 0; i < choices.size(); ++i) expectChoice(scene.spec.collisionChoices[i], choices[i]);
}

}  // namespace rex::srdf_reader_test
