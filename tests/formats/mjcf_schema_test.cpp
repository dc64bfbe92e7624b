// What becomes of every element and attribute that MuJoCo knows, by its table of names (versions 2.2 to 3.4).
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text.h"
#include "formats/mjcf_reader.h"
#include "formats/mjcf_schema_internal.h"

namespace rex::mjcf_schema_test {

// Attributes and <children> of each element that rex looks into.
const std::string kPose = " pos quat axisangle xyaxes zaxis euler";
const std::string kInBody =
    " <inertial> <joint> <freejoint> <geom> <attach> <site> <camera> <light> <plugin> <composite> <flexcomp> "
    "<body> "
    "<frame> <replicate>";
const std::string kTendon =
    " name class group limited actuatorfrclimited range actuatorfrcrange solreflimit solimplimit "
    "solreffriction "
    "solimpfriction frictionloss springlength margin stiffness damping armature user";
const std::string kEquality = " name class active solref solimp";
const std::map<std::string, std::string> kMujoco = {
    {"mujoco",
     "model <compiler> <option> <size> <statistic> <visual> <default> <extension> <asset> <worldbody> "
     "<deformable> "
     "<contact> <tendon> <equality> <actuator> <sensor> <custom> <keyframe>"},
    {"compiler",
     "autolimits boundmass boundinertia settotalmass balanceinertia strippath coordinate angle fitaabb "
     "eulerseq "
     "meshdir texturedir discardvisual usethread fusestatic inertiafromgeom inertiagrouprange saveinertial "
     "assetdir "
     "alignfree conflict convexhull exactmeshinertia <lengthrange>"},
    {"option",
     "timestep apirate impratio tolerance ls_tolerance noslip_tolerance ccd_tolerance mpr_tolerance "
     "sleep_tolerance "
     "gravity wind magnetic density viscosity o_margin o_solref o_solimp o_friction integrator collision "
     "cone "
     "jacobian solver iterations ls_iterations noslip_iterations ccd_iterations mpr_iterations "
     "sdf_iterations "
     "sdf_initpoints actuatorgroupdisable <flag>"},
    {"flag",
     "constraint equality frictionloss limit contact spring damper passive gravity clampctrl warmstart "
     "filterparent "
     "actuation refsafe sensor midphase eulerdamp autoreset nativeccd island multiccd override energy fwdinv "
     "invdiscrete sensornoise sleep diagexact ipc"},
    {"default",
     "class <default> <mesh> <material> <joint> <geom> <site> <camera> <light> <pair> <equality> <tendon> "
     "<general> "
     "<motor> <position> <velocity> <intvelocity> <orientation> <pid> <damper> <cylinder> <muscle> "
     "<adhesion> "
     "<dcmotor> <plugin>"},
    {"asset", "<mesh> <hfield> <skin> <texture> <material> <model>"},
    {"mesh",
     "name class content_type file vertex normal texcoord face refpos refquat scale smoothnormal maxhullvert "
     "inertia "
     "builtin params material <plugin>"},
    {"hfield", "name content_type file nrow ncol size elevation"},
    {"material",
     "name class texture texrepeat texuniform emission specular shininess reflectance metallic roughness "
     "rgba "
     "<layer>"},
    {"worldbody", kInBody},
    {"body", "name childclass mocap gravcomp sleep simple fuse user" + kPose + kInBody},
    {"frame", "name childclass" + kPose + kInBody},
    {"replicate", "count offset euler sep childclass" + kInBody},
    {"inertial", "mass diaginertia fullinertia" + kPose},
    {"joint",
     "name class type group pos axis springdamper limited actuatorfrclimited solreflimit solimplimit "
     "solreffriction "
     "solimpfriction stiffness range actuatorfrcrange actuatorgravcomp margin ref springref armature damping "
     "frictionloss user"},
    {"freejoint", "name group align"},
    {"geom",
     "name class type contype conaffinity condim group priority size material friction mass density "
     "shellinertia "
     "solmix solref solimp margin gap surfacevel adhesion fromto hfield mesh fitscale rgba fluidshape "
     "fluidcoef user "
     "<plugin>" +
         kPose},
    {"deformable", "<flex> <skin>"},
    {"contact", "<pair> <exclude>"},
    {"pair", "name class geom1 geom2 condim friction solref solreffriction solimp gap margin adhesion"},
    {"exclude", "name body1 body2"},
    {"tendon", "<spatial> <fixed>"},
    {"spatial", kTendon + " width material rgba <site> <geom> <pulley>"},
    {"fixed", kTendon + " <joint>"},
    {"fixed/joint", "joint coef"},
    {"equality", "<connect> <weld> <joint> <tendon> <flex> <flexvert> <flexstrain> <distance> <plugin>"},
    {"connect", kEquality + " body1 body2 anchor site1 site2"},
    {"model", "name file content_type"},
    {"attach", "model body prefix"},
    {"weld", kEquality + " body1 body2 relpose anchor site1 site2 torquescale"},
    {"equality/joint", kEquality + " joint1 joint2 polycoef"},
    {"equality/tendon", kEquality + " tendon1 tendon2 polycoef"},
    {"actuator",
     "<general> <motor> <position> <velocity> <intvelocity> <orientation> <pid> <damper> <cylinder> <muscle> "
     "<adhesion> <dcmotor> <plugin>"},
    {"motor",
     "name class group nsample interp delay ctrlrange user ctrllimited forcelimited actlimited forcerange "
     "actrange "
     "lengthrange gear damping armature cranklength joint jointinparent tendon slidersite cranksite site "
     "refsite body "
     "actdim input velrange ffrange dyntype gaintype biastype dynprm gainprm biasprm actearly inheritrange "
     "kp kv "
     "dampratio timeconst area diameter bias"},
    {"keyframe", "<key>"},
    {"key", "name time qpos qvel act mpos mquat ctrl"},
};

// "read", "silent", what differs, or "refused"; empty if nobody has decided.
std::string classOf(const std::string& element, const std::string& word) {
  const urdf::Known& known = mjcf::knownOf(element);
  const bool isChild = word.starts_with('<');
  const std::string name = isChild ? word.substr(1, word.size() - 2) : word;
  const auto holds = [&](const std::vector<std::string>& names) {
    return std::ranges::count(names, name) > 0;
  };
  std::vector<std::string> all;
  if (holds(isChild ? known.children : known.attributes)) all.emplace_back("read");
  if (isChild && holds(known.refused)) all.emplace_back("refused");
  if (const auto found = known.leftOut.find(word); found != known.leftOut.end())
    all.emplace_back(found->second == Difference::kNone ? "silent" : toString(found->second));
  EXPECT_LE(all.size(), 1u) << element << " " << word << ": " << join(all, ", ");
  return all.empty() ? "" : all[0];
}

TEST(MjcfSchema, DecidesOnEveryNameOfMujoco) {
  std::ostringstream table;
  for (const auto& [element, words] : kMujoco) {
    std::map<std::string, std::vector<std::string>> byClass;
    for (const std::string_view word : splitWords(words)) {
      const std::string decided = classOf(element, std::string(word));
      EXPECT_NE(decided, "") << "<" << element << ">: " << word;
      byClass[decided].emplace_back(word);
    }
    for (const auto& [decided, all] : byClass)
      table << element << " | " << decided << " | " << join(all, " ") << "\n";
  }
  std::ofstream(testing::TempDir() + "mjcf_schema.txt") << table.str();
  RecordProperty("table", table.str());
}

// No name that only we know, so that the table cannot hide what is not MuJoCo's.
TEST(MjcfSchema, HasNoOtherNames) {
  for (const auto& [element, words] : kMujoco) {
    std::set<std::string> theirs;
    for (const std::string_view word : splitWords(words)) theirs.emplace(word);
    theirs.insert({"<include>", "class"});
    const urdf::Known& known = mjcf::knownOf(element);
    std::vector<std::string> ours = known.attributes;
    for (const auto& [word, difference] : known.leftOut) ours.push_back(word);
    for (const std::vector<std::string>* children : {&known.children, &known.refused})
      for (const std::string& child : *children) ours.push_back("<" + child + ">");
    for (const std::string& word : ours) EXPECT_TRUE(theirs.contains(word)) << element << " " << word;
  }
}

// A model in which the element stands, with more text in its tag and in it.
std::string modelWith(const std::string& element, const std::string& attribute, const std::string& inside) {
  const auto tag = [&](const std::string& name, const std::string& own, const std::string& children = "") {
    const bool isHere = name == element;
    const std::string shown = name.substr(name.find('/') == name.npos ? 0 : name.find('/') + 1);
    return "<" + shown + " " + own + (isHere ? " " + attribute : "") + ">" + children +
           (isHere ? inside : "") + "</" + shown + ">";
  };
  const std::string jointed =
      "<body><joint name='h'/><geom name='g' size='1'/></body><body name='b'><joint "
      "name='i'/></body>";
  const auto only = [&](const std::string& parent, const std::string& child, const std::string& own) {
    return element == child ? tag(parent, "", tag(child, own)) : std::string();
  };
  return tag(
      "mujoco", "",
      tag("compiler", "") + tag("option", "", element == "flag" ? tag("flag", "") : "") +
          tag("default", "", "") +
          tag("asset", "",
              tag("mesh", "name='m' file='m.stl'") + tag("material", "name='c'") +
                  (element == "hfield" ? tag("hfield", "name='f' size='1 1 1 1' nrow='2' ncol='2'") : "")) +
          tag("worldbody", "",
              jointed + tag("body", "name='a'",
                            (element == "freejoint" ? tag("freejoint", "") : tag("joint", "name='j'")) +
                                tag("inertial", "pos='0 0 0' mass='1' diaginertia='1 1 1'") +
                                tag("geom", "name='k' size='1'") + tag("frame", "") +
                                (element == "replicate" ? tag("replicate", "count='1'") : ""))) +
          (element == "deformable" ? tag("deformable", "") : "") +
          (element == "contact" ? tag("contact", "") : "") + only("contact", "pair", "geom1='g' geom2='k'") +
          only("contact", "exclude", "body1='a' body2='b'") + (element == "tendon" ? tag("tendon", "") : "") +
          only("tendon", "spatial", "") +
          (element == "fixed" || element == "fixed/joint"
               ? "<tendon>" +
                     tag("fixed", "name='t'",
                         element == "fixed/joint" ? tag("fixed/joint", "joint='h' coef='1'") : "") +
                     "</tendon>"
               : "") +
          (element == "equality" ? tag("equality", "") : "") +
          only("equality", "connect", "body1='a' anchor='0 0 0'") + only("equality", "weld", "body1='a'") +
          only("asset", "model", "file='m.xml'") +
          (element == "equality/joint"
               ? "<equality>" + tag("equality/joint", "joint1='h' joint2='i'") + "</equality>"
               : "") +
          (element == "equality/tendon" ? "<tendon><fixed name='t'><joint joint='h' coef='1'/><joint "
                                          "joint='i' coef='1'/></fixed></tendon>"
                                          "<equality>" +
                                              tag("equality/tendon", "tendon1='t'") + "</equality>"
                                        : "") +
          (element == "actuator" ? tag("actuator", "") : "") + only("actuator", "motor", "joint='h'") +
          (element == "keyframe" ? tag("keyframe", "") : "") + only("keyframe", "key", ""));
}

Diagnostics notesOf(const std::string& xml, bool strict = false) {
  return parseMjcf(xml, "m.xml", {.strict = strict}).notes;
}

// Whatever is left out is told as the table says, is refused by a strict reading if it is grave, and else
// says nothing.
TEST(MjcfSchema, IsWhatTheReaderDoes) {
  for (const auto& [element, words] : kMujoco) {
    const Diagnostics bare = notesOf(modelWith(element, "", ""));
    for (const std::string_view word : splitWords(words)) {
      const std::string decided = classOf(element, std::string(word));
      if (decided == "read") continue;
      const bool isChild = word.starts_with('<');
      const std::string name(isChild ? word.substr(1, word.size() - 2) : word);
      const std::string xml =
          modelWith(element, isChild ? "" : name + "='1'", isChild ? "<" + name + "/>" : "");
      if (decided == "refused") {
        EXPECT_THROW(static_cast<void>(notesOf(xml)), Error) << xml;
        continue;
      }
      const Diagnostics notes = notesOf(xml);
      ASSERT_EQ(notes.size(), bare.size() + (decided == "silent" ? 0 : 1)) << xml;
      if (decided == "silent") continue;
      const auto isIt = [&](const Diagnostic& one) {
        return one.message.find(name) != std::string::npos &&
               one.message.find(decided) != std::string::npos && toString(differenceIn(one)) == decided;
      };
      EXPECT_TRUE(std::ranges::any_of(notes, isIt)) << xml;
      const bool isGrave = decided != "the picture will differ";
      EXPECT_EQ(std::ranges::find_if(notes, isIt)->severity, isGrave ? Severity::kWarning : Severity::kNote);
      if (!isGrave) continue;
      EXPECT_THROW(static_cast<void>(notesOf(xml, true)), Error) << xml;
    }
  }
}

}  // namespace rex::mjcf_schema_test
