#include <cmath>

#include <fmt/format.h>

#include "scene/ors_shape_internal.h"

namespace rex::ors {
namespace {

constexpr int kRetiredBox = 6;

constexpr Choice kShapeWords[] = {{0, "ST_box"},     {1, "ST_sphere"},     {2, "ST_capsule"},
                                  {3, "ST_mesh"},    {4, "ST_cylinder"},   {5, "ST_marker"},
                                  {kRetiredBox, ""}, {7, "ST_pointCloud"}, {8, "ST_ssCvx"},
                                  {9, "ST_ssBox"},   {10, "ST_cone"},      {11, "ST_ellipsoid"}};
constexpr ShapeType kShapeTypes[] = {
    ShapeType::kBox,        ShapeType::kSphere,     ShapeType::kCapsule,
    ShapeType::kMesh,       ShapeType::kCylinder,   ShapeType::kMarker,
    ShapeType::kRoundedBox, ShapeType::kPointCloud, ShapeType::kSphereSweptConvex,
    ShapeType::kRoundedBox, ShapeType::kCone,       ShapeType::kEllipsoid};

ShapeType readType(const Attributes& attributes, const Place& where, Diagnostics& notes) {
  const auto type = attributes.choice("type", kShapeWords);
  if (!type) {
    throw Error({.what = attributes.owner() + ": attribute 'type' is missing",
                 .where = where,
                 .wanted = "type=0 .. type=11"});
  }
  if (kShapeWords[*type].number == kRetiredBox)
    attributes.note("type", "6 is retired: read as ST_ssBox, a rounded box", Severity::kNote, notes);
  return kShapeTypes[*type];
}

// Whether the fourth number of the size matters, so that leaving it out is probably a mistake.
bool hasRadius(ShapeType type) {
  return type == ShapeType::kSphere || type == ShapeType::kCapsule || type == ShapeType::kCylinder ||
         type == ShapeType::kCone || type == ShapeType::kRoundedBox;
}

void readSize(const Attributes& attributes, Shape& shape, Diagnostics& notes) {
  const auto size = attributes.row("size", {3, 4});
  if (!size && hasRadius(shape.type) && shape.type != ShapeType::kRoundedBox)
    attributes.note("size", "is missing: the radius, its fourth number, is 0", Severity::kWarning, notes);
  if (!size) return;
  shape.extent = size->head<3>();
  shape.radius = size->size() == 4 ? (*size)[3] : 0;
  if (size->minCoeff() < 0)
    attributes.fail("size", fmt::format("{}", size->minCoeff()), "lengths that are not negative");
  if (size->size() == 3 && hasRadius(shape.type))
    attributes.note("size", "has three numbers: the radius, its fourth, is 0", Severity::kWarning, notes);
}

// Whole numbers from 0 to `most`.
Eigen::VectorXd wholeNumbers(const Attributes& attributes, const char* name,
                             std::initializer_list<int> counts, double most) {
  const Eigen::VectorXd all = attributes.row(name, counts).value_or(Eigen::VectorXd());
  for (const double number : all)
    if (!(number >= 0 && number <= most && number == std::floor(number)))
      attributes.fail(name, fmt::format("{}", number), fmt::format("whole numbers from 0 to {:.0f}", most));
  return all;
}

ContactMask readMask(const Attributes& attributes) {
  ContactMask mask;
  const Eigen::VectorXd bits = wholeNumbers(attributes, "contact_bits", {2}, 4294967295.);
  if (bits.size() == 2)
    mask.type = static_cast<std::uint32_t>(bits[0]), mask.affinity = static_cast<std::uint32_t>(bits[1]);
  for (const double pair : wholeNumbers(attributes, "contact_pairs", {}, 1e6))
    mask.pairs.push_back(static_cast<int>(pair));
  return mask;
}

void noteNoMesh(const Attributes& attributes, ShapeType type, Diagnostics& notes) {
  for (const char* name : {"mesh", "meshscale"})
    if (!usesMesh(type) && attributes.has(name))
      attributes.note(name, "is ignored: a shape of this type has no mesh", Severity::kWarning, notes);
}

}  // namespace

const std::vector<std::string>& shapeAttributes() {
  static const std::vector<std::string> kNames = {"type",
                                                  "size",
                                                  "rel",
                                                  "color",
                                                  "contact",
                                                  "contact_bits",
                                                  "contact_pairs",
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
  spec.shape.type = readType(attributes, where, notes);
  noteNoMesh(attributes, spec.shape.type, notes);
  spec.where = attributes.where(usesMesh(spec.shape.type) ? "mesh" : "size");
  readSize(attributes, spec.shape, notes);
  spec.X_BS = attributes.pose("rel").value_or(Pose{});
  attributes.noteFlags({"contact", "hidden"}, notes);
  if (const auto color = attributes.row("color", {3, 4})) {
    for (const double part : *color)
      if (part < 0 || part > 1) attributes.fail("color", fmt::format("{}", part), "numbers from 0 to 1");
    spec.color.head(color->size()) = *color;
  }
  spec.contact = attributes.flag("contact");
  spec.mask = readMask(attributes);
  spec.visible = !attributes.flag("hidden");
  if (const auto mesh = attributes.file("mesh")) spec.meshFile = mesh->path;
  if (const auto scale = attributes.row("meshscale", {1, 3}))
    spec.meshScale = scale->size() == 1 ? Eigen::Vector3d::Constant((*scale)[0]) : scale->head<3>().eval();
  return spec;
}

}  // namespace rex::ors
