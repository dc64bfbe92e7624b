#include <map>

#include "base/text.h"
#include "formats/mjcf_schema_internal.h"

namespace rex::mjcf {
namespace {

// Of the words, those in <> are children, the others attributes. @pose stands for the attributes of a pose,
// @body for the children of a body that are read.
struct Row {
  std::string_view element;
  std::string_view read;
  std::string_view silent = "";   // without an effect on motion, contact and picture
  std::string_view picture = "";  // what differs if these are left out
  std::string_view contact = "";
  std::string_view motion = "";
  std::string_view refused = "";  // children that hold bodies
};

constexpr std::string_view kPose = "pos quat axisangle euler xyaxes zaxis";
constexpr std::string_view kBodyChildren =
    "<include> <inertial> <joint> <freejoint> <geom> <body> <frame> <replicate> <attach>";

constexpr Row kRows[] = {
    {"mujoco",
     "model <include> <compiler> <option> <default> <asset> <worldbody> <actuator> <equality> <contact> "
     "<keyframe> <tendon> <deformable>",
     "<size> <statistic> <custom> <sensor> <extension>", "<visual>"},
    {"compiler",
     "angle autolimits coordinate eulerseq meshdir assetdir inertiafromgeom inertiagrouprange strippath "
     "boundmass boundinertia settotalmass balanceinertia fitaabb exactmeshinertia alignfree",
     "<lengthrange> usethread fusestatic texturedir saveinertial conflict convexhull", "discardvisual"},
    {"option", "gravity wind density viscosity <flag>",
     "timestep apirate tolerance ls_tolerance ccd_tolerance mpr_tolerance sleep_tolerance magnetic "
     "integrator "
     "jacobian solver iterations ls_iterations ccd_iterations mpr_iterations sdf_iterations sdf_initpoints",
     "", "impratio noslip_tolerance noslip_iterations cone collision o_margin o_solref o_solimp o_friction",
     "actuatorgroupdisable"},
    {"flag",
     "constraint equality frictionloss limit contact spring damper passive gravity clampctrl filterparent "
     "actuation override",
     "warmstart refsafe sensor midphase eulerdamp autoreset nativeccd island multiccd energy fwdinv "
     "invdiscrete sensornoise sleep diagexact",
     "", "", "ipc"},
    {"default",
     "class <include> <default> <joint> <geom> <mesh> <material> <equality> <general> <motor> <position> "
     "<velocity> <intvelocity> <damper> <cylinder> <tendon>",
     "<site> <camera> <muscle> <adhesion> <plugin> <orientation> <pid> <dcmotor>", "<light>", "<pair>"},
    {"asset", "<include> <mesh> <material> <hfield> <model>", "", "<texture> <skin>"},
    {"model", "name file", "content_type"},
    {"attach", "model body prefix"},
    {"mesh", "name class file scale inertia vertex face refpos refquat builtin params", "content_type",
     "normal texcoord smoothnormal material", "maxhullvert", "<plugin>"},
    {"material", "name class rgba", "",
     "<layer> texture texrepeat texuniform emission specular shininess reflectance metallic roughness"},
    {"hfield", "name file nrow ncol size elevation", "content_type"},
    {"worldbody", "@body", "<camera>", "<site> <light>", "", "<plugin>", "<composite> <flexcomp>"},
    {"body", "name childclass @pose gravcomp @body", "mocap user sleep simple fuse <camera>",
     "<site> <light>", "", "<plugin>", "<composite> <flexcomp>"},
    {"frame", "name childclass @pose @body", "<camera>", "<site> <light>", "", "<plugin>",
     "<composite> <flexcomp>"},
    {"replicate", "count offset euler sep childclass @body", "<camera>", "<site> <light>", "", "<plugin>",
     "<composite> <flexcomp>"},
    {"inertial", "@pose mass diaginertia fullinertia"},
    {"joint",
     "name class type pos axis range limited ref damping frictionloss actuatorfrcrange actuatorfrclimited "
     "armature stiffness springref springdamper",
     "group user actuatorgravcomp", "", "", "margin solreflimit solimplimit solreffriction solimpfriction"},
    {"freejoint", "name align", "group"},
    {"geom",
     "name class type @pose size fromto mass density group contype conaffinity rgba material mesh hfield "
     "fitscale shellinertia",
     "user", "", "condim priority friction solmix solref solimp margin gap surfacevel adhesion",
     "<plugin> fluidshape fluidcoef"},
    {"contact", "<include> <exclude> <pair>"},
    {"pair", "name class geom1 geom2", "", "",
     "condim friction solref solreffriction solimp gap margin adhesion"},
    {"exclude", "name class body1 body2"},
    {"tendon", "<include> <fixed> <spatial>"},
    {"fixed",
     "name class limited range frictionloss springlength stiffness damping armature actuatorfrclimited "
     "actuatorfrcrange <joint>",
     "group user margin solreflimit solimplimit solreffriction solimpfriction"},
    {"fixed/joint", "joint coef"},
    {"spatial",
     "name class limited range frictionloss springlength stiffness damping armature actuatorfrclimited "
     "actuatorfrcrange <site> <geom> <pulley>",
     "group user margin solreflimit solimplimit solreffriction solimpfriction width material rgba"},
    {"deformable", "<include>", "", "<skin>", "", "<flex>"},
    {"equality", "<include> <joint> <connect> <weld> <tendon>", "", "", "",
     "<flex> <flexvert> <flexstrain> <distance> <plugin>"},
    {"connect", "name class active body1 body2 anchor site1 site2", "", "", "", "solref solimp"},
    {"weld", "name class active body1 body2 site1 site2 anchor relpose torquescale", "", "", "",
     "solref solimp"},
    {"equality/joint", "name class active joint1 joint2 polycoef", "", "", "", "solref solimp"},
    {"equality/tendon", "name class active tendon1 tendon2 polycoef", "", "", "", "solref solimp"},
    {"actuator", "<include> <general> <motor> <position> <velocity> <intvelocity> <damper> <cylinder>", "",
     "", "", "<muscle> <adhesion> <plugin> <orientation> <pid> <dcmotor>"},
    {"motor",
     "name class joint gear ctrlrange ctrllimited forcerange forcelimited gaintype biastype dyntype gainprm "
     "tendon cranksite slidersite site refsite body jointinparent",
     "group user lengthrange nsample interp", "", "",
     "delay actdim actearly actlimited actrange biasprm dynprm kp kv dampratio timeconst inheritrange "
     "cranklength area diameter bias damping armature input velrange ffrange"},
    {"keyframe", "<include> <key>"},
    {"key", "name qpos", "time qvel act ctrl mpos mquat"},
};

// Puts the words of a list where they belong.
void addWords(std::string_view words, std::vector<std::string>& attributes,
              std::vector<std::string>& children) {
  for (const std::string_view word : splitWords(words)) {
    if (word == "@pose") {
      addWords(kPose, attributes, children);
    } else if (word == "@body") {
      addWords(kBodyChildren, attributes, children);
    } else if (word.starts_with('<')) {
      children.emplace_back(word.substr(1, word.size() - 2));
    } else {
      attributes.emplace_back(word);
    }
  }
}

urdf::Known madeOf(const Row& row) {
  urdf::Known known;
  known.refusesOthers = true;
  addWords(row.read, known.attributes, known.children);
  const auto leaveOut = [&](std::string_view words, Difference difference) {
    std::vector<std::string> attributes, children;
    addWords(words, attributes, children);
    for (std::string& name : attributes) known.leftOut.emplace(std::move(name), difference);
    for (const std::string& name : children) known.leftOut.emplace("<" + name + ">", difference);
  };
  leaveOut(row.silent, Difference::kNone);
  leaveOut(row.picture, Difference::kPicture);
  leaveOut(row.contact, Difference::kContact);
  leaveOut(row.motion, Difference::kMotion);
  std::vector<std::string> none;
  addWords(row.refused, none, known.refused);
  return known;
}

}  // namespace

const urdf::Known& knownOf(std::string_view element) {
  static const std::map<std::string_view, urdf::Known> kAll = [] {
    std::map<std::string_view, urdf::Known> all;
    for (const Row& row : kRows) all.emplace(row.element, madeOf(row));
    return all;
  }();
  static const urdf::Known kNone;
  const auto found = kAll.find(element);
  return found == kAll.end() ? kNone : found->second;
}

}  // namespace rex::mjcf
