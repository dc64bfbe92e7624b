// Models with each attribute that MuJoCo and the reader both know, alone and in pairs: each means the same to
// both, or the reader warns that motion will differ.
#include <gtest/gtest.h>

#ifdef REX_WITH_MUJOCO

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "formats/mjcf_reader.h"
#include "support/mujoco_peer.h"

namespace rex::mjcf_generated_test {

// What stands at a mark of the model.
struct Piece {
  std::string mark, text;
};

// A pair of these may not stand together: two orientations, for example.
std::string kindOf(const Piece& piece) {
  const std::string name = piece.text.substr(0, piece.text.find('='));
  const bool turns =
      name == "euler" || name == "quat" || name == "axisangle" || name == "xyaxes" || name == "zaxis";
  return piece.mark + (turns ? "turn" : name);
}

const std::vector<Piece> kPieces = {
    {"@compiler", "angle='radian'"},
    {"@compiler", "eulerseq='ZYX'"},
    {"@compiler", "autolimits='false'"},
    {"@compiler", "inertiafromgeom='true'"},
    {"@compiler", "inertiafromgeom='false'"},
    {"@compiler", "inertiagrouprange='0 1'"},
    {"@compiler", "boundmass='4'"},
    {"@compiler", "boundinertia='.3'"},
    {"@compiler", "settotalmass='20'"},
    {"@compiler", "balanceinertia='true'"},
    {"@defaultgeom", "density='500'"},
    {"@defaultgeom", "type='box'"},
    {"@defaultgeom", "size='.3 .2 .1'"},
    {"@defaultgeom", "mass='2'"},
    {"@defaultgeom", "pos='.1 .2 .3'"},
    {"@defaultgeom", "euler='10 20 30'"},
    {"@defaultgeom", "group='2'"},
    {"@defaultjoint", "armature='.3'"},
    {"@defaultjoint", "damping='.4'"},
    {"@defaultjoint", "stiffness='5'"},
    {"@defaultjoint", "springref='.2'"},
    {"@defaultjoint", "springdamper='.5 .7'"},
    {"@defaultjoint", "axis='1 2 3'"},
    {"@defaultjoint", "pos='.2 .1 0'"},
    {"@defaultjoint", "type='slide'"},
    {"@defaultjoint", "ref='.3'"},
    {"@defaultjoint", "limited='true' range='-2 2'"},
    {"@defaultjoint", "frictionloss='.1'"},
    {"@body", "pos='1 2 3'"},
    {"@body", "quat='1 2 -3 4'"},
    {"@body", "axisangle='1 0 1 40'"},
    {"@body", "euler='30 -40 50'"},
    {"@body", "xyaxes='1 1 0 -1 1 .5'"},
    {"@body", "zaxis='1 2 3'"},
    {"@body", "childclass='other'"},
    {"@body", "mocap='false'"},
    {"@joint", "type='ball'"},
    {"@joint", "axis='0 -1 1'"},
    {"@joint", "pos='-.1 .2 .3'"},
    {"@joint", "ref='20'"},
    {"@joint", "class='other'"},
    {"@joint", "armature='.6'"},
    {"@joint", "stiffness='3'"},
    {"@joint", "springref='-15'"},
    {"@joint", "springdamper='.3 1.2'"},
    {"@joint", "damping='.7'"},
    {"@joint", "margin='.01'"},
    {"@joint", "group='1'"},
    {"@geom", "type='capsule' size='.1 .3'"},
    {"@geom", "type='cylinder' size='.1 .3'"},
    {"@geom", "type='box' size='.1 .2 .3'"},
    {"@geom", "type='ellipsoid' size='.1 .2 .3'"},
    {"@geom", "type='capsule' size='.1' fromto='0 0 0 1 2 3'"},
    {"@geom", "mass='3'"},
    {"@geom", "density='300'"},
    {"@geom", "group='3'"},
    {"@geom", "euler='5 6 7'"},
    {"@geom", "class='other'"},
    {"@geom", "contype='2'"},
    {"@geom", "condim='4'"},
    {"@geom", "rgba='1 0 0 1'"},
    {"@inertial", "<inertial pos='.1 .2 .3' mass='2' diaginertia='.3 .4 .5'/>"},
    {"@inertial", "<inertial pos='0 0 .1' mass='3' fullinertia='.3 .4 .5 .01 .02 .03'/>"},
    {"@inertial", "<inertial pos='0 .1 0' mass='2' diaginertia='.3 .3 .7' euler='10 20 30'/>"},
    {"@equality", "<joint joint1='k' joint2='j' polycoef='.1 2 0 0 0'/>"},
    {"@equality", "<joint joint1='k' joint2='j' active='false'/>"},
    {"@equality", "<connect body1='b' body2='c' anchor='.1 .2 .3'/>"},
    {"@equality", "<weld body1='b' body2='c'/>"},
};

std::string modelWith(const std::vector<Piece>& pieces) {
  std::string xml =
      "<mujoco><compiler @compiler/><default><geom @defaultgeom/><joint @defaultjoint/><default "
      "class='other'>"
      "<geom density='2000' pos='0 0 .2'/><joint axis='0 1 1' damping='.05'/></default></default><worldbody>"
      "<body name='a' pos='0 0 1'><joint name='j' axis='0 1 0'/><geom type='sphere' size='.2 .1 .1' pos='.3 "
      "0 0'/>"
      "<body name='b' @body><joint name='k' @joint/><geom size='.1 .2 .15' @geom/>@inertial"
      "<body name='c' pos='.2 0 .1'><geom type='box' size='.1 .1 .2'/><body name='d' pos='0 .3 0'>"
      "<joint name='l' type='slide'/><geom type='sphere' size='.1 .1 "
      ".1'/></body></body></body></body></worldbody>"
      "<equality>@equality</equality></mujoco>";
  for (const Piece& piece : pieces) {
    const std::size_t at = xml.find(piece.mark);
    xml.insert(at + piece.mark.size(), " " + piece.text);
  }
  for (std::size_t at; (at = xml.find('@')) != xml.npos;) xml.erase(at, xml.find_first_of(" /><", at) - at);
  return xml;
}

bool warnsOfMotion(const Diagnostics& notes) {
  return std::ranges::any_of(notes, [](const Diagnostic& one) { return one.severity == Severity::kWarning; });
}

enum class Outcome { kSame, kWarned, kRefusedByBoth, kRefusedByMujoco };

Outcome compare(const std::vector<Piece>& pieces) {
  const std::string xml = modelWith(pieces);
  SCOPED_TRACE(xml);
  bench::MujocoModel theirs;
  try {
    // The default of later versions.
    std::string later = xml;
    if (later.find("autolimits") == later.npos)
      later.insert(later.find("<compiler ") + 10, "autolimits='true' ");
    theirs = bench::loadMujoco(later);
  } catch (const std::logic_error&) {
    try {
      static_cast<void>(compile(parseMjcf(xml, "m.xml").spec));
      return Outcome::kRefusedByMujoco;
    } catch (const Error&) {
      return Outcome::kRefusedByBoth;
    }
  }
  SceneFile ours;
  try {
    ours = parseMjcf(xml, "m.xml");
  } catch (const Error& error) {
    ADD_FAILURE() << "only rex refuses it: " << error.what();
    return Outcome::kRefusedByBoth;
  }
  if (warnsOfMotion(ours.notes)) return Outcome::kWarned;
  expectSame(std::move(theirs), ours.spec, 1e-6, 3);
  return Outcome::kSame;
}

TEST(MjcfGenerated, MeansTheSameToMujocoOrWarns) {
  int counts[4] = {};
  for (std::size_t i = 0; i < kPieces.size(); ++i) {
    ++counts[static_cast<int>(compare({kPieces[i]}))];
    for (std::size_t k = i + 1; k < kPieces.size() && !HasFailure(); ++k)
      if (kindOf(kPieces[i]) != kindOf(kPieces[k]))
        ++counts[static_cast<int>(compare({kPieces[i], kPieces[k]}))];
  }
  RecordProperty("same", counts[0]);
  RecordProperty("warned", counts[1]);
  RecordProperty("refused by both", counts[2]);
  RecordProperty("refused by MuJoCo only", counts[3]);
  EXPECT_GT(counts[0], 1000);
}

}  // namespace rex::mjcf_generated_test

#endif
