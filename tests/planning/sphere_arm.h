#pragma once

#include <fmt/format.h>

#include "base/rng.h"
#include "formats/urdf_reader.h"
#include "geometry/rotation.h"
#include "scene/scene_spec.h"

namespace rex {

/// A base, five hinges, a slider between them, a finger that mimics it, and a tool fixed to the last link;
/// each link has three spheres. Some frames only exchange axes, others do not.
inline SceneSpec sphereArm() {
  std::string text = "<robot name='arm'>";
  const auto link = [&](const std::string& name, double along) {
    text += fmt::format("<link name='{}'>", name);
    for (int i = 1; i <= 3; ++i)
      text += fmt::format(
          "<collision><origin xyz='0.01 {} {}'/><geometry><sphere radius='{}'/></geometry></collision>",
          0.01 * i, along * i / 3, 0.06 - 0.01 * i);
    text += "</link>";
  };
  const auto joint = [&](const std::string& parent, const std::string& child, const std::string& content) {
    text += fmt::format("<joint name='{1}' {2}<parent link='{0}'/><child link='{1}'/></joint>", parent, child,
                        content);
  };
  const std::string limit = "<limit lower='-2.5' upper='2.5' effort='1' velocity='1'/>";
  for (const auto& [name, along] : {std::pair("base", .05),
                                    {"a", .3},
                                    {"b", .25},
                                    {"c", .2},
                                    {"d", .2},
                                    {"e", .1},
                                    {"f", .1},
                                    {"tool", .1},
                                    {"finger", .05}})
    link(name, along);
  joint("base", "a", "type='revolute'><origin xyz='0 0 .1'/><axis xyz='0 0 1'/>" + limit);
  joint("a", "b",
        "type='revolute'><origin xyz='0 .05 .3' rpy='-1.5707963267948966 0 0'/><axis xyz='0 0 1'/>" + limit);
  joint("b", "c", "type='revolute'><origin xyz='0 -.05 .3' rpy='.3 .5 .7'/><axis xyz='0 1 0'/>" + limit);
  joint("c", "d",
        "type='prismatic'><origin xyz='0 0 .2'/><axis xyz='1 0 2'/><limit lower='0' upper='.2' effort='1' "
        "velocity='1'/>");
  joint("d", "e", "type='revolute'><origin xyz='0 0 .25'/><axis xyz='1 0 0'/>" + limit);
  joint("e", "f",
        "type='revolute'><origin xyz='0 0 .15' rpy='1.5707963267948966 0 0'/><axis xyz='0 0 1'/>" + limit);
  joint("f", "tool", "type='fixed'><origin xyz='0 0 .15'/>");
  joint("tool", "finger",
        "type='prismatic'><origin xyz='.05 0 .1'/><axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='1' "
        "velocity='1'/><mimic joint='d' multiplier='-.5' offset='.02'/>");
  return parseUrdf(text + "</robot>", "arm.urdf").spec;
}

/// Obstacles of all kinds around it, upright and not.
inline std::vector<ShapeSpec> randomObstacles(Rng& rng, int count) {
  std::vector<ShapeSpec> obstacles;
  for (int i = 0; i < count; ++i) {
    ShapeSpec obstacle{.name = fmt::format("obstacle {}", i), .X_BS = {}, .shape = {}, .contact = true};
    constexpr ShapeType kTypes[] = {ShapeType::kBox, ShapeType::kSphere, ShapeType::kCapsule,
                                    ShapeType::kCylinder};
    obstacle.shape.type = kTypes[i % 4];
    obstacle.shape.extent = {rng.uniform(.05, .5), rng.uniform(.05, .5), rng.uniform(.05, .5)};
    obstacle.shape.radius = rng.uniform(.03, .15);
    obstacle.X_BS =
        rotation(rng.uniform(-3, 3),
                 i / 4 % 2 == 0 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(rng.normal(), rng.normal(), 1));
    obstacle.X_BS.p = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-.2, 1.2)};
    obstacles.push_back(obstacle);
  }
  return obstacles;
}

}  // namespace rex
