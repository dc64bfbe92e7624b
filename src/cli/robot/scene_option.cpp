#include "cli/robot/scene_option.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "cli/numbers.h"
#include "collision/collision_pairs.h"
#include "formats/assets.h"

namespace rex::cli {

namespace {

namespace fs = std::filesystem;

// Shapes that are drawn only on request lie around the visible ones.
void chooseVisibility(ShapeSpec& shape, const std::string& shapes) {
  constexpr double kTranslucent = 0.35;
  if (shapes == "contact") shape.visible = shape.contact;
  if (shapes != "all" || shape.visible) return;
  shape.visible = true;
  shape.color[3] *= kTranslucent;
}

void chooseShapes(SceneSpec& spec, const std::string& shapes) {
  const std::vector<std::string> known = {"visible", "contact", "all"};
  if (shapes != known[0] && shapes != known[1] && shapes != known[2])
    throw UsageError({.what = "--shapes",
                      .found = "'" + escapeForTerminal(shapes) + "'",
                      .wanted = "visible, contact or all",
                      .nearest = nearestNames(shapes, known)});
  bool anyContact = false;
  const auto chooseAll = [&](std::vector<ShapeSpec>& some) {
    for (ShapeSpec& shape : some) {
      chooseVisibility(shape, shapes);
      anyContact |= shape.contact;
    }
  };
  chooseAll(spec.worldShapes);
  for (BodySpec& body : spec.bodies) chooseAll(body.shapes);
  if (shapes == "contact" && !anyContact)
    throw UsageError({.what = "--shapes contact", .found = "no shape that takes part in contacts"});
}

// If a mesh is missing, says which options help.
SceneFile read(const fs::path& file, const ReadOptions& reading) {
  return asWrongUse([&] {
    try {
      return readScene(file, reading);
    } catch (const Error& error) {
      if (error.parts().what.ends_with(": mesh") &&
          error.parts().wanted.find("--assets") == std::string::npos)
        note("--assets DIR names the folder of all meshes, --allow-missing-meshes draws boxes instead");
      throw;
    }
  });
}

}  // namespace

void requireMeaning(const fs::path& file, const ReadOptions& reading) {
  const bool isOrs = endingOf(file) == ".ors", isMjcf = endingOf(file) == ".xml";
  if (!isOrs && !isMjcf) return;
  const std::string found = isOrs ? "an .ors file" : "an .xml file";
  if (reading.freeBase)
    throw UsageError({.what = "--free-base",
                      .found = found,
                      .wanted = isOrs ? "a .urdf file; in .ors, use a joint of type free"
                                      : "a .urdf file; in MJCF, use <freejoint/>"});
  if (!reading.srdf.empty())
    throw UsageError({.what = "--srdf",
                      .found = found,
                      .wanted = isOrs ? "a .urdf file; in .ors, use statements 'collisions'"
                                      : "a .urdf file; in MJCF, use <contact>"});
}

fs::path sceneFilePath(const Project& project, const SceneOption& scene) {
  return asWrongUse([&] { return shown(findScene(scene.file, project.files() / "data")); });
}

SceneSpec loadSpec(const Project& project, const SceneOption& scene) {
  const fs::path file = sceneFilePath(project, scene);
  requireMeaning(file, scene.reading);
  SceneFile loaded = read(file, scene.reading);
  const Diagnostics notes = grouped(loaded.notes);
  for (const Diagnostic& one : notes) note(wrap(escapeForTerminal(toString(one)), 2, 0));
  if (notes.size() < loaded.notes.size())
    note(fmt::format("`rex scene {} check` shows all {} findings", escapeForTerminal(scene.file.string()),
                     loaded.notes.size()));
  if (!loaded.spec.pins.empty())
    note(
        wrap("pins close loops here: Bullet keeps them closed (rex simulate --engine bullet, Simulate in rex "
             "view); "
             "kinematics, plans and the other engines see the tree of joints only",
             2, 0));
  loaded.spec.name = scene.file.filename().string();
  chooseShapes(loaded.spec, scene.shapes);
  return std::move(loaded.spec);
}

Model loadScene(const Project& project, const SceneOption& scene) {
  const SceneSpec spec = loadSpec(project, scene);
  return asWrongUse([&] { return compile(spec); });
}

namespace {

std::size_t pairsOfBodies(const Model& model) {
  std::vector<std::size_t> onBody(model.bodies().size());
  std::size_t all = 0, pairs = 0;
  for (const ModelShape& shape : model.shapes())
    if (shape.contact) pairs += all++ - onBody[static_cast<std::size_t>(shape.body)]++;
  return pairs;
}

}  // namespace

ContactModel sceneContactModel(const Model& model) {
  if (const std::size_t pairs = pairsOfBodies(model); pairs > kMostContactPairs)
    throw UsageError({.what = escapeForTerminal(model.name()) + ": too many shapes take part in contacts",
                      .found = fmt::format("{} pairs of shapes", pairs),
                      .wanted = fmt::format("at most {}", kMostContactPairs)});
  return asWrongUse([&] {
    noteCollisionWarnings(model);
    return ContactModel(model);
  });
}

void noteCollisionWarnings(const Model& model) {
  for (const Diagnostic& one : collisionWarnings(model)) note(wrap(escapeForTerminal(toString(one)), 2, 0));
}

}  // namespace rex::cli
