// Scenes of contacts with closed answers, and MuJoCo's opinion of the formulas.
#include "contact/contact_scenes.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "contact/contact_table.h"

namespace rex::contact_scenes_test {

using contact::ContactScene;

class PhysicsScenes : public testing::TestWithParam<ContactScene> {};

std::string nameOf(const testing::TestParamInfo<ContactScene>& info) {
  std::string name = info.param.name;
  std::erase(name, '-');
  return name;
}

TEST_P(PhysicsScenes, AgreeWithTheFormula) {
  const ContactScene& scene = GetParam();
  const double measured = scene.measured(contact::rexEngine());
  RecordProperty("measured", std::to_string(measured));
  EXPECT_NEAR(measured, scene.formula, scene.reached) << scene.quantity << " [" << scene.unit << "]";
}

#ifdef REX_WITH_MUJOCO
class MujocoScenes : public testing::TestWithParam<ContactScene> {};

// MuJoCo's contacts are soft and do not bounce.
std::vector<ContactScene> scenesOfSoftContacts() {
  std::vector<ContactScene> scenes = contact::contactScenes();
  std::erase_if(scenes, [](const ContactScene& scene) { return scene.bounces || scene.needsRigidity; });
  return scenes;
}

// Formulas and scenes could be wrong in the same way. MuJoCo need only come near.
TEST_P(MujocoScenes, ConfirmTheFormula) {
  const ContactScene& scene = GetParam();
  const double measured = scene.measured(contact::mujocoEngine());
  EXPECT_NEAR(measured, scene.formula, 0.1 * scene.formula) << scene.quantity << " [" << scene.unit << "]";
}

INSTANTIATE_TEST_SUITE_P(All, MujocoScenes, testing::ValuesIn(scenesOfSoftContacts()), nameOf);
#endif

INSTANTIATE_TEST_SUITE_P(All, PhysicsScenes, testing::ValuesIn(contact::contactScenes()), nameOf);

}  // namespace rex::contact_scenes_test
