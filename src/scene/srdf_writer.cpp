#include "scene/srdf_writer.h"

#include <fmt/format.h>

#include "scene/urdf_markup_internal.h"

namespace rex {

std::string writeSrdf(const std::string& robot, std::span<const CollisionChoice> choices,
                      const std::string& about) {
  urdf::Markup markup;
  if (!about.empty()) markup.text += fmt::format("<!-- {} -->\n", about);
  markup.open("robot", {{"name", robot}});
  for (const CollisionChoice& choice : choices) {
    if (choice.b.empty()) {
      markup.empty("disable_default_collisions", {{"link", choice.a}});
    } else {
      markup.empty(choice.mayCollide ? "enable_collisions" : "disable_collisions",
                   {{"link1", choice.a}, {"link2", choice.b}, {"reason", choice.reason}});
    }
  }
  markup.close("robot");
  return std::move(markup.text);
}

}  // namespace rex
