// What becomes of every element and attribute that urdfdom knows, and of the tags that other programs add.
#include <map>

#include <gtest/gtest.h>

#include "base/text.h"
#include "formats/urdf_reader.h"

namespace rex::urdf_schema_test {

// What is said of a robot in which all that a class holds stands.
std::vector<std::string> notesOf(const std::string& inside, bool strict = false) {
  std::vector<std::string> notes;
  for (const Diagnostic& one :
       parseUrdf("<robot name='r' version='1.0'>" + inside + "</robot>", "f", {.strict = strict}).notes)
    notes.push_back(one.message);
  return notes;
}

// Every element with all its attributes.
const std::string kOrigin = "<origin xyz='1 2 3' rpy='.1 .2 .3'/>";
const std::string kInertial =
    "<inertial>" + kOrigin +
    "<mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
std::string shape(const std::string& tag, const std::string& geometry, const std::string& more = "") {
  return "<" + tag + " name='n'>" + kOrigin + "<geometry>" + geometry + "</geometry>" + more + "</" + tag +
         ">";
}
std::string robot(const std::string& inLink, const std::string& inJoint,
                  const std::string& type = "revolute") {
  return "<material name='red'><color rgba='1 0 0 1'/></material><link name='a'/><link name='b'>" + inLink +
         "</link><link name='c'/><joint name='i' type='continuous'><parent link='a'/><child "
         "link='c'/></joint>"
         "<joint name='j' type='" +
         type + "'>" + kOrigin + "<parent link='a'/><child link='b'/><axis xyz='0 0 1'/>" + inJoint +
         "</joint>";
}
const std::string kLimit = "<limit lower='-1' upper='1' velocity='1' effort='1'/>";

// With an effect on motion, contact or picture, all of it is read; nothing is said.
TEST(UrdfSchema, ReadsAllThatHasAnEffect) {
  for (const std::string geometry :
       {"<box size='1 1 1'/>", "<cylinder radius='1' length='1'/>", "<sphere radius='1'/>",
        "<capsule radius='1' length='1'/>", "<mesh filename='m.stl' scale='1 1 1'/>"})
    for (const std::string tag : {"visual", "collision"}) {
      const std::string link =
          kInertial + shape(tag, geometry, tag == "visual" ? "<material name='red'/>" : "");
      for (const bool strict : {false, true})
        EXPECT_EQ(notesOf(robot(link, kLimit), strict), std::vector<std::string>()) << link;
    }
  const std::string drive =
      "<dynamics damping='1' friction='1'/><mimic joint='i' multiplier='2' offset='1'/>";
  for (const std::string type : {"revolute", "prismatic"})
    EXPECT_EQ(notesOf(robot("", kLimit + drive, type)), std::vector<std::string>());
  EXPECT_EQ(notesOf(robot("", drive, "continuous")), std::vector<std::string>());
  for (const std::string type : {"fixed", "floating", "planar"})
    EXPECT_EQ(notesOf(robot("", "", type)), std::vector<std::string>());
}

// Tags that only other programs use are noted once each, also by a strict reading.
TEST(UrdfSchema, NotesWhatIsForOthers) {
  const std::map<std::string, std::string> others = {
      {"<gazebo/>", robot("", kLimit) + "@"},
      {"<transmission/>", robot("", kLimit) + "@"},
      {"<ros2_control/>", robot("", kLimit) + "@"},
      {"<sensor/>", robot("@", kLimit)},
      {"<calibration rising='1' falling='1'/>", robot("", kLimit + "@")},
      {"<safety_controller soft_lower_limit='0' soft_upper_limit='1' k_position='1' k_velocity='1'/>",
       robot("", kLimit + "@")},
      {"<texture filename='t.png'/>", robot(shape("visual", "<sphere radius='1'/>",
                                                  "<material name='m'><color rgba='1 1 1 1'/>@</material>"),
                                            kLimit)}};
  for (const auto& [tag, around] : others) {
    std::string text = around;
    text.replace(text.find('@'), 1, tag);
    const std::string name = tag.substr(1, tag.find_first_of(" /") - 1);
    for (const bool strict : {false, true})
      EXPECT_EQ(notesOf(text, strict), std::vector<std::string>{"<" + name + "> is ignored"});
  }
}

// What nobody has decided on is a warning wherever it stands, in tags and in attributes.
TEST(UrdfSchema, WarnsOfWhatIsUnknown) {
  const std::string whole =
      robot(kInertial + shape("visual", "<sphere radius='1'/>", "<material name='red'/>"),
            kLimit + "<dynamics damping='1' friction='1'/><mimic joint='i' multiplier='1' offset='0'/>");
  std::size_t places = 0;
  for (std::size_t at = whole.find('<'); at != whole.npos; at = whole.find('<', at + 1)) {
    if (whole[at + 1] == '/') continue;
    const std::size_t end = whole.find_first_of(" />", at);
    std::string text = whole;
    EXPECT_EQ(notesOf(text.insert(end, " strange='1'")).size(), 1u) << text;
    text = whole;
    if (const std::size_t close = whole.find('>', at); whole[close - 1] == '/')
      text.replace(close - 1, 2, "><strange/></" + whole.substr(at + 1, end - at - 1) + ">");
    else
      text.insert(close + 1, "<strange/>");
    EXPECT_EQ(notesOf(text).size(), 1u) << text;
    ++places;
  }
  EXPECT_GE(places, 25u);
}

}  // namespace rex::urdf_schema_test
