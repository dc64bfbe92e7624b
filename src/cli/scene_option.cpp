#include "cli/scene_option.h"

#include <vector>

#include "cli/wrong_use_internal.h"
#include "scene/find_scene.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

void choose(ShapeSpec& shape, const std::string& shapes) {
  if (shapes == "contact") shape.visible = shape.contact;
  if (shapes == "all") shape.visible = true;
}

void chooseShapes(SceneSpec& spec, const std::string& shapes) {
  const std::vector<std::string> known = {"visible", "contact", "all"};
  if (!shapes.empty() && shapes != known[0] && shapes != known[1] && shapes != known[2])
    throw UsageError({.what = "--shapes",
                      .found = "'" + harmless(shapes) + "'",
                      .wanted = "visible, contact or all",
                      .nearest = nearestNames(shapes, known)});
  for (ShapeSpec& shape : spec.worldShapes) choose(shape, shapes);
  for (BodySpec& body : spec.bodies)
    for (ShapeSpec& shape : body.shapes) choose(shape, shapes);
}

}  // namespace

fs::path fileOf(const Project& project, const SceneOption& scene) {
  return asWrongUse([&] { return shown(findScene(scene.file, project.root / "data")); });
}

SceneSpec loadSpec(const Project& project, const SceneOption& scene) {
  const fs::path file = fileOf(project, scene);
  SceneFile read = asWrongUse([&] { return readScene(file, scene.reading); });
  for (const Diagnostic& one : read.notes) note(wrap(harmless(toString(one)), 2, 0));
  read.spec.name = scene.file.filename().string();
  chooseShapes(read.spec, scene.shapes);
  return std::move(read.spec);
}

Model loadScene(const Project& project, const SceneOption& scene) {
  const SceneSpec spec = loadSpec(project, scene);
  return asWrongUse([&] { return compile(spec); });
}

}  // namespace rex::cli
