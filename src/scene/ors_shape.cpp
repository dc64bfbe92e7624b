#include <fmt/format.h>

#include "scene/ors_shape_internal.h"

namespace rex::ors {
namespace {

constexpr int kRetiredBox = 6;

constexpr Choice kTypes[] = {{0, "ST_box"},      {1, "ST_sphere"}, {2, "ST_capsule"}, {3, "ST_mesh"},
                             {4, "ST_cylinder"}, {5, "ST_marker"}, {kRetiredBox, ""}, {7, "ST_pointCloud"},
                             {8, "ST_ssCvx"},    {9, "ST_ssBox"}};
constexpr ShapeType kMeaning[] = {
    ShapeType::kBox,        ShapeType::kSphere,     ShapeType::kCapsule,
    ShapeType::kMesh,       ShapeType::kCylinder,   ShapeType::kMarker,
    ShapeType::kRoundedBox, ShapeType::kPointCloud, ShapeType::kSphereSweptConvex,
    ShapeType::kRoundedBox};

ShapeType readType(const Attributes& attributes, const Place& where, Diagnostics& notes) {
  const auto type = attributes.choice("type", kTypes);
  if (!type) {
    throw Error({.what = attributes.owner() + ": attribute 'type' is missing",
                 .where = where,
                 .wanted = "type=0 .. type=9"});
  }
  if (kTypes[*type].number == kRetiredBox)
    attributes.note("type", "6 is retired: read as ST_ssBox, a rounded box", Severity::kNote, notes);
  return kMeaning[*type];
}

void readSize(const Attributes& attributes, Shape& shape) {
  const auto size = attributes.row("size", {3, 4});
  if (!size) return;
  shape.extent = size->head<3>();
  shape.radius = size->size() == 4 ? (*size)[3] : 0;
  if (size->minCoeff() < 0)
    attributes.fail("size", fmt::format("{}", size->minCoeff()), "lengths that are not negative");
}

}  // namespace

const std::vector<std::string>& shapeAttributes() {
  static const std::vector<std::string> kNames = {"type",
                                                  "size",
                                                  "rel",
                                                  "color",
                                                  "contact",
                                                  "mesh",
                                                  "meshscale",
                                                  "hidden",
                                                  "swiftfile",
                                                  "coloredBox",
                                                  "rel_includes_mesh_center"};
  return kNames;
}

ShapeSpec readShape(const Attributes& attributes, std::string name, const Place& where, Diagnostics& notes) {
  ShapeSpec spec;
  spec.name = std::move(name);
  spec.where = where;
  spec.shape.type = readType(attributes, where, notes);
  readSize(attributes, spec.shape);
  spec.X_BS = attributes.pose("rel").value_or(Pose{});
  if (const auto color = attributes.row("color", {3, 4})) spec.color.head(color->size()) = *color;
  spec.contact = attributes.flag("contact");
  spec.visible = !attributes.flag("hidden");
  if (const auto mesh = attributes.file("mesh")) spec.meshFile = mesh->path;
  if (const auto scale = attributes.row("meshscale", {1, 3}))
    spec.meshScale = scale->size() == 1 ? Eigen::Vector3d::Constant((*scale)[0]) : scale->head<3>().eval();
  return spec;
}

}  // namespace rex::ors
