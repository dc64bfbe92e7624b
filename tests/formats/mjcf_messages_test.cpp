#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/mjcf_reader.h"

namespace rex::mjcf_messages_test {

struct Row {
  std::string text;     // '@' marks the place of the fault
  std::string message;  // without the place
};

std::string model(const std::string& inside) { return "<mujoco>\n" + inside + "\n</mujoco>"; }
std::string world(const std::string& inside) { return model("<worldbody>" + inside + "</worldbody>"); }
std::string body(const std::string& inside) { return world("<body name='a'>\n" + inside + "\n</body>"); }
std::string compiler(const std::string& attributes) { return model("<compiler " + attributes + "/>"); }
std::string jointed(const std::string& inside) {
  return model(
      "<worldbody><body name='a'><joint name='j'/><body name='b'><joint name='k' type='slide'/><body "
      "name='c'>"
      "<joint name='ball' type='ball'/></body></body></body></worldbody>\n" +
      inside);
}
std::string equal(const std::string& inside) { return jointed("<equality>" + inside + "</equality>"); }
std::string connects(int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += "<connect body1='a' anchor='0 0 0'/>";
  return text;
}
std::string nested(const std::string& tag, const std::string& attribute, int times) {
  std::string text;
  for (int i = 0; i < times; ++i)
    text += (i + 1 == times ? "@<" : "<") + tag + " " + attribute + "='" + std::to_string(i) + "'>";
  for (int i = 0; i < times; ++i) text += "</" + tag + ">";
  return text;
}

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
      static_cast<void>(parseMjcf(row.text, "f", options));
      ADD_FAILURE() << "read without an error:\n" << row.text;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), wanted) << row.text;
    }
  }
}

// All notes of a text, of which the first is at '@'.
void checkNotes(const std::vector<Row>& rows) {
  for (Row row : rows) {
    const std::string wanted = toString(takeMark(row.text)) + ": " + row.message;
    std::string all;
    for (const Diagnostic& one : parseMjcf(row.text, "f").notes)
      all += (all.empty() ? "" : "\n") + toString(one);
    EXPECT_EQ(all, wanted) << row.text;
  }
}

TEST(MjcfMessages, OfFiles) {
  check({
      {"@<robot name='r'/>",
       "not an MJCF model: found <robot>, wanted <mujoco>; if it is a robot in URDF, name it .urdf"},
      {"@<mujico/>", "not an MJCF model: found <mujico>, wanted <mujoco> (did you mean 'mujoco'?)"},
      {"@body a {}", "not XML at all: found 'body a {}', wanted <mujoco ...>"},
      {"<mujoco>\n</@mujico>", "not well-formed XML: mismatched tag: wanted </mujoco> first"},
  });
}

TEST(MjcfMessages, OfCompilers) {
  check({
      {compiler("coordinate='@globl'"),
       "<compiler>: attribute 'coordinate': found 'globl', wanted local or global (did you mean 'global'?)"},
      {compiler("angle='@degrees'"),
       "<compiler>: attribute 'angle': found 'degrees', wanted radian or degree (did you mean 'degree'?)"},
      {compiler("eulerseq='@xy'"),
       "<compiler>: attribute 'eulerseq': found 'xy', wanted three letters from x, y, z, X, Y and Z"},
      {compiler("autolimits='@yes'"),
       "<compiler>: attribute 'autolimits': found 'yes', wanted false or true"},
      {compiler("inertiafromgeom='@maybe'"),
       "<compiler>: attribute 'inertiafromgeom': found 'maybe', wanted false, true or auto"},
      {compiler("inertiagrouprange='@1'"),
       "<compiler>: attribute 'inertiagrouprange': found '1', wanted 2 numbers"},
      {compiler("exactmeshinertia='@yes'"),
       "<compiler>: attribute 'exactmeshinertia': found 'yes', wanted false or true"},
  });
}

TEST(MjcfMessages, OfDefaults) {
  check({
      {model("<default><default class='a'/><default class='@a'/></default>"),
       "default 'main': <default>: a second class of this name: found 'a', wanted a name of its own"},
      {model("<default>@<default/></default>"), "default 'main': <default>: attribute 'class' is missing"},
      {model("<default><default class='a'/></default><default class='@a'/>"),
       "<mujoco>: <default>: a second class of this name: found 'a', wanted a name of its own"},
      {model("<default>" + nested("default", "class", 16) + "</default>"),
       "default '15': classes nested too deep: found level 17, wanted at most 16"},
      {body("<geom class='@visul' size='1'/>").insert(9, "<default><default class='visual'/></default>"),
       "body 'a': <geom>: attribute 'class': found 'visul', wanted the class of a <default> (did you mean "
       "'visual'?)"},
      {world("<body childclass='@x'/>"),
       "<body>: attribute 'childclass': found 'x', wanted the class of a <default>"},
  });
}

TEST(MjcfMessages, OfPoses) {
  check({
      {world("<body pos='@1 2'/>"), "<body>: attribute 'pos': found '1 2', wanted 3 numbers"},
      {world("<body quat='@0 0 0 0'/>"),
       "<body>: attribute 'quat': found '0 0 0 0', wanted a quaternion w x y z"},
      {world("<body axisangle='@0 0 0 1'/>"),
       "<body>: attribute 'axisangle': found '0 0 0 1', wanted a direction and an angle"},
      {world("<body zaxis='@0 0 0'/>"), "<body>: attribute 'zaxis': found '0 0 0', wanted a direction"},
      {world("<body xyaxes='@1 0 0 -2 0 0'/>"),
       "<body>: attribute 'xyaxes': found '1 0 0 -2 0 0', wanted two directions that are not parallel"},
      {world("<body quat='1 0 0 0' euler='@1 2 3'/>"),
       "<body>: two orientations: found 'quat' and 'euler', wanted one"},
  });
}

TEST(MjcfMessages, OfBodies) {
  check({
      {world("<body name='a'/>\n<body name='@a'/>"),
       "body 'a': a second body of this name: wanted a name of its own: the first is at f:2:12"},
      {world("<body name='@world'/>"),
       "body 'world': attribute 'name': found the name of the world itself, wanted another name"},
      {world(nested("frame", "name", 99)), "elements nested too deep: found level 101, wanted at most 100"},
      {world("@<joint/>"),
       "<worldbody>: <joint>: on the world: wanted bodies and geoms: the world itself does not move"},
      {world("@<inertial pos='0 0 0' mass='1'/>"),
       "<worldbody>: <inertial>: on the world: wanted bodies and geoms: the world itself does not move"},
  });
}

TEST(MjcfMessages, OfInertias) {
  const std::string given = "pos='0 0 0' mass='1' ";
  check({
      {body("@<inertial pos='0 0 0'/>"), "body 'a': <inertial>: attribute 'mass' is missing"},
      {body("<inertial pos='0 0 0' mass='@-1'/>"),
       "body 'a': <inertial>: attribute 'mass': found -1, wanted a number >= 0"},
      {body("<inertial " + given + "diaginertia='1 1 1'/>@<inertial " + given + "/>"),
       "body 'a': <inertial>: a second one: wanted one"},
      {body("<inertial " + given + "diaginertia='1 1 1' fullinertia='@1 1 1 0 0 0'/>"),
       "body 'a': <inertial>: attribute 'fullinertia': found 'diaginertia' as well, wanted one of them"},
      {body("<inertial " + given + "euler='0 0 1' fullinertia='@1 1 1 0 0 0'/>"),
       "body 'a': <inertial>: attribute 'fullinertia': found an orientation as well, wanted one of them"},
  });
  const std::vector<Row> doubtful = {
      {body("@<inertial mass='1' diaginertia='1 1 1'/>"), "body 'a': <inertial>: attribute 'pos' is missing"},
      {body("@<inertial " + given + "/>"),
       "body 'a': <inertial>: attribute 'diaginertia' or 'fullinertia' is missing"},
      {body("<inertial pos='0 0 0' mass='@0' diaginertia='1 1 1'/>"),
       "body 'a': <inertial>: an inertia without mass: found 0, wanted a mass > 0 kg"},
      {body("@<inertial " + given + "diaginertia='1 1 -1'/>"),
       "body 'a': <inertial>: a negative principal moment: wanted principal moments >= 0"}};
  check(doubtful, {.strict = true});
  checkNotes({
      {doubtful[0].text, "warning: body 'a': <inertial>: attribute 'pos' is missing; it counts as 0 0 0"},
      {doubtful[1].text,
       "warning: body 'a': <inertial>: attribute 'diaginertia' or 'fullinertia' is missing; the inertia "
       "counts as 0"},
      {doubtful[2].text,
       "warning: body 'a': <inertial>: an inertia without mass: found 0, wanted a mass > 0 kg; the body has "
       "neither"},
      {body("@<inertial mass='10'/>").insert(9, "<compiler inertiafromgeom='true'/>"),
       "warning: body 'a': <inertial>: is ignored: inertiafromgeom asks for the mass of the geoms"},
  });
}

TEST(MjcfMessages, OfGeoms) {
  check({
      {body("@<geom/>"), "body 'a': <geom>: attribute 'size' is missing: wanted a radius > 0"},
      {body("<geom name='g' type='capsule' size='@.1'/>"),
       "geom 'g': attribute 'size': found '.1', wanted a radius and half a length > 0"},
      {body("<geom type='box' size='@1 0 1'/>"),
       "body 'a': <geom>: attribute 'size': found '1 0 1', wanted 3 half edges > 0"},
      {body("<geom type='cylinder' fromto='0 0 0 1 0 0' size='@-1'/>"),
       "body 'a': <geom>: attribute 'size': found '-1', wanted a radius > 0"},
      {body("<geom type='capsule' fromto='@1 0 0 1 0 0' size='1'/>"),
       "body 'a': <geom>: attribute 'fromto': found '1 0 0 1 0 0', wanted two different points"},
      {body("<geom type='capsule' fromto='1 0 0 0 0 0' pos='@0 0 0' size='1'/>"),
       "body 'a': <geom>: attribute 'pos': found 'fromto' as well, wanted one of them"},
      {body("<geom type='@capsul' size='1'/>"),
       "body 'a': <geom>: attribute 'type': found 'capsul', wanted sphere, capsule, cylinder, box, "
       "ellipsoid, "
       "mesh, "
       "plane, hfield or sdf (did you mean 'capsule'?)"},
      {body("<geom type='plane' size='@-1 1 1'/>"),
       "body 'a': <geom>: attribute 'size': found '-1 1 1', wanted half edges >= 0"},
      {body("<geom size='1' contype='@1.5'/>"),
       "body 'a': <geom>: attribute 'contype': found '1.5', wanted a 32-bit integer"},
      {body("<geom size='1' shellinertia='@1'/>"),
       "body 'a': <geom>: attribute 'shellinertia': found '1', wanted false or true"},
      {body("<geom size='1' mass='@-1'/>"),
       "body 'a': <geom>: attribute 'mass': found -1, wanted a number >= 0"},
      {body("<geom size='@1 1 1 1'/>"),
       "body 'a': <geom>: attribute 'size': found '1 1 1 1', wanted 1 to 3 numbers"},
      {body("<geom type='mesh' mesh='@hnd'/>").insert(9, "<asset><mesh file='hand.stl'/></asset>"),
       "body 'a': <geom>: unknown mesh: found 'hnd', wanted a <mesh> of the <asset> (did you mean 'hand'?)"},
      {body("@<geom type='mesh'/>"), "body 'a': <geom>: attribute 'mesh' is missing"},
      {body("<geom type='box' mesh='@m'/>"),
       "body 'a': <geom>: unknown mesh: found 'm', wanted a <mesh> of the <asset>"},
      {body("<geom mesh='m' fitscale='@0'/>").insert(9, "<asset><mesh file='m.stl'/></asset>"),
       "body 'a': <geom>: attribute 'fitscale': found 0, wanted a number > 0"},
      {body("<geom type='hfield' hfield='@h'/>"),
       "body 'a': <geom>: unknown hfield: found 'h', wanted a <hfield> of the <asset>"},
      {body("@<geom type='hfield'/>"), "body 'a': <geom>: attribute 'hfield' is missing"},
  });
  const std::string blank = body("<geom size='1' rgba='@ '/>");
  check({{blank, "body 'a': <geom>: attribute 'rgba': found nothing, wanted numbers"}}, {.strict = true});
  const std::string bright = body("<geom size='1' rgba='@2 0 0 1'/>");
  check({{bright, "body 'a': <geom>: attribute 'rgba': found '2 0 0 1', wanted 4 numbers from 0 to 1"}},
        {.strict = true});
  checkNotes({
      {bright,
       "warning: body 'a': <geom>: attribute 'rgba': found '2 0 0 1', wanted 4 numbers from 0 to 1; the "
       "nearest such numbers are used"},
      {blank,
       "warning: body 'a': <geom>: attribute 'rgba': found nothing, wanted numbers; it counts as not given"},
      {body("@<geom size='1' material='x'/><geom size='1' material='x'/>"),
       "note: unknown material 'x': the geom keeps its own colour: the picture will differ (2 times)"},
      {world("@<geom type='mesh' mesh='m'/><geom mesh='m'/>").insert(9, "<asset><mesh name='m'/></asset>"),
       "warning: a <geom> whose mesh is not read is ignored, with its mass: motion will differ (2 times)"},
      {world("@<geom type='sdf'/>"),
       "warning: a <geom> of type 'sdf' is ignored, with its mass: motion will differ"},
  });
}

TEST(MjcfMessages, OfAssets) {
  const auto field = [](const std::string& attributes) {
    return model("<asset><hfield name='h' " + attributes + "/></asset>");
  };
  std::string fields;
  for (int i = 0; i < 16; ++i)
    fields += "<hfield name='" + std::to_string(i) + "' size='1 1 1 1' nrow='2' ncol='2'/>";
  check({
      {model("<asset><mesh file='a.stl'/><mesh file='@b/a.obj'/></asset>"),
       "<asset>: <mesh>: a second mesh of this name: found 'a', wanted a name of its own"},
      {model("<asset>@<mesh/></asset>"), "<asset>: <mesh>: attribute 'name' is missing"},
      {field("size='@1 1 0 1' nrow='2' ncol='2'"),
       "<asset>: <hfield>: attribute 'size': found '1 1 0 1', wanted 4 lengths > 0"},
      {model("<asset>@<hfield name='h' size='1 1 1 1' nrow='1' ncol='2'/></asset>"),
       "<asset>: <hfield>: size of the grid: found 1 x 2, wanted at least 2 x 2 and at most 262144 heights"},
      {field("size='1 1 1 1' nrow='2' ncol='2' elevation='@1 2 3'"),
       "<asset>: <hfield>: attribute 'elevation': found '1 2 3', wanted 4 numbers"},
      {model("<asset>" + fields + "@<hfield/></asset>"), "<asset>: <hfield>: too many: wanted at most 16"},
      {model("<asset><mesh file='a.stl' scale='@1 0 1'/></asset>"),
       "<asset>: <mesh>: attribute 'scale': found '1 0 1', wanted 3 numbers that are not 0"},
      {model("<asset><mesh file='a.stl' inertia='@exakt'/></asset>"),
       "<asset>: <mesh>: attribute 'inertia': found 'exakt', wanted convex, exact, legacy or shell (did you "
       "mean "
       "'exact'?)"},
      {model("<asset><material name='m'/><material name='@m'/></asset>"),
       "<asset>: <material>: a second material of this name: found 'm', wanted a name of its own"},
  });
}

TEST(MjcfMessages, OfJoints) {
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "<joint/>";
  check({
      {body("<joint name='j'/>\n<joint name='@j'/>"),
       "joint 'j': a second joint of this name: wanted a name of its own: the first is at f:3:1"},
      {body("<joint type='@revolute'/>"),
       "body 'a': <joint>: attribute 'type': found 'revolute', wanted hinge, slide, ball or free"},
      {body("<joint axis='@0 0 0'/>"),
       "body 'a': <joint>: attribute 'axis': found '0 0 0', wanted a direction"},
      {body("@<joint limited='true'/>"), "body 'a': <joint>: attribute 'range' is missing"},
      {body("<joint damping='@-1'/>"),
       "body 'a': <joint>: attribute 'damping': found -1, wanted a number >= 0"},
      {body("<joint armature='@-1'/>"),
       "body 'a': <joint>: attribute 'armature': found -1, wanted a number >= 0"},
      {body("<joint stiffness='@-1'/>"),
       "body 'a': <joint>: attribute 'stiffness': found -1, wanted a number >= 0"},
      {body("<joint springdamper='@1'/>"),
       "body 'a': <joint>: attribute 'springdamper': found '1', wanted 2 numbers"},
      {body("@<freejoint/><joint/>"), "body 'a': a free joint: found 2 joints, wanted no other joint"},
      {body("<body name='b'>@<freejoint/></body>"),
       "body 'b': a free joint: found a body on 'a', wanted a body on the world"},
      {body(many + "@<joint/>"),
       "body 'a': too many joints: wanted at most 1000, including those of bodies that do not move"},
  });
  const std::string turned = body("<joint range='@2 1'/>");
  check({{turned,
          "body 'a': <joint>: attribute 'range': found '2 1', wanted a lower limit that is not above the "
          "upper"}},
        {.strict = true});
  checkNotes({
      {turned,
       "warning: body 'a': <joint>: attribute 'range': found '2 1', wanted a lower limit that is not above "
       "the upper; "
       "the joint has no range"},
      {body("@<joint type='ball' range='0 1'/>"),
       "warning: the range of a <joint> of type 'ball' is ignored: motion will differ"},
      {body("@<joint range='0 1'/>").insert(9, "<compiler autolimits='false'/>"),
       "note: range of <joint> has no effect: autolimits is off, and limited is not given"},
      {body("@<joint name='j' type='slide' range='1 2'/><joint type='slide' range='3 4'/>"),
       "warning: joint 'j' starts outside its range, 1 to 2, and so does another joint"},
      {body("<joint @margin='2' armature='1' stiffness='2' springref='3'/><joint margin='1'/>"),
       "warning: <joint>: motion will differ: attributes that are not read: margin (2 times)"},
      {body("<joint springdamper='0 1'/>@<joint name='j' springdamper='1 1'/><joint springdamper='2 1'/>"),
       "warning: joint 'j': springdamper: found joints that move no mass, wanted masses, which say how "
       "strong springs are; it is left out; motion will differ"},
      {"<mujoco><worldbody>@<body name='a'><freejoint align='true'/><geom size='1'/></body></worldbody>"
       "<equality><connect body1='a' anchor='0 0 0'/></equality></mujoco>",
       "warning: body 'a': align: found a <connect> or <weld> of the body, wanted none, for its points would "
       "move; the body keeps its frame; motion will differ"},
  });
}

TEST(MjcfMessages, OfActuators) {
  check({
      {jointed("<actuator><motor joint='@bal'/></actuator>"),
       "<actuator>: <motor>: unknown joint: found 'bal', wanted the name of a joint (did you mean 'ball'?)"},
  });
  checkNotes({
      {jointed("<actuator><motor tendon='t'/>@<motor joint='ball'/><motor site='s'/></actuator>"),
       "warning: an actuator of a joint of type 'ball' or 'free' is ignored: motion will differ\nf:3:11: "
       "warning: an actuator of a spatial tendon is ignored: motion will differ\nf:3:51: warning: an "
       "actuator "
       "of something other than a joint is ignored: motion will differ"},
      {jointed("<actuator>@<muscle joint='j'/></actuator>"),
       "warning: <muscle> is ignored: motion will differ"},
  });
}

TEST(MjcfMessages, OfEqualities) {
  check({
      {equal("<joint joint1='@elbow' joint2='j'/>"),
       "<equality>: <joint>: unknown joint: found 'elbow', wanted the name of a joint"},
      {equal("<joint joint1='j' joint2='@ball'/>"),
       "<equality>: <joint>: a joint that follows another: found 'ball' of type 'ball', wanted two joints of "
       "type hinge or slide"},
      {equal("<joint joint1='j' joint2='@j'/>"),
       "<equality>: <joint>: a joint that follows itself: wanted another joint"},
      {equal("<joint joint1='j' active='@no'/>"),
       "<equality>: <joint>: attribute 'active': found 'no', wanted false or true"},
      {equal("<connect body1='@A' anchor='0 0 0'/>"),
       "<equality>: <connect>: unknown body: found 'A', wanted the name of a body (did you mean 'a', "
       "'b' or 'c'?)"},
      {equal("<connect body1='@a' body2='a' anchor='0 0 0'/>"),
       "<equality>: <connect>: one body: found 'a', wanted two bodies"},
      {equal("<connect body1='a' anchor='@0 0'/>"),
       "<equality>: <connect>: attribute 'anchor': found '0 0', wanted 3 numbers"},
      {equal("@<connect body1='a'/>"), "<equality>: <connect>: attribute 'anchor' is missing"},
      {equal(connects(1000) + "@<connect body1='a' anchor='0 0 0'/>"),
       "<equality>: <connect>: too many <connect> and <weld>: wanted at most 1000; a <weld> counts as "
       "3"},
  });
  checkNotes({
      {equal("@<joint joint1='j'/>"),
       "warning: a <joint> in <equality> that holds a joint in place is ignored: motion will differ"},
      {equal("@<joint joint1='j' joint2='k' polycoef='0 1 .5'/>"),
       "warning: a <joint> in <equality> with a polynomial of higher degree is ignored: motion will differ"},
      {equal("<joint joint1='j' joint2='k'/><joint joint1='@j' joint2='k'/>"),
       "warning: <equality>: <joint>: 'j' already follows another joint; this is ignored; motion will "
       "differ"},
      {equal("@<joint joint1='j' joint2='k'/>\n<joint joint1='k' joint2='j'/>"),
       "warning: <equality>: <joint>: joints that follow each other in a loop; this is ignored; motion will "
       "differ\nf:4:1: "
       "warning: "
       "<equality>: <joint>: joints that follow each other in a loop; this is ignored; motion will differ"},
      {equal("<weld body1='a' active='false'/><weld body1='a' site1='a'/>@<connect site1='a' site2='b'/>"),
       "warning: a <connect> of sites is ignored: motion will differ\nf:3:43: warning: a <weld> of sites is "
       "ignored: motion will differ"},
      {equal("@<tendon tendon1='t'/>"),
       "warning: a <tendon> in <equality>, except with <fixed> ones that couple two joints linearly, is "
       "ignored: motion will differ"},
  });
}

TEST(MjcfMessages, OfContacts) {
  const auto contact = [](const std::string& inside) { return jointed("<contact>" + inside + "</contact>"); };
  check({
      {contact("<exclude body1='a' body2='@hand'/>"),
       "<contact>: <exclude>: unknown body: found 'hand', wanted the name of a body"},
      {contact("<exclude body1='a' body2='@a'/>"),
       "<contact>: <exclude>: one body: found 'a', wanted two bodies"},
      {contact("<pair geom1='@x' geom2='y'/>"),
       "<contact>: <pair>: unknown geom: found 'x', wanted the name of a <geom>"},
      {contact("@<pair geom2='x'/>"), "<contact>: <pair>: attribute 'geom1' is missing"},
  });
  checkNotes({
      {world(
           "<body name='a'><geom size='1' contype='2'/><geom size='1' contype='0' conaffinity='0'/></body>\n"
           "@<body name='b'><geom size='1' contype='0' conaffinity='0'/></body>"),
       "warning: nothing can touch 'b': no geom of theirs has a bit of contype or conaffinity to share"},
  });
}

TEST(MjcfMessages, OfWhatIsNotRead) {
  checkNotes({
      {model("<option timestep='.01' gravity='@0 0 0' density='0'/>"),
       "warning: <option>: rex always computes with a gravity of 9.81 m/s^2 along -z; motion will differ"},
      {model("<option density='1.2' viscosity='0' @impratio='10'/>"),
       "warning: <option>: contact will differ: attributes that are not read: impratio\nf:2:9: warning: "
       "<option>: motion will differ: attributes that are not read: density"},
      {model("<option><flag @gravity='disable' filterparent='enable' energy='enable'/></option>"),
       "warning: <flag>: motion will differ: attributes that are not read: gravity"},
      {model("@<visual/><sensor/><visual/>"), "note: <visual> is ignored: the picture will differ (2 times)"},
      {"\n @<?xml version='1.0'?><mujoco/>",
       "warning: not well-formed XML: blanks before the declaration; they are skipped"},
  });
}

// Bodies do not vanish, nor what a later version of MuJoCo may know.
TEST(MjcfMessages, OfWhatCannotBeLeftOut) {
  const std::string wanted =
      " is not read: wanted its bodies as <body>, as MuJoCo writes them when it saves a model";
  check({
      {body("@<composite/>"), "body 'a': <composite>" + wanted},
      {world("<frame>@<flexcomp/></frame>"), "<worldbody>: <frame>: <flexcomp>" + wanted},
      {world("@<attach/>"), "<worldbody>: <attach>: attribute 'model' is missing"},
      {model("<asset><model file='hand.xml'/></asset><worldbody><attach model='@hind'/></worldbody>"),
       "<worldbody>: <attach>: unknown model: found 'hind', wanted the name of a <model> (did you mean "
       "'hand'?)"},
      {model("<asset><model name='h' file='@hand.xml'/></asset><worldbody><attach model='h' "
             "prefix=''/></worldbody>"),
       "<asset>: <model>: attribute 'file': found a scene that was given as text, wanted no <model>: only "
       "models in files attach others"},
      {model("@<actuators/>"),
       "<mujoco>: unknown tag <actuators>: wanted one of MuJoCo's (did you mean 'actuator'?)"},
      {body("<replicate count='@0'/>"),
       "body 'a': <replicate>: attribute 'count': found '0', wanted a whole number > 0"},
      {body("@<replicate count='10001'/>"), "body 'a': <replicate>: too many replicas: wanted at most 10000"},
  });
}

TEST(MjcfMessages, OfMeshesInTags) {
  const auto mesh = [](const std::string& attributes) {
    return model("<asset><mesh name='m' " + attributes + "/></asset>");
  };
  check({
      {mesh("vertex='@0 0 0 1 0 0 0 1 0'"),
       "<asset>: <mesh>: attribute 'vertex': found '0 0 0 1 0 0 0 1 0', wanted 12 to 3000000 numbers"},
      {mesh("vertex='@0 0 0 1 0 0 0 1 0 0 0 1 1'"),
       "<asset>: <mesh>: attribute 'vertex': found 13 numbers, wanted three for each vertex or face"},
      {mesh("vertex='0 0 0 1 0 0 0 1 0 0 0 1' face='@0 1 4'"),
       "<asset>: <mesh>: attribute 'face': found a corner 4, wanted whole numbers from 0 to 3, one below the "
       "number of vertices"},
      {mesh("vertex='0 0 0 1 0 0 2 0 0 0 0 1' face='@0 1 2'"),
       "<asset>: <mesh>: attribute 'face': found triangles without an area, wanted a surface"},
      {mesh("builtin='@plate'"),
       "<asset>: <mesh>: attribute 'builtin': found 'plate', wanted sphere, or a mesh in a file"},
      {mesh("builtin='sphere' params='@5'"),
       "<asset>: <mesh>: attribute 'params': found '5', wanted a whole number from 0 to 4"},
      {mesh("file='a.stl' refquat='@0 0 0 0'"),
       "<asset>: <mesh>: attribute 'refquat': found '0 0 0 0', wanted a quaternion w x y z"},
      {mesh("file='a.stl' refquat='@1 .5 0 0' scale='1 1 2'"),
       "<asset>: <mesh>: attribute 'refquat': found a 'scale' that differs along the turned axes, wanted one "
       "factor for all axes"},
  });
}

TEST(MjcfMessages, OfFreeBases) {
  try {
    static_cast<void>(parseMjcf("<mujoco/>", "f", {.freeBase = true}));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "f: a free base: found a model of MuJoCo, wanted a <freejoint/> in its first body instead");
  }
}

TEST(MjcfMessages, KeepNotesOfFailures) {
  Diagnostics notes;
  EXPECT_THROW(static_cast<void>(parseMjcf("<mujoco><visual/><worldbody><geom/></worldbody></mujoco>", "f",
                                           {.notesOfFailure = &notes})),
               Error);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(toString(notes[0]), "f:1:9: note: <visual> is ignored: the picture will differ");
}

}  // namespace rex::mjcf_messages_test
