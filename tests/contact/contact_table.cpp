#include "contact/contact_table.h"

#include <cmath>
#include <exception>

#include <fmt/format.h>

#include "contact/contact_scenes.h"

namespace rex::contact {
namespace {

constexpr const char* kIntroduction = R"(# Contacts against closed answers

Scenes whose results are known in closed form, each in three engines at steps of 1 ms:

- **rex**: `PhysicsWorld`, which is Bullet with our contacts, couplings and pins,
- **MuJoCo** with its own settings of contacts: they are soft and creep, their friction is a pyramid, and there is no
  coefficient of restitution,
- **Bullet** with its own settings, and its own constraints for mimics and pins.

A test holds rex to the last column: its difference from the formula is no larger.
`scripts/contact-table` measures again; the code of the scenes is beside this page.
)";

std::string number(double value) { return fmt::format("{:#.5g}", value); }

// A scene may be more than an engine can do.
std::string measuredBy(const Engine& engine, const ContactScene& scene) {
  try {
    const double value = scene.measured(engine);
    return std::isfinite(value) ? number(value) : "diverges";
  } catch (const std::exception&) {
    return "fails";
  }
}

}  // namespace

std::string contactTable() {
  std::string text = kIntroduction;
  text += "\n| scene | measured | formula | | rex | MuJoCo | Bullet | unit | within |\n";
  text += "| --- | --- | --- | --: | --: | --: | --: | --- | --: |\n";
  std::string remarks;
  for (const ContactScene& scene : contactScenes()) {
    std::string mujoco = "none";
#ifdef REX_WITH_MUJOCO
    if (!scene.bounces) mujoco = measuredBy(mujocoEngine(), scene);
#endif
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {:g} |\n", scene.name, scene.quantity,
                        scene.law, number(scene.formula), measuredBy(rexEngine(), scene), mujoco,
                        measuredBy(bulletEngine(), scene), scene.unit, scene.reached);
    if (!scene.remark.empty()) remarks += fmt::format("- **{}**: {}\n", scene.name, scene.remark);
  }
  if (!remarks.empty()) text += "\nWhat keeps rex from the closed answer:\n\n" + remarks;
  return text;
}

}  // namespace rex::contact
