#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "scene/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostHeightFields = 16;
constexpr const char* kMeshInertias[] = {"convex", "exact", "legacy", "shell"};

const Known& knownOfAsset() {
  static const Known kKnown = {{}, {"include", "mesh", "material", "hfield"}, {"texture", "skin", "model"}};
  return kKnown;
}

template <class Thing>
void add(const Tag& tag, const std::string& name, const char* attribute, Thing thing,
         std::unordered_map<std::string, Thing>& things) {
  if (!things.emplace(name, std::move(thing)).second)
    tag.fail(tag.where(attribute), fmt::format("a second {} of this name", tag.name()), xml::quoted(name),
             "a name of its own");
}

void readMesh(const Styled& styled, const Compiler& compiler, MjcfAssets& assets) {
  const Tag& tag = styled.own();
  MeshAsset mesh;
  mesh.where = tag.where("file");
  if (tag.has("file")) {
    const std::string& file = tag.nameIn("file");
    const fs::path path = compiler.stripsPaths ? fs::path(file).filename() : fs::path(file);
    mesh.file = (fs::path(compiler.meshFolder) / path).generic_string();
  }
  if (const Tag& giver = styled.giver("scale"); giver.has("scale")) {
    mesh.scale = giver.numbers("scale", 3);
    if ((mesh.scale.array() == 0).any())
      giver.failAt("scale", xml::quoted(giver.text("scale")), "3 numbers that are not 0");
  }
  const Tag& giver = styled.giver("inertia");
  mesh.inertia = giver.has("inertia")
                     ? static_cast<MeshInertia>(
                           choice(giver, "inertia", {std::begin(kMeshInertias), std::end(kMeshInertias)}))
                     : compiler.meshInertia;
  // Without a name it is named after its file.
  const bool isNamed = tag.has("name") || !tag.has("file");
  const std::string name = isNamed ? tag.nameIn("name") : fs::path(tag.text("file")).stem().string();
  add(tag, name, isNamed ? "name" : "file", std::move(mesh), assets.meshes);
}

void readMaterial(const Styled& styled, MjcfAssets& assets) {
  const Eigen::Vector4d color = colorOf(styled).value_or(Eigen::Vector4d::Ones());
  add(styled.own(), styled.own().nameIn("name"), "name", color, assets.colors);
}

}  // namespace

const char* wordOf(MeshInertia inertia) { return kMeshInertias[static_cast<std::size_t>(inertia)]; }

const Known& knownOfMesh() {
  static const Known kKnown = {{"name", "class", "file", "scale", "inertia"},
                               {},
                               {"plugin"},
                               {"content_type", "vertex", "normal", "texcoord", "face", "refpos", "refquat",
                                "smoothnormal", "maxhullvert", "builtin", "params", "material"}};
  return kKnown;
}

const Known& knownOfMaterial() {
  static const Known kKnown = {{"name", "class", "rgba"},
                               {},
                               {"layer"},
                               {"texture", "texrepeat", "texuniform", "emission", "specular", "shininess",
                                "reflectance", "metallic", "roughness"}};
  return kKnown;
}

std::optional<Eigen::Vector4d> colorOf(const Styled& styled) {
  const Tag* const giver = styled.giverOfText("rgba");
  if (!giver) return {};
  const Eigen::Vector4d color = giver->numbers("rgba", 4);
  if (color.minCoeff() < 0 || color.maxCoeff() > 1)
    giver->forgiveAt("rgba", xml::quoted(giver->text("rgba")), "4 numbers from 0 to 1",
                     "the nearest such numbers are used");
  return color.cwiseMax(0).cwiseMin(1);
}

void readAssets(const Tag& section, Files& files, const Defaults& defaults, const Compiler& compiler,
                MjcfAssets& assets) {
  for (const Tag& tag : files.children(section, knownOfAsset())) {
    if (tag.name() == "hfield") {
      if (assets.heightFields.size() == kMostHeightFields)
        tag.fail(tag.where(), "too many", "", fmt::format("at most {}", kMostHeightFields));
      HeightField field = readHeightField(tag, files, compiler);
      const bool isNamed = tag.has("name") || !tag.has("file");
      const std::string name = isNamed ? tag.nameIn("name") : fs::path(tag.text("file")).stem().string();
      add(tag, name, isNamed ? "name" : "file", std::move(field), assets.heightFields);
    }
    const bool isMesh = tag.name() == "mesh";
    if (!isMesh && tag.name() != "material") continue;
    tag.expect(isMesh ? knownOfMesh() : knownOfMaterial());
    const Styled styled(tag, defaults.named(tag, "class", defaults.main()),
                        isMesh ? Kind::kMesh : Kind::kMaterial);
    if (isMesh) {
      readMesh(styled, compiler, assets);
    } else {
      readMaterial(styled, assets);
    }
  }
}

}  // namespace rex::mjcf
