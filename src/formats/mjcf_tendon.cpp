#include "formats/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

// What a tendon does by itself.
void noteForcesOf(const Styled& styled, const Compiler& compiler) {
  for (const char* attribute : {"stiffness", "damping", "frictionloss", "armature"}) {
    const Tag& giver = styled.giver(attribute);
    if (giver.has(attribute) && !giver.numbers(attribute, 1, 3).isZero(0))
      giver.leaveOut(attribute, Difference::kMotion);
  }
  if (isLimited(styled, "limited", "range", compiler))
    styled.giver("range").leaveOut("range", Difference::kMotion);
}

}  // namespace

void readTendons(const std::vector<Tag>& sections, Files& files, const Defaults& defaults,
                 const Compiler& compiler, BodyTree& tree) {
  for (const Tag& section : sections)
    for (const Tag& tag : files.children(section.of("<tendon>"), knownOf("tendon"))) {
      tag.expect(knownOf(tag.name()));
      noteForcesOf(Styled(tag, defaults.named(tag, "class", defaults.main()), Kind::kTendon), compiler);
      if (tag.name() == "spatial") tag.ignore("a <spatial> tendon", Difference::kPicture);
      if (tag.name() != "fixed" || !tag.has("name")) continue;
      std::vector<std::pair<std::string, double>>& joints = tree.tendons[tag.nameIn("name")];
      for (const Tag& part : tag.children("joint")) {
        part.expect(knownOf("fixed/joint"));
        joints.emplace_back(jointIn(part, "joint", tree).name, part.number("coef"));
      }
    }
}

}  // namespace rex::mjcf
