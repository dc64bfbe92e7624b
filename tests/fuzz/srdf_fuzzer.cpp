#include <optional>

#include "formats/srdf.h"
#include "formats/urdf_reader.h"
#include "fuzz/require.h"
#include "fuzz/sound_scene.h"
#include "scene/model.h"

namespace {

constexpr const char* kArm =
    "<robot name='arm'><link name='base'/><link name='forearm'/><link name='hand'/>"
    "<joint name='j' type='continuous'><parent link='base'/><child link='forearm'/></joint>"
    "<joint name='k' type='continuous'><parent link='forearm'/><child link='hand'/></joint></robot>";

void requireSame(const rex::CollisionChoice& one, const rex::CollisionChoice& other) {
  rex::fuzz::require(one.a == other.a && one.b == other.b && one.mayCollide == other.mayCollide &&
                         one.reason == other.reason,
                     "a choice that was written is read again");
}

void requireSound(const rex::SceneFile& robot) {
  const rex::Model model = rex::compile(robot.spec);
  rex::fuzz::require(model.collisionChoices().size() == robot.spec.collisionChoices.size(),
                     "all choices name bodies");
  for (const rex::PairChoice& choice : model.collisionChoices())
    rex::fuzz::require(choice.b != choice.a, "a pair has two bodies");
  rex::SceneFile again = rex::parseUrdf(kArm, "arm.urdf");
  rex::parseSrdf(rex::writeSrdf("arm", robot.spec.collisionChoices), "again.srdf", again);
  rex::fuzz::require(again.spec.collisionChoices.size() == robot.spec.collisionChoices.size(),
                     "as many choices are read as were written");
  for (std::size_t i = 0; i < again.spec.collisionChoices.size(); ++i)
    requireSame(robot.spec.collisionChoices[i], again.spec.collisionChoices[i]);
}

}  // namespace

// The input is the text of an .srdf file of a small arm.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::optional<rex::SceneFile> robot = rex::parseUrdf(kArm, "arm.urdf");
  try {
    rex::parseSrdf(text, "arm.srdf", *robot);
  } catch (const rex::Error& error) {
    rex::fuzz::requirePlace(error, text);
    robot.reset();
  }
  if (robot) requireSound(*robot);
  return 0;
}
