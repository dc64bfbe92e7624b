// What is made of URDF files with faults that other readers live with: each fault alone, in pairs, and in
// published files.
#include <algorithm>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "formats/ors_writer.h"
#include "formats/urdf_reader.h"
#include "formats/urdf_writer.h"
#include "geometry/rotation.h"
#include "scene/model.h"
#include "support/file_text.h"
#include "support/nearest_inertia.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::urdf_repair_test {

// The places of a robot where faults are put.
enum Slot { kHead, kMesh, kPaint, kMass, kMoments, kRange, kMimic, kFollower, kChain, kSlots };

struct Fault {
  Slot slot;
  std::string text;     // '@' marks what the warning is about, '#' the first of two
  std::string warning;  // without the place; {} or {0} is the folder, {1} the place of '#'
};

std::string follower(const std::string& mark, const std::string& lower, const std::string& upper) {
  return mark +
         "<joint name='follow' type='revolute'><parent link='base'/><child link='hand'/><limit lower='" +
         lower + "' upper='" + upper +
         "' velocity='1' effort='1'/><mimic joint='turn' multiplier='-1'/></joint>";
}

std::string range(const std::string& bounds) { return "<limit " + bounds + " velocity='1' effort='1'/>"; }

const std::string kSound[kSlots] = {"",
                                    "<box size='1 1 1'/>",
                                    "",
                                    "2",
                                    "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>",
                                    range("lower='0' upper='1'"),
                                    "",
                                    follower("", "-1", "0"),
                                    ""};

std::vector<Fault> allFaults() {
  const std::string blanks = "not well-formed XML: blanks before the declaration; they are skipped";
  const std::string massless =
      "link 'arm': <mass>: an inertia without mass: found 0, wanted a mass > 0 kg; the inertia is kept";
  const std::string negative =
      "link 'arm': <inertia>: a negative principal moment: wanted principal moments >= 0; ";
  const std::string reversed = ", wanted a lower limit that is not above the upper; the joint has no range";
  const std::string fixed =
      "joint 'end': <mimic>: found a joint of type 'fixed', wanted revolute, continuous or prismatic; it is "
      "ignored";
  const std::string nameless =
      ", wanted package://PACKAGE/PATH; the path is looked up in the folders above "
      "the file";
  const std::string stuck = ", wanted limits that both joints can satisfy; those of 'follow' are left out";
  const std::string first = "wanted one: the first is at {1}; it is ignored";
  const std::string tiny = "; 0 counts as 1e-06";
  return {
      {kHead, "\n@", blanks},
      {kHead, " \t \r\n@", blanks},
      {kHead, "\n\n \xef\xbb\xbf@", blanks},
      {kHead, "\xef\xbb\xbf\n@", blanks},
      {kMesh, "<mesh filename='@package:///meshes/red.obj'/>",
       "link 'base': <mesh>: attribute 'filename': found 'package:///meshes/red.obj'" + nameless},
      {kMesh, "<mesh filename='@package:///robot/meshes/red.obj'/>",
       "link 'base': <mesh>: attribute 'filename': found 'package:///robot/meshes/red.obj'" + nameless},
      {kMesh, "<mesh filename='@meshes/clear.obj'/>",
       "shape 'base': mesh '{}/robot/meshes/clear.obj': a material: found full transparency, wanted one that "
       "can be seen; it is drawn opaque"},
      {kMesh, "<box size='1 1 1'/>@<sphere radius='1'/>",
       "link 'base': <geometry>: two shapes: found <box> and <sphere>, wanted one; the first is used"},
      {kMesh, "<sphere radius='@0'/>",
       "link 'base': <sphere>: attribute 'radius': found '0', wanted a number > 0" + tiny},
      {kMesh, "<cylinder radius='@0' length='1'/>",
       "link 'base': <cylinder>: attribute 'radius': found '0', wanted a number > 0" + tiny},
      {kMesh, "<capsule radius='1' length='@0.0'/>",
       "link 'base': <capsule>: attribute 'length': found '0.0', wanted a number > 0" + tiny},
      {kMesh, "<box size='@1 0 0'/>",
       "link 'base': <box>: attribute 'size': found '1 0 0', wanted 3 numbers > 0" + tiny},
      {kMesh, "<mesh filename='meshes/red.obj' scale='@1 1 1 1'/>",
       "link 'base': <mesh>: attribute 'scale': found '1 1 1 1', wanted 3 numbers; the first three are used"},
      {kMesh, "<mesh filename='meshes/red.obj' scale='@.01'/>",
       "link 'base': <mesh>: attribute 'scale': found '.01', wanted 3 numbers; it scales all three axes"},
      {kMesh, "<mesh filename='meshes/red.obj' scale='@1 1 0'/>",
       "link 'base': <mesh>: attribute 'scale': found '1 1 0', wanted 3 numbers that are not 0" + tiny},
      {kMesh, "@<cdf filename='a.cdf'/>",
       "link 'base': <geometry>: a shape of an unknown kind: found <cdf>, wanted <box>, <cylinder>, "
       "<sphere>, "
       "<capsule>, <mesh> or <plane>; this <visual> is left out"},
      {kPaint, "#<material name='m'><color rgba='1 0 0 1'/></material>@<material name='n'/>",
       "link 'base': <visual>: a second <material>: " + first},
      {kMass, "@0", massless},
      {kMass, "@0e3", massless},
      {kMoments, "@<inertia ixx='0' iyy='0' izz='0' ixy='0' ixz='2.4e-35' iyz='0'/>",
       negative + "-2.4e-35 kg m^2 is within rounding error and counts as 0"},
      {kMoments, "@<inertia ixx='-5e-20' iyy='-6e-20' izz='0' ixy='0' ixz='0' iyz='0'/>",
       negative + "-6e-20 and -5e-20 kg m^2 are within rounding error and count as 0"},
      {kMoments, "@<inertia ixx='1' iyy='1' izz='1' ixy='2' ixz='0' iyz='0'/>",
       negative + "-1 kg m^2 is physically impossible and counts as 0"},
      {kMoments, "@<inertia ixx='-3' iyy='-.5' izz='2' ixy='0' ixz='0' iyz='0'/>",
       negative + "-3 and -0.5 kg m^2 are physically impossible and count as 0"},
      {kMoments, "@<inertia ixx='1' iyy='1' izz='1' ixz='0' iyz='0'/>",
       "link 'arm': <inertia>: attribute 'ixy' is missing and counts as 0"},
      {kMoments, "@<inertia ixx='1' iyy='1' izz='1'/>",
       "link 'arm': <inertia>: attributes 'ixy', 'ixz', 'iyz' are missing and count as 0"},
      {kRange, range("lower='@1' upper='-1'"),
       "joint 'turn': <limit>: attribute 'lower': found 1 > -1" + reversed},
      {kRange, "@" + range("upper='-.5'"),
       "joint 'turn': <limit>: attribute 'lower': found 0 > -0.5" + reversed},
      {kRange, range("lower='0' upper='1'") + "#<axis xyz='1 0 0'/>@<axis xyz='0 1 0'/>",
       "joint 'turn': a second <axis>: " + first},
      {kChain, "<mimic joint='@follow' multiplier='2' offset='1'/>",
       "joint 'chain': mimic: found 'follow', which mimics 'turn', wanted a joint that mimics no other; it "
       "follows 'turn' with multiplier -2 and offset 1"},
      {kMimic, "@<mimic joint='turn'/>", fixed},
      {kMimic, "@<mimic joint='nowhere' multiplier='-1'/>", fixed},
      {kFollower, follower("@", "0", "1"),
       "joint 'follow': limits: found joint 'turn' may only be at 0" + stuck},
      {kFollower, follower("@", "-3", "-2"),
       "joint 'follow': limits: found joint 'turn' has no position left: 2 > 1" + stuck},
  };
}

// Takes the mark out of the text and returns its place.
SourceLocation takeMark(std::string& text, char mark, const std::string& file) {
  const std::size_t at = text.find(mark);
  text.erase(at, 1);
  std::string before = text.substr(0, at);
  if (before.starts_with("\xef\xbb\xbf")) before.erase(0, 3);  // which is not a part of the text
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  return {file, static_cast<int>(line), static_cast<int>(before.size() - (before.rfind('\n') + 1)) + 1};
}

class UrdfRepair : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_.path() / "robot/meshes");
    const std::filesystem::path meshes = folder_.path() / "robot/meshes";
    std::ofstream(meshes / "all.mtl") << "newmtl red\nKd 1 0 0\nnewmtl clear\nKd 1 0 0\nTr 1\n";
    for (const std::string name : {"red", "clear"})
      std::ofstream(meshes / (name + ".obj"))
          << "mtllib all.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl " + name + "\nf 1 2 3\n";
  }

  static std::string chain(const std::string& mimic) {
    return mimic.empty()
               ? ""
               : "\n<link name='finger'/><joint name='chain' type='continuous'><parent link='hand'/>"
                 "<child link='finger'/>" +
                     mimic + "</joint>";
  }

  // The robot with these faults, the marks replaced by bytes 1, 2, ...
  static std::string robotWith(const std::vector<Fault>& faults) {
    std::string slots[kSlots];
    std::copy(std::begin(kSound), std::end(kSound), slots);
    for (std::size_t i = 0; i < faults.size(); ++i) {
      std::string& slot = slots[faults[i].slot] = faults[i].text;
      slot[slot.find('@')] = static_cast<char>(1 + i);
      if (const std::size_t at = slot.find('#'); at != slot.npos) slot[at] = static_cast<char>(0x1e + i);
    }
    return slots[kHead] + "<?xml version='1.0'?>\n<robot name='r'>\n<link name='base'><visual><geometry>" +
           slots[kMesh] + "</geometry>" + slots[kPaint] +
           "</visual></link>\n<link name='arm'><inertial><mass value='" + slots[kMass] + "'/>" +
           slots[kMoments] +
           "</inertial></link>\n<link name='hand'/><link name='tip'/>\n"
           "<joint name='turn' type='revolute'><parent link='base'/><child link='arm'/>" +
           slots[kRange] + "</joint>\n" + slots[kFollower] + chain(slots[kChain]) +
           "\n<joint name='end' type='fixed'><parent link='arm'/><child link='tip'/>" + slots[kMimic] +
           "</joint>\n</robot>\n";
  }

  // Expects the warnings of these faults and no others, and that a strict reading throws.
  void expectRepairs(const std::vector<Fault>& faults) {
    std::string text = robotWith(faults);
    std::vector<std::string> wanted, found;
    for (std::size_t i = 0; i < faults.size(); ++i) {
      const char firstMark = static_cast<char>(0x1e + i);
      const std::string first =
          text.find(firstMark) == text.npos ? "" : toString(takeMark(text, firstMark, file_.string()));
      const SourceLocation where = takeMark(text, static_cast<char>(1 + i), file_.string());
      if (isSeenBeside(faults[i], faults))
        wanted.push_back(toString(where) + ": warning: " +
                         fmt::format(fmt::runtime(faults[i].warning), folder_.path().string(), first));
    }
    std::ofstream(file_, std::ios::binary) << text;
    const SceneFile read = readUrdf(file_);
    for (const Diagnostic& note : read.notes) found.push_back(toString(note));
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(wanted)) << text;
    EXPECT_EQ(compile(read.spec).nq(), 1) << text;
    EXPECT_THROW(static_cast<void>(readUrdf(file_, {.strict = true})), Error) << text;
  }

  // Limits narrow no range that is left out, and nobody paints a shape that is.
  static bool isSeenBeside(const Fault& fault, const std::vector<Fault>& others) {
    return std::none_of(others.begin(), others.end(), [&](const Fault& other) {
      return (fault.slot == kFollower && other.warning.ends_with("the joint has no range")) ||
             (fault.slot == kPaint && other.warning.ends_with("is left out"));
    });
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "robot/robot.urdf";
};

TEST_F(UrdfRepair, WarnsOfEachFaultOnce) {
  for (const bool strict : {false, true})
    EXPECT_TRUE(parseUrdf(robotWith({}), "f", {.strict = strict}).notes.empty());
  for (const Fault& fault : allFaults()) expectRepairs({fault});
}

TEST_F(UrdfRepair, WarnsOfTwoFaultsTwice) {
  const std::vector<Fault> faults = allFaults();
  int files = 0;
  for (std::size_t i = 0; i < faults.size(); ++i)
    for (std::size_t k = i + 1; k < faults.size(); ++k)
      if (faults[i].slot != faults[k].slot) {
        expectRepairs({faults[i], faults[k]});
        ++files;
      }
  EXPECT_GE(files, 170);
}

// As in urdfdom, which does not look for the other joint.
TEST_F(UrdfRepair, LeavesOutMimicsOfMissingJoints) {
  std::string text = robotWith({{kFollower, follower("@", "-1", ".5"), ""}});
  const SourceLocation joint = takeMark(text, 1, "f");
  text.replace(text.find("mimic joint='turn'"), 18, "mimic joint='trun'");
  const SceneFile scene = parseUrdf(text, "f");
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_EQ(scene.notes[0].where.line, joint.line);
  EXPECT_EQ(scene.notes[0].message,
            "joint 'follow': mimic: found 'trun', wanted the name of a joint (did you mean 'turn'?); it is "
            "ignored: "
            "the joint moves by itself");
  const Model model = compile(scene.spec);
  ASSERT_EQ(model.nq(), 2);
  EXPECT_EQ(model.lowerLimits()[1], -1);
  EXPECT_EQ(model.upperLimits()[1], .5);
}

SceneSpec parsed(const std::string& inside) {
  return parseUrdf("<robot name='r'>" + inside + "</robot>", "f").spec;
}

BodySpec link(const std::string& mass, const std::string& moments) {
  return parsed("<link name='a'><inertial><origin xyz='1 2 3' rpy='.1 .2 .3'/><mass value='" + mass +
                "'/><inertia " + moments + "/></inertial></link>")
      .bodies.at(0);
}

// Of an arm and a hand without mass, as of the Panda's link 8: as in KDL, what turns has the inertia of both.
TEST(UrdfRepairs, KeepAnInertiaWithoutMass) {
  const auto moments = [](const std::string& mass, const std::string& xx) {
    return "<inertial><mass value='" + mass + "'/><inertia ixx='" + xx +
           "' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
  };
  const SceneSpec spec =
      parsed("<link name='base'/><link name='arm'>" + moments("2", "1") + "</link><link name='hand'>" +
             moments("0", ".5") + "</link><joint name='j' type='continuous'><parent link='base'/>" +
             "<child link='arm'/></joint><joint name='k' type='fixed'><origin xyz='3 4 5'/>" +
             "<parent link='arm'/><child link='hand'/></joint>");
  EXPECT_EQ(spec.bodies[2].mass, 0);
  ASSERT_TRUE(spec.bodies[2].inertia);
  const Model model = compile(spec);
  ASSERT_EQ(model.links().size(), 1u);
  EXPECT_EQ(model.links()[0].mass, 2);
  EXPECT_DOUBLE_EQ(model.links()[0].inertia[5], 1.5);
  const std::string written = writeUrdf(spec).text;
  EXPECT_EQ(*parseUrdf(written, "f").spec.bodies[2].inertia, *spec.bodies[2].inertia) << written;
  const std::string ors = writeOrs(spec);
  EXPECT_EQ(*parseOrs(ors, "f").spec.bodies[2].inertia, *spec.bodies[2].inertia) << ors;
}

// The colour and the axis that urdfdom takes, of two each.
TEST(UrdfRepairs, TakeTheFirstOfTwo) {
  const std::string red = "<material name='m'><color rgba='1 0 0 1'/></material>";
  const SceneSpec spec =
      parsed("<link name='a'><visual><geometry><sphere radius='1'/></geometry>" + red +
             "<material name='n'><color rgba='0 0 1 1'/></material></visual></link><link name='b'/>"
             "<joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>"
             "<axis xyz='0 1 0'/></joint>");
  EXPECT_EQ(spec.bodies[0].shapes[0].color, Eigen::Vector4d(1, 0, 0, 1));
  EXPECT_EQ(spec.joints[0].axis, Eigen::Vector3d::UnitZ());
}

// l = 3 (2 j + 1) - 1, and m, which comes before them, is -l.
TEST(UrdfRepairs, MultiplyOutChainsOfMimics) {
  const auto joint = [](const std::string& name, const std::string& mimic) {
    return "<link name='" + name + "'/><joint name='" + name +
           "' type='continuous'><parent link='base'/><child link='" + name + "'/>" + mimic + "</joint>";
  };
  const SceneSpec spec = parsed("<link name='base'/>" + joint("m", "<mimic joint='l' multiplier='-1'/>") +
                                joint("l", "<mimic joint='k' multiplier='3' offset='-1'/>") +
                                joint("k", "<mimic joint='j' multiplier='2' offset='1'/>") + joint("j", ""));
  const auto follows = [&](int j, double ratio, double offset) {
    const JointSpec& one = spec.joints[static_cast<std::size_t>(j)];
    return one.mimic == "j" && one.mimicRatio == ratio && one.mimicOffset == offset;
  };
  EXPECT_TRUE(follows(0, -6, -2));
  EXPECT_TRUE(follows(1, 6, 2));
  EXPECT_TRUE(follows(2, 2, 1));
}

TEST(UrdfRepairs, TakeTheNearestInertia) {
  const BodySpec plain = link("1", "ixx='-.1' iyy='2' izz='3' ixy='1' ixz='.2' iyz='-.3'");
  const Eigen::Matrix3d I = (Eigen::Matrix3d() << -.1, 1, .2, 1, 2, -.3, .2, -.3, 3).finished();
  const Eigen::Matrix3d R = rotationFromRollPitchYaw({.1, .2, .3});
  EXPECT_TRUE(isNearestInertia(R.transpose() * *plain.inertia * R, I));
  const BodySpec missing = link("1", "ixx='1' izz='3' ixy='.1'");
  const Eigen::Matrix3d filled = (Eigen::Matrix3d() << 1, .1, 0, .1, 0, 0, 0, 0, 3).finished();
  EXPECT_TRUE(isNearestInertia(R.transpose() * *missing.inertia * R, filled));
}

// What is negative within the millionth that all of rex forgives is repaired and told, strict or not.
TEST(UrdfRepairs, TellOfRoundingThatIsNeverRefused) {
  const std::string text =
      "<robot name='r'><link name='a'><inertial><mass value='1'/>"
      "<inertia ixx='-1e-9' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link></robot>";
  for (const bool strict : {false, true}) {
    const SceneFile file = parseUrdf(text, "f", {.strict = strict});
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(toString(file.notes[0]),
              "f:1:59: warning: link 'a': <inertia>: a negative principal moment; -1e-09 kg m^2 is within "
              "rounding error and counts as 0");
    EXPECT_EQ((*file.spec.bodies[0].inertia)(0, 0), 0);
  }
}

TEST(UrdfRepairs, LeaveOutARangeThatIsReversed) {
  const JointSpec joint =
      parsed(
          "<link name='a'/><link name='b'/><joint name='j' type='prismatic'><parent link='a'/>"
          "<child link='b'/><limit lower='2' upper='1' velocity='3' effort='4'/></joint>")
          .joints.at(0);
  EXPECT_EQ(joint.lower.size() + joint.upper.size(), 0);
  EXPECT_EQ(joint.maxVelocity, 3);
  EXPECT_EQ(joint.maxEffort, 4);
}

// A gripper of two fingers, 0 to .548 m each, of which one mimics the other backwards, and a tip.
TEST(UrdfRepairs, KeepAGripperMovable) {
  const auto finger = [](const std::string& name, const std::string& limits, const std::string& mimic) {
    return "<link name='" + name + "'/><joint name='" + name +
           "' type='prismatic'><parent link='palm'/><child link='" + name + "'/><limit " + limits +
           " velocity='1' effort='1'/>" + (mimic.empty() ? "" : "<mimic joint='left' " + mimic + "/>") +
           "</joint>";
  };
  const std::string left = "<link name='palm'/>" + finger("left", "lower='0' upper='.548'", "");
  const auto limitsWith = [&](const std::string& others) {
    const Model model = compile(parsed(others + left));
    return std::pair(model.lowerLimits()[0], model.upperLimits()[0]);
  };
  const std::pair own(0.0, .548), narrowed(0.0, .5);
  EXPECT_EQ(limitsWith(finger("right", "lower='0' upper='.548'", "multiplier='-1'")), own);
  EXPECT_EQ(limitsWith(finger("right", "lower='0' upper='0'", "multiplier='2'")), own);
  EXPECT_EQ(limitsWith(finger("right", "lower='0' upper='1e-8'", "multiplier='-1'")), own);
  EXPECT_EQ(limitsWith(finger("right", "lower='0' upper='1'", "multiplier='2'")), narrowed);
  EXPECT_EQ(limitsWith(finger("right", "lower='0' upper='1'", "multiplier='2'") +
                       finger("tip", "lower='0' upper='.548'", "multiplier='-1'")),
            narrowed);
  EXPECT_EQ(limitsWith(finger("right", "lower='1' upper='2'", "multiplier='0'")), own) << "it stands still";
}

// A joint that cannot move of itself narrows nothing, and is not a fault of the one that follows.
TEST(UrdfRepairs, DoNotBlameFollowersOfAJointThatStands) {
  const std::string limit = "<limit lower='0' upper='0' velocity='1' effort='1'/>";
  const SceneFile file = parseUrdf(
      "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><joint name='j' type='revolute'>"
      "<parent link='a'/><child link='b'/>" +
          limit + "</joint><joint name='k' type='revolute'><parent link='b'/><child link='c'/>" + limit +
          "<mimic joint='j'/></joint></robot>",
      "f");
  EXPECT_TRUE(file.notes.empty());
}

// The warnings of what is repaired: they say what is done.
std::vector<std::string> repairsIn(const std::string& text, const std::string& name) {
  std::vector<std::string> repairs;
  for (const Diagnostic& note : parseUrdf(text, name).notes) {
    const bool isRepair = note.message.find("; ") != std::string::npos ||
                          note.message.find("missing and count") != std::string::npos;
    if (isRepair && note.severity == Severity::kWarning) repairs.push_back(toString(note));
  }
  return repairs;
}

// All that is repaired in the sample data.
TEST(UrdfRepairs, OfPublishedFiles) {
  const std::string kReversed =
      "<limit>: attribute 'lower': found 1 > 0, wanted a lower limit that is not above the upper; the joint "
      "has no range";
  const std::string kMassless =
      "<mass>: an inertia without mass: found 0, wanted a mass > 0 kg; the inertia is kept";
  const std::string kNegative = "<inertia>: a negative principal moment: wanted principal moments >= 0; ";
  const std::string kRounding = " kg m^2 is within rounding error and counts as 0";
  const std::string kFixed =
      "<mimic>: found a joint of type 'fixed', wanted revolute, continuous or prismatic; it is ignored";
  const std::map<std::string, std::vector<std::string>> wanted = {
      {"Base_1.urdf", {"Base_1.urdf:61:30: warning: joint 'Base_pulley1': " + kReversed}},
      {"bolt.urdf",
       {"bolt.urdf:201:20: warning: link 'FL_FOOT': " + kMassless,
        "bolt.urdf:386:20: warning: link 'FR_FOOT': " + kMassless}},
      {"cartpole.urdf", {"cartpole.urdf:15:20: warning: link 'slideBar': " + kMassless}},
      {"diff_ring.urdf",
       {"diff_ring.urdf:2:1: warning: not well-formed XML: blanks before the declaration; they are skipped"}},
      {"icub_reduced.urdf",
       {"icub_reduced.urdf:50:13: warning: link 'head': " + kNegative + "-2.40741e-35" + kRounding,
        "icub_reduced.urdf:103:13: warning: link 'l_ankle_2': " + kNegative + "-1.35525e-20" + kRounding,
        "icub_reduced.urdf:479:13: warning: link 'r_ankle_2': " + kNegative + "-1.35525e-20" + kRounding,
        "icub_reduced.urdf:613:13: warning: link 'r_hip_2': " + kNegative +
            "-5.42101e-20 and -5.42101e-20 kg m^2 are within rounding error and count as 0",
        "icub_reduced.urdf:643:13: warning: link 'r_lower_leg': " + kNegative + "-6.11488e-21" + kRounding,
        "icub_reduced.urdf:756:13: warning: link 'r_upper_leg': " + kNegative + "-1.80242e-22" + kRounding}},
      {"kuka_iiwa.urdf", {"kuka_iiwa.urdf:67:20: warning: link 'lbr_iiwa_link_0': " + kMassless}},
      {"panda_spherized.urdf",
       {"panda_spherized.urdf:336:17: warning: link 'panda_link8': " + kMassless,
        "panda_spherized.urdf:529:17: warning: link 'panda_grasptarget': " + kMassless,
        "panda_spherized.urdf:611:3: warning: joint 'panda_finger_joint2': " + kFixed}},
      {"plate.urdf",
       {"plate.urdf:64:7: warning: link 'cube': <inertia>: attributes 'ixy', 'ixz', 'iyz' are missing and "
        "count as 0"}},
      {"talos_left_arm.urdf",
       {"talos_left_arm.urdf:539:5: warning: joint 'gripper_left_inner_double_joint': " + kFixed,
        "talos_left_arm.urdf:567:5: warning: joint 'gripper_left_fingertip_1_joint': " + kFixed,
        "talos_left_arm.urdf:595:5: warning: joint 'gripper_left_fingertip_2_joint': " + kFixed,
        "talos_left_arm.urdf:623:5: warning: joint 'gripper_left_motor_single_joint': " + kFixed,
        "talos_left_arm.urdf:651:5: warning: joint 'gripper_left_inner_single_joint': " + kFixed,
        "talos_left_arm.urdf:679:5: warning: joint 'gripper_left_fingertip_3_joint': " + kFixed}},
      {"tiago.urdf",
       {"tiago.urdf:179:7: warning: link 'base_antenna_left_link': " + kNegative +
            "-3.53486e-08 kg m^2 is physically impossible and counts as 0",
        "tiago.urdf:208:7: warning: link 'base_antenna_right_link': " + kNegative +
            "-3.53486e-08 kg m^2 is physically impossible and counts as 0"}},
  };
  int files = 0;
  for (const auto& [name, warnings] : wanted) {
    const std::filesystem::path file = sharedPath("data/urdf/" + name);
    if (!std::filesystem::exists(file)) continue;
    ++files;
    EXPECT_EQ(repairsIn(fileText(file), name), warnings);
    EXPECT_THROW(static_cast<void>(parseUrdf(fileText(file), name, {.strict = true})), Error) << name;
  }
  if (files == 0) GTEST_SKIP() << "no ../shared/data/urdf";
}

// Fifteen hinges, most of them in a row.
TEST(UrdfRepairs, OfAPendulumOnATendon) {
  const std::string name = "Pendulum_Tendon_1_Cart_Rail.urdf";
  const std::filesystem::path file = sharedPath("data/urdf/" + name);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no ../shared/data/urdf/" << name;
  const std::vector<std::string> warnings = repairsIn(fileText(file), name);
  ASSERT_EQ(warnings.size(), 15u);
  for (std::size_t i = 2; i < warnings.size(); ++i)
    EXPECT_EQ(
        warnings[i],
        fmt::format("{}:{}:30: warning: joint 'tendon1_{}_tendon1_{}': <limit>: attribute 'lower': found 1 "
                    "> 0, wanted a lower limit that is not above the upper; the joint has no range",
                    name, 144 + 24 * i, i - 1, i));
}

}  // namespace rex::urdf_repair_test
