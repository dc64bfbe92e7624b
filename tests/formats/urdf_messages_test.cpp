#include <string>

#include <gtest/gtest.h>

#include "formats/urdf_reader.h"

namespace rex::urdf_messages_test {

struct Row {
  std::string text;     // '@' marks the place of the fault
  std::string message;  // without the place
};

std::string robot(const std::string& inside) { return "<robot name='r'>\n" + inside + "\n</robot>"; }
std::string link(const std::string& inside) { return robot("<link name='a'>\n" + inside + "\n</link>"); }
std::string visual(const std::string& inside) { return link("<visual>\n" + inside + "\n</visual>"); }
std::string geometry(const std::string& inside) { return visual("<geometry>" + inside + "</geometry>"); }
std::string inertial(const std::string& inside) { return link("<inertial>" + inside + "</inertial>"); }
std::string two(const std::string& joint) {
  return robot("<link name='arm'/>\n<link name='hand'/>\n" + joint);
}
const std::string kEnds = "<parent link='arm'/><child link='hand'/>";
std::string joint(const std::string& type, const std::string& inside) {
  return two("<joint name='j' type='" + type + "'>\n" + kEnds + inside + "\n</joint>");
}
std::string third(const std::string& inside) {
  return robot(
      "<link name='a'/><link name='b'/><link name='c'/>\n<joint name='j' type='continuous'><parent link='a'/>"
      "<child link='b'/></joint>\n<joint name='k' type='continuous'>" +
      inside + "</joint>");
}
std::string mimic(const std::string& type, const std::string& inside) {
  return robot("<link name='a'/><link name='b'/><link name='c'/>\n<joint name='j' type='" + type +
               "'><parent link='a'/><child link='b'/></joint>\n<joint name='k' type='continuous'>"
               "<parent link='b'/><child link='c'/>" +
               inside + "</joint>");
}
std::string followed(const std::string& lower, const std::string& upper, const std::string& ownLower,
                     const std::string& ownUpper) {
  const auto limit = [](const std::string& low, const std::string& high) {
    return "<limit lower='" + low + "' upper='" + high + "' velocity='1' effort='1'/>";
  };
  return robot(
      "<link name='a'/><link name='b'/><link name='c'/>\n<joint name='j' type='revolute'><parent link='a'/>"
      "<child link='b'/>" +
      limit(lower, upper) + "</joint>\n@<joint name='k' type='revolute'><parent link='b'/><child link='c'/>" +
      limit(ownLower, ownUpper) + "<mimic joint='j'/></joint>");
}
const std::string kMoments = "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>";

// Four links with shapes in a chain, of which the first and the last two have no mass.
std::string weighed(const std::string& mark) {
  const std::string shape = "<collision><geometry><sphere radius='1'/></geometry></collision></link>\n";
  const auto joint = [](const std::string& parent, const std::string& child) {
    return "<joint name='" + child + "' type='continuous'><parent link='" + parent + "'/><child link='" +
           child + "'/></joint>";
  };
  return robot("<link name='a'>" + shape + "<link name='b'><inertial><mass value='1'/>" + kMoments +
               "</inertial>" + shape + mark + "<link name='c'>" + shape + "<link name='d'>" + shape +
               joint("a", "b") + joint("b", "c") + joint("c", "d"));
}
const std::string kTypes = "revolute, continuous, prismatic, fixed, floating or planar";

SourceLocation takeMark(std::string& text) {
  const std::size_t at = text.find('@');
  text.erase(at, 1);
  const std::string before = text.substr(0, at);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  return {"f", static_cast<int>(line), static_cast<int>(at - (before.rfind('\n') + 1)) + 1};
}

void check(const std::vector<Row>& rows, const ReadOptions& options = {}) {
  for (Row row : rows) {
    const std::string wanted = toString(takeMark(row.text)) + ": " + row.message;
    try {
      static_cast<void>(parseUrdf(row.text, "f", options));
      ADD_FAILURE() << "read without an error:\n" << row.text;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), wanted) << row.text;
    }
  }
}

TEST(UrdfMessages, OfXml) {
  check({
      {"@", "not well-formed XML: no element found"},
      {"<robot>\n<link name='a'>\n</@link2>\n</robot>",
       "not well-formed XML: mismatched tag: wanted </link> first"},
      {"<robot>\n<link name='a'>\n@", "not well-formed XML: no element found: wanted </link> first"},
      {"<robot>\n<link name=@a/></robot>", "not well-formed XML: invalid token"},
      {"<robot name='a @& b'/>",
       "not well-formed XML: invalid token: wanted &amp; where the text has a bare &"},
      {"\n @body a {}\n", "not XML at all: found 'body a {}', wanted <robot ...>"},
      {"<robot>\n<link name='a' @name='b'/></robot>", "not well-formed XML: duplicate attribute"},
      {"<robot\nname='&lt;&#65;@&pi;'/>",
       "not well-formed XML: undefined entity: found '&pi;', wanted &amp; where the text has a bare &"},
      {"<robot a='&amp;'>\n@&pi;</robot>",
       "not well-formed XML: undefined entity: found '&pi;', wanted &amp; where the text has a bare &"},
      {"<robot/>@<robot/>", "not well-formed XML: junk after document element"},
      {"@<!DOCTYPE robot [<!ENTITY a 'b'>]>\n<robot/>",
       "a document type: found <!DOCTYPE, wanted none: custom entities are not read"},
      {"@<?xml version='1.0' encoding='UTF-16'?><robot/>",
       "encoding of the file: found 'UTF-16', wanted UTF-8, US-ASCII or ISO-8859-1"},
      {"@<?xml version='1.0' encoding='koi8-r'?><robot/>",
       "encoding of the file: found 'koi8-r', wanted UTF-8, US-ASCII or ISO-8859-1"},
      {"@\xff\xfe<", "encoding of the file: found UTF-16, wanted UTF-8, US-ASCII or ISO-8859-1"},
  });
}

std::string numbered(int from, int to) {
  std::string links;
  for (int i = from; i < to; ++i) links += "<link name='" + std::to_string(i) + "'/>";
  return links;
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST(UrdfMessages, OfLimits) {
  std::string attributes, joints;
  for (int i = 0; i < 65; ++i) attributes += " a" + std::to_string(i) + "=''";
  for (int i = 0; i < 1000; ++i) joints += "<joint name='" + std::to_string(i) + "'/>";
  check({
      {repeated("<a>", 100) + "@" + repeated("<a>", 60'000),
       "elements nested too deep: found level 101, wanted at most 100"},
      {"<robot>" + repeated("<a/>", 199'999) + "@<a/></robot>",
       "too many elements: found number 200001, wanted at most 200000"},
      {"<robot>@<link" + attributes + "/></robot>", "<link>: found 65 attributes, wanted at most 64"},
      {"<robot>@<" + std::string(257, 'a') + "/></robot>",
       "name too long: found 257 bytes, wanted at most 256"},
      {"<robot>@<a " + std::string(257, 'a') + "=''/></robot>",
       "attribute name too long: found 257 bytes, wanted at most 256"},
      {"<robot>" + joints + "@<joint/><joint/></robot>",
       "<robot>: too many <joint>: found 1002, wanted at most 1000"},
      {"<robot>" + numbered(0, 1001) + "@<link/></robot>",
       "<robot>: too many <link>: found 1002, wanted at most 1001"},
      {robot("<link name='@" + std::string(257, 'a') + "'/>"),
       "<link>: attribute 'name': found 257 bytes, wanted at most 256"},
      {"<robot name='r'><link name='@a\x7f"
       "b'/></robot>",
       "<link>: attribute 'name': found the control character \\x7f, wanted text"},
  });
  const std::string large(8 * 1024 * 1024 + 1, ' ');
  try {
    static_cast<void>(parseUrdf(large, "f"));
    ADD_FAILURE() << "read";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "f: scene file too large: found 8388609 bytes, wanted at most 8 MiB");
  }
}

TEST(UrdfMessages, OfXacroAndOtherLanguages) {
  const std::string message = "this is xacro, not yet URDF: found ";
  const std::string wanted = ", wanted plain URDF: run 'xacro FILE > robot.urdf' and read that";
  check({
      {robot("@<xacro:macro name='leg'/>"), message + "<xacro:macro>" + wanted},
      {robot("<link name='leg_@${side}'/>"), message + "'${side}'" + wanted},
      {robot("<link name='a&amp;b_@$(arg x)'/>"), message + "'$(arg x)'" + wanted},
      {robot("<link name='a' @xacro:if='1'/>"), message + "'xacro:if'" + wanted},
      {"@<sdf/>", "not a URDF robot: found <sdf>, wanted <robot>"},
      {"<?xml version='1.0'?>\n@<robt/>",
       "not a URDF robot: found <robt>, wanted <robot> (did you mean 'robot'?)"},
  });
}

TEST(UrdfMessages, OfLinks) {
  check({
      {"@<robot name='r'/>", "<robot>: no link: wanted at least one <link>"},
      {robot("@<link/>"), "<link>: attribute 'name' is missing"},
      {robot("@<link nam='a'/>"), "<link>: attribute 'name' is missing: found 'nam'"},
      {robot("<link name='@'/>"), "<link>: attribute 'name': found nothing, wanted a name"},
      {robot("<link name='a'/>\n@<link name='a'/>"),
       "a second link 'a': wanted a name of its own: the first is at f:2:1"},
      {visual("<origin xyz='@1 2'/>"), "link 'a': <origin>: attribute 'xyz': found '1 2', wanted 3 numbers"},
      {visual("<origin xyz='@1 2 3 4'/>"),
       "link 'a': <origin>: attribute 'xyz': found '1 2 3 4', wanted 3 numbers"},
      {visual("<origin xyz='1 &#32;\t\n@2,5 3'/>"),
       "link 'a': <origin>: attribute 'xyz': found '2,5', wanted 3 numbers"},
      {visual("<origin rpy='0 0 @nan'/>"),
       "link 'a': <origin>: attribute 'rpy': found 'nan', wanted finite numbers that fit into 64 bits"},
      {visual("<origin xyz='0 @-inf 0'/>"),
       "link 'a': <origin>: attribute 'xyz': found '-inf', wanted finite numbers that fit into 64 bits"},
      {visual("<origin xyz='@1e999 0 0'/>"),
       "link 'a': <origin>: attribute 'xyz': found '1e999', wanted finite numbers that fit into 64 bits"},
      {link("@<visual/>"), "link 'a': <visual>: <geometry> is missing"},
      {link("@<visual><geometri/></visual>"), "link 'a': <visual>: <geometry> is missing: found <geometri>"},
  });
}

TEST(UrdfMessages, OfShapes) {
  const std::string color = "<geometry><sphere radius='1'/></geometry>\n<material name='m'>";
  check({
      {geometry("").insert(geometry("").find("<geometry>"), "@"),
       "link 'a': <geometry>: no shape: wanted <box>, <cylinder>, <sphere>, <capsule>, <mesh> or "
       "<plane>"},
      {geometry("<shpere radius='1'/>").insert(geometry("").find("<geometry>"), "@"),
       "link 'a': <geometry>: no shape: found <shpere>, wanted <box>, <cylinder>, <sphere>, <capsule>, "
       "<mesh> or <plane> (did you mean 'sphere'?)"},
      {geometry("<plane normal='@0 0 0'/>"),
       "link 'a': <plane>: attribute 'normal': found '0 0 0', wanted a direction"},
      {geometry("<box size='@1 0 -1'/>"),
       "link 'a': <box>: attribute 'size': found '1 0 -1', wanted 3 numbers > 0"},
      {geometry("@<box/>"), "link 'a': <box>: attribute 'size' is missing"},
      {geometry("<sphere radius='@-1'/>"),
       "link 'a': <sphere>: attribute 'radius': found -1, wanted a number > 0"},
      {geometry("<sphere radius='@big'/>"),
       "link 'a': <sphere>: attribute 'radius': found 'big', wanted a number"},
      {geometry("@<cylinder radius='1'/>"), "link 'a': <cylinder>: attribute 'length' is missing"},
      {geometry("<capsule radius='1' length='@-1'/>"),
       "link 'a': <capsule>: attribute 'length': found -1, wanted a number > 0"},
      {geometry("@<mesh/>"), "link 'a': <mesh>: attribute 'filename' is missing"},
      {geometry("<mesh filename='@'/>"),
       "link 'a': <mesh>: attribute 'filename': found nothing, wanted a file"},
      {geometry("<mesh filename='a.stl' scale='@2 2'/>"),
       "link 'a': <mesh>: attribute 'scale': found '2 2', wanted 3 numbers"},
      {visual(color + "<color rgba='@1 1 1'/></material>"),
       "link 'a': <color>: attribute 'rgba': found '1 1 1', wanted 4 numbers"},
      {visual(color + "<color rgba='@255 0 0 1'/></material>"),
       "link 'a': <color>: attribute 'rgba': found '255 0 0 1', wanted 4 numbers from 0 to 1"},
      {robot("@<material name='m'/>"), "<robot>: <material>: <color> is missing"},
      {robot("<material name='m'><color rgba='1 1 1 1'/></material><material name='@m'><color rgba='1 1 1 "
             "1'/></material>"),
       "<robot>: <material>: a second material of this name: found 'm', wanted a name of its own"},
      {visual("<geometry><sphere radius='1'/></geometry>@<material/>"),
       "link 'a': <material>: attribute 'name' is missing"},
  });
}

TEST(UrdfMessages, OfInertias) {
  check({
      {inertial(kMoments).insert(inertial(kMoments).find("<inertial>"), "@"),
       "link 'a': <inertial>: <mass> is missing"},
      {link("@<inertial><mass value='1'/></inertial>"), "link 'a': <inertial>: <inertia> is missing"},
      {inertial("@<mass valeu='1'/>" + kMoments),
       "link 'a': <mass>: attribute 'value' is missing: found 'valeu'"},
      {inertial("<mass value='@-1'/>" + kMoments),
       "link 'a': <mass>: attribute 'value': found -1, wanted a number >= 0"},
  });
}

TEST(UrdfMessages, OfJoints) {
  check({
      {two("@<joint type='fixed'>" + kEnds + "</joint>"), "<joint>: attribute 'name' is missing"},
      {two("@<joint name='j'>" + kEnds + "</joint>"), "joint 'j': attribute 'type' is missing"},
      {two("<joint name='j' type='@revolut'>" + kEnds + "</joint>"),
       "joint 'j': unknown type: found 'revolut', wanted " + kTypes + " (did you mean 'revolute'?)"},
      {two("@<joint name='j' type='fixed'><parent link='arm'/></joint>"), "joint 'j': <child> is missing"},
      {two("<joint name='j' type='fixed'>@<parent/><child link='hand'/></joint>"),
       "joint 'j': <parent>: attribute 'link' is missing"},
      {two("<joint name='j' type='fixed'>@<parent name='arm'/><child link='hand'/></joint>"),
       "joint 'j': <parent>: attribute 'link' is missing: found 'name'"},
      {two("<joint name='j' type='fixed'><parent link='@amr'/><child link='hand'/></joint>"),
       "joint 'j': unknown parent: found 'amr', wanted the name of a link (did you mean 'arm'?)"},
      {two("<joint name='j' type='fixed'><parent link='arm'/><child link='@hnad'/></joint>"),
       "joint 'j': unknown child: found 'hnad', wanted the name of a link (did you mean 'hand'?)"},
      {two("<joint name='j' type='fixed'><parent link='arm'/><child link='@arm'/></joint>"),
       "joint 'j': parent and child are the same link: found 'arm', wanted two links"},
      {joint("continuous", "<axis xyz='@0 0 0'/>"),
       "joint 'j': <axis>: attribute 'xyz': found '0 0 0', wanted a direction"},
      {joint("continuous", "@<axis/>"), "joint 'j': <axis>: attribute 'xyz' is missing"},
      {two("@<joint name='j' type='revolute'>" + kEnds + "</joint>"),
       "joint 'j': <limit> is missing: wanted <limit lower=.. upper=.. effort=.. velocity=..> or type "
       "'continuous'"},
      {two("@<joint name='j' type='prismatic'><limits/>" + kEnds + "</joint>"),
       "joint 'j': <limit> is missing: found <limits>, wanted <limit lower=.. upper=.. effort=.. "
       "velocity=..>"},
      {joint("revolute", "<limit lower='-1' upper='1' velocity='@-1' effort='1'/>"),
       "joint 'j': <limit>: attribute 'velocity': found -1, wanted a number >= 0"},
      {joint("revolute", "<limit lower='-1' upper='1' velocity='1' effort='@much'/>"),
       "joint 'j': <limit>: attribute 'effort': found 'much', wanted a number"},
      {joint("continuous", "<dynamics damping='@-1'/>"),
       "joint 'j': <dynamics>: attribute 'damping': found -1, wanted a number >= 0"},
      {joint("continuous", "<dynamics friction='@-2'/>"),
       "joint 'j': <dynamics>: attribute 'friction': found -2, wanted a number >= 0"},
  });
}

TEST(UrdfMessages, OfMimics) {
  const std::string wanted = ", wanted a revolute, continuous or prismatic joint";
  check({
      {mimic("continuous", "@<mimic/>"), "joint 'k': <mimic>: attribute 'joint' is missing"},
      {mimic("continuous", "<mimic joint='@k'/>"),
       "joint 'k': mimic: found 'k', which mimics 'k', wanted a joint that mimics no other"},
      {mimic("fixed", "<mimic joint='@j'/>"), "joint 'k': mimic: found 'j'" + wanted},
      {mimic("floating", "<mimic joint='@j'/>"), "joint 'k': mimic: found 'j'" + wanted},
      {joint("planar", "@<mimic joint='j'/>"),
       "joint 'j': <mimic>: found a joint of type 'planar', wanted revolute, continuous or prismatic"},
      {mimic("continuous", "<mimic joint='j' multiplier='@x'/>"),
       "joint 'k': <mimic>: attribute 'multiplier': found 'x', wanted a number"},
      {robot(
           "<link name='a'/><link name='b'/><link name='c'/><link name='d'/>\n"
           "<joint name='j' type='continuous'><parent link='a'/><child link='b'/><mimic joint='@l'/></joint>"
           "<joint name='k' type='continuous'><parent link='b'/><child link='c'/><mimic joint='j'/></joint>\n"
           "<joint name='l' type='continuous'><parent link='c'/><child link='d'/><mimic "
           "joint='k'/></joint>"),
       "joint 'j': mimic: found 'l', which mimics 'k', wanted a joint that mimics no other"},
  });
}

// What other readers take, too; urdf_repair_test.cpp has what is made of it otherwise.
TEST(UrdfMessages, OfStrictReadings) {
  check(
      {
          {"\n@<?xml version='1.0'?>\n<robot name='r'><link name='a'/></robot>",
           "not well-formed XML: XML or text declaration not at start of entity"},
          {link("<inertial/>\n@<inertial/>"),
           "link 'a': a second <inertial>: wanted one: the first is at f:3:1"},
          {geometry("<sphere radius='@0'/>"),
           "link 'a': <sphere>: attribute 'radius': found '0', wanted a number > 0"},
          {inertial("<mass value='@0'/>" + kMoments),
           "link 'a': <mass>: an inertia without mass: found 0, wanted a mass > 0 kg"},
          {inertial("<mass value='1'/>@<inertia ixx='1' iyy='1' izz='1'/>"),
           "link 'a': <inertia>: attribute 'ixy' is missing"},
          {inertial("<mass value='1'/>@<inertia ixx='1' iyy='1' izz='1' ixyy='0' ixz='0' iyz='0'/>"),
           "link 'a': <inertia>: attribute 'ixy' is missing: found 'ixyy'"},
          {inertial("<mass value='1'/>@<inertia ixx='1' iyy='1' izz='1' ixy='2' ixz='0' iyz='0'/>"),
           "link 'a': <inertia>: a negative principal moment: wanted principal moments >= 0"},
          {joint("revolute", "<limit lower='@1' upper='-1' velocity='1' effort='1'/>"),
           "joint 'j': <limit>: attribute 'lower': found 1 > -1, wanted a lower limit that is not above the "
           "upper"},
          {joint("fixed", "@<mimic joint='j'/>"),
           "joint 'j': <mimic>: found a joint of type 'fixed', wanted revolute, continuous or prismatic"},
          {mimic("continuous", "<mimic joint='@jj'/>"),
           "joint 'k': mimic: found 'jj', wanted the name of a joint (did you mean 'j'?)"},
          {followed("0", "1", "2", "3"),
           "joint 'k': limits: found joint 'j' has no position left: 2 > 1, wanted limits that both joints "
           "can satisfy"},
          {followed("0", "1", "1", "3"),
           "joint 'k': limits: found joint 'j' may only be at 1, wanted limits that both joints can satisfy"},
      },
      {.strict = true});
}

TEST(UrdfMessages, OfTrees) {
  check({
      {third("<parent link='c'/><child link='@b'/>"),
       "joint 'k': link 'b' already has a parent: found joint 'j', wanted one joint leading to each link"},
      {robot("<link name='a'/><link name='b'/>\n@<link name='c'/>\n<joint name='j' type='fixed'>"
             "<parent link='a'/><child link='b'/></joint>"),
       "links that no joint connects: found 'a', 'c', wanted one root"},
      {robot("<link name='0'/>@" + numbered(1, 10)),
       "links that no joint connects: found '0', '1', '2', '3', '4', '5', '6', '7', 2 more, wanted one "
       "root"},
      {robot("<link name='a'/><link name='b'/><link name='c'/>\n"
             "@<joint name='j' type='fixed'><parent link='c'/><child link='b'/></joint>\n"
             "<joint name='k' type='fixed'><parent link='b'/><child link='c'/></joint>"),
       "joints form a loop: found 'b' > 'c' > 'b', wanted a tree"},
      {two("<joint name='j' type='fixed'>" + kEnds + "</joint>\n@<joint name='j' type='fixed'>" +
           "<parent link='arm'/><child link='hand'/></joint>"),
       "a second joint 'j': wanted a name of its own: the first is at f:4:1"},
      {robot("<link name='a'/><link name='world'/>\n<joint name='j' type='fixed'><parent link='a'/>"
             "<child link='@world'/></joint>"),
       "joint 'j': child: found 'world', wanted another link: the world itself does not move"},
  });
  check({{robot("@<link name='world'/>"),
          "a free base: found the root 'world', which holds the robot, wanted a root of another name, or a "
          "joint "
          "of type 'floating' below 'world'"},
         {robot("<link name='a'/><link name='b'/>@<joint name='world>a' type='fixed'><parent link='a'/>"
                "<child link='b'/></joint>"),
          "joint of the free base: found another joint 'world>a', wanted another name for that joint"}},
        {.freeBase = true});
}

// What is read, with a warning; '@' marks the place of the last note.
TEST(UrdfMessages, OfWarnings) {
  const std::string sphere = "<geometry><sphere radius='1'/></geometry>";
  const std::vector<Row> rows = {
      {"@<robot><link name='a'/></robot>", "warning: <robot>: attribute 'name' is missing"},
      {robot("@<lnk/><link name='a'/>"),
       "warning: <robot>: unknown tag <lnk> is ignored (did you mean 'link'?)"},
      {robot("<link name='a' @colour='red'/>"), "warning: link 'a': unknown attribute 'colour' is ignored"},
      {visual("@<orign/>" + sphere),
       "warning: link 'a': <visual>: unknown tag <orign> is ignored (did you mean 'origin'?)"},
      {link("<visual>\n @here " + sphere + "</visual>"), "warning: link 'a': <visual>: text is ignored"},
      {visual("<origin/>@<origin/>" + sphere),
       "warning: link 'a': <visual>: a second <origin>: wanted one: the first is at f:4:1; it is ignored"},
      {visual(sphere + "<material name='@gray'/>"),
       "warning: link 'a': <material>: unknown material 'gray' is drawn grey"},
      {robot("<material name='steel'><color rgba='1 1 1 1'/></material><link name='a'><visual>" + sphere +
             "<material name='@steal'/></visual></link>"),
       "warning: link 'a': <material>: unknown material 'steal' is drawn grey (did you mean 'steel'?)"},
      {inertial("<mass value='@0'/><inertia ixx='0' iyy='0' izz='0' ixy='0' ixz='0' iyz='0'/>"),
       "warning: link 'a': <mass>: 0 kg: the link has no mass, as without <inertial>"},
      {inertial("<mass value='1'/>@<inertia ixx='3' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"),
       "warning: link 'a': <inertia>: no body has this inertia: one principal moment exceeds the sum of the "
       "others"},
      {visual("<origin rpy='@0 0 90'/>" + sphere),
       "warning: link 'a': <origin>: attribute 'rpy' is '0 0 90': degrees? angles are radians"},
      {joint("revolute", "@<limit lower='-90' upper='90' velocity='1' effort='1'/>"),
       "warning: joint 'j': <limit>: the range is -90 to 90: degrees? angles are radians"},
      {joint("revolute", "@<limit velocity='1' effort='1'/>"),
       "warning: joint 'j': <limit>: without 'lower' and 'upper' the joint stays at 0"},
      {joint("revolute", "@<limit lower='0' upper='1' effort='1'/>"),
       "warning: joint 'j': <limit>: attribute 'velocity' is missing, so there is no such limit"},
      {joint("continuous", "@<limit velocity='1'/>"),
       "warning: joint 'j': <limit>: attribute 'effort' is missing, so there is no such limit"},
      {robot("<link name='a'/>@<gazebo/><gazebo reference='a'><x/></gazebo>"),
       "note: <gazebo> is ignored (2 times)"},
      {robot("<link name='a'/>@<transmission/>"), "note: <transmission> is ignored"},
      {joint("continuous", "@<safety_controller/>"), "note: <safety_controller> is ignored"},
      {joint("continuous", "@<limit lower='0' velocity='1' effort='1'/>"),
       "note: the range in <limit> of joints of type 'continuous' is ignored"},
      {visual(sphere + "<material name='m'>@<texture filename='x.png'/></material>"),
       "note: <texture> is ignored"},
      {robot("@<link name='world'><inertial><mass value='1'/>" + kMoments + "</inertial></link>"),
       "note: the <inertial> of the link 'world' is ignored"},
      {geometry("@<plane/>"), "note: a plane becomes a box 1 m thick and 100 m wide, which is not drawn"},
      {weighed("@"), "note: a link with shapes but without <inertial> has no mass (2 times)"},
  };
  for (Row row : rows) {
    const std::string wanted = toString(takeMark(row.text)) + ": " + row.message;
    const Diagnostics notes = parseUrdf(row.text, "f").notes;
    ASSERT_EQ(notes.size(), 1u) << row.text;
    EXPECT_EQ(toString(notes[0]), wanted);
  }
}

TEST(UrdfMessages, DoNotCountTheMarkOfUtf8) {
  const auto messageOf = [](const std::string& text) -> std::string {
    try {
      return toString(parseUrdf("\xef\xbb\xbf" + text, "f").notes.at(0));
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(messageOf("<robot><link name='a'/></robot>"),
            "f:1:1: warning: <robot>: attribute 'name' is missing");
  EXPECT_EQ(messageOf("<robot name='r'><lnk/>\n<link name='a'/></robot>"),
            "f:1:17: warning: <robot>: unknown tag <lnk> is ignored (did you mean 'link'?)");
  EXPECT_EQ(messageOf("<robot name=a/>"), "f:1:13: not well-formed XML: invalid token");
  EXPECT_EQ(messageOf(" body"), "f:1:2: not XML at all: found 'body', wanted <robot ...>");
}

TEST(UrdfMessages, IncludeTheNotesBeforeAFailure) {
  Diagnostics notes;
  EXPECT_THROW(static_cast<void>(parseUrdf(robot("<lnk name='a'/>"), "f", {.notesOfFailure = &notes})),
               Error);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(toString(notes[0]),
            "f:2:1: warning: <robot>: unknown tag <lnk> is ignored (did you mean 'link'?)");
}

TEST(UrdfMessages, StopAtAThousandWarnings) {
  const Diagnostics notes = parseUrdf(robot(repeated("<x/>", 1500) + "<link name='a'/>"), "f").notes;
  ASSERT_EQ(notes.size(), 1001u);
  EXPECT_EQ(toString(notes.back()), "f: warning: 500 more warnings are not listed");
}

TEST(UrdfMessages, AreNotMadeOfNamespaces) {
  EXPECT_TRUE(
      parseUrdf("<robot name='r' xmlns='x' xmlns:xacro='http://y' xml:base='z'><link name='a'/></robot>", "f")
          .notes.empty());
}

}  // namespace rex::urdf_messages_test
