#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

const std::vector<std::string> kGeomTypes = {"sphere", "capsule", "cylinder", "box", "ellipsoid",
                                             "mesh",   "plane",   "hfield",   "sdf"};
enum GeomType { kSphere, kCapsule, kCylinder, kBox, kEllipsoid, kMesh, kPlane, kHeightField, kSdf };

struct Sizes {
  int count;
  const char* wanted;
};
constexpr Sizes kSizes[] = {{1, "a radius > 0"},
                            {2, "a radius and half a length > 0"},
                            {2, "a radius and half a length > 0"},
                            {3, "3 half edges > 0"},
                            {3, "3 half axes > 0"}};

Eigen::VectorXd sizeOf(const Styled& styled, GeomType type, bool hasEnds) {
  const Tag& giver = styled.giver("size");
  const auto [whole, wanted] = kSizes[type];
  const int count = hasEnds ? 1 : whole;
  if (!giver.has("size")) styled.own().fail(styled.own().where(), "attribute 'size' is missing", "", wanted);
  const Eigen::VectorXd given = giver.numbers("size", 1, 3);
  if (given.size() < count || !(given.head(count).minCoeff() > 0))
    giver.failAt("size", xml::quoted(giver.text("size")), hasEnds ? "a radius > 0" : wanted);
  Eigen::VectorXd size = Eigen::VectorXd::Zero(3);
  size.head(count) = given.head(count);
  return size;
}

// From one end to the other: the pose at the middle, and half the length along z.
struct Span {
  Pose X;
  double half;
};

Span spanOf(const Styled& styled) {
  const Tag& tag = styled.giver("fromto");
  const Eigen::VectorXd ends = tag.numbers("fromto", 6);
  const Eigen::Vector3d way = ends.head<3>() - ends.tail<3>();
  const double length = way.stableNorm();
  if (!(length > 1e-10 && length < 1e100))
    tag.failAt("fromto", xml::quoted(tag.text("fromto")), "two different points");
  if (styled.own().has("fromto") && styled.own().has("pos"))
    tag.fail(tag.where("pos"), "attribute 'pos'", "'fromto' as well", "one of them");
  return {{rotationFromZ(way / length), (ends.head<3>() + ends.tail<3>()) / 2}, length / 2};
}

std::uint32_t bits(const Styled& styled, const char* attribute) {
  const Tag& giver = styled.giver(attribute);
  if (!giver.has(attribute)) return 1;
  const double number = giver.number(attribute);
  constexpr double kMost = 4294967295, kLeast = -2147483648;
  if (number != std::floor(number) || number < kLeast || number > kMost)
    giver.failAt(attribute, xml::quoted(giver.text(attribute)), "a 32-bit integer");
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(number));
}

// A colour of its own overrides that of its material, unless it is the default colour of geoms.
Eigen::Vector4d geomColor(const Styled& styled, const MjcfAssets& assets) {
  const Eigen::Vector4d usual(.5, .5, .5, 1);
  const Eigen::Vector4d own = colorOf(styled).value_or(usual);
  const Tag& named = styled.giver("material");
  if (own != usual || !named.has("material")) return own;
  const std::string& name = named.text("material");
  if (const auto found = assets.colors.find(name); found != assets.colors.end()) return found->second;
  styled.own().remark(fmt::format("unknown material {}: the geom keeps its own colour", xml::quoted(name)),
                      Difference::kPicture);
  return own;
}

Shape shapeOf(GeomType type, const Eigen::Vector3d& size) {
  if (type == kSphere)
    return {.type = ShapeType::kSphere, .extent = Eigen::Vector3d::Zero(), .radius = size[0]};
  if (type == kCapsule)
    return {.type = ShapeType::kCapsule, .extent = {0, 0, 2 * size[1]}, .radius = size[0]};
  if (type == kEllipsoid) return {.type = ShapeType::kEllipsoid, .extent = 2 * size};
  if (type == kCylinder)
    return {.type = ShapeType::kCylinder, .extent = {0, 0, 2 * size[1]}, .radius = size[0]};
  return {.type = ShapeType::kBox, .extent = 2 * size};
}

// A box whose upper side is the plane. The ground is drawn without it.
void readPlane(const Styled& styled, bool isOnWorld, ShapeSpec& shape) {
  const Tag& giver = styled.giver("size");
  Eigen::Vector2d half = Eigen::Vector2d::Zero();
  if (giver.has("size")) {
    const Eigen::VectorXd size = giver.numbers("size", 1, 3);
    half.head(std::min<Eigen::Index>(2, size.size())) = size.head(std::min<Eigen::Index>(2, size.size()));
    if (half.minCoeff() < 0) giver.failAt("size", xml::quoted(giver.text("size")), "half edges >= 0");
  }
  for (double& edge : half)
    if (edge == 0) edge = urdf::kPlaneWidth / 2;
  shape.shape = {.type = ShapeType::kBox, .extent = {2 * half[0], 2 * half[1], urdf::kPlaneThickness}};
  shape.X_BS = shape.X_BS * translation(0, 0, -urdf::kPlaneThickness / 2);
  shape.ground = isOnWorld && shape.X_BS.R(2, 2) > 1 - 1e-9;
  if (shape.ground) shape.visible = false;
  styled.own().remark(fmt::format(
      "a plane becomes a box {:g} m thick, as wide as its size says or {:g} m; the ground is not drawn",
      urdf::kPlaneThickness, urdf::kPlaneWidth));
}

// The asset that an attribute names.
template <class Asset>
const Asset& assetIn(const Styled& styled, const char* attribute,
                     const std::unordered_map<std::string, Asset>& assets) {
  const Tag& giver = styled.giver(attribute);
  const std::string& name = giver.text(attribute);
  if (const auto found = assets.find(name); found != assets.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [other, unused] : assets) known.push_back(other);
  std::sort(known.begin(), known.end());
  giver.fail(giver.where(attribute), fmt::format("unknown {}", attribute), xml::quoted(name),
             fmt::format("a <{}> of the <asset>", attribute), nearestNames(name, known));
}

// The shape of a mesh; false if rex reads none for it.
bool readMesh(const Styled& styled, const MjcfAssets& assets, ShapeSpec& shape) {
  const MeshAsset& mesh = assetIn(styled, "mesh", assets.meshes);
  if (mesh.file.empty() && mesh.mesh.isEmpty()) return false;
  shape.shape.type = ShapeType::kMesh;
  shape.shape.mesh = mesh.mesh;
  shape.shape.hull = mesh.hull;
  shape.X_BS = shape.X_BS * mesh.X_SM;
  shape.meshFile = mesh.file;
  shape.meshScale = mesh.scale;
  shape.where = mesh.where;
  return true;
}

// A shape that is drawn, and those that are touched.
void addHeightField(const HeightField& field, const ShapeSpec& geom, const Tag& tag,
                    std::vector<ShapeSpec>& shapes) {
  if (field.pieces.empty())
    return tag.remark("a <geom> of type 'hfield' is ignored: a scene that is given as text has no files",
                      Difference::kContact);
  shapes.push_back(geom);
  shapes.front().contact = false;
  shapes.front().shape = {.type = ShapeType::kMesh, .mesh = field.drawn};
  for (const TriangleMesh& piece : field.pieces) {
    shapes.push_back(geom);
    shapes.back().visible = false;
    shapes.back().shape = {.type = ShapeType::kMesh, .mesh = piece, .hull = piece};
  }
}

// The pose and size of the geom.
struct Extent {
  Pose X_BS;
  Eigen::Vector3d size;
};
Extent extentOf(const Styled& styled, GeomType type, const Compiler& compiler) {
  const bool hasEnds = type <= kEllipsoid && type != kSphere && styled.has("fromto");
  if (!hasEnds) {
    const Eigen::Vector3d size = type <= kEllipsoid ? sizeOf(styled, type, false) : Eigen::Vector3d::Zero();
    return {poseOf(styled, compiler), size};
  }
  const Span span = spanOf(styled);
  const double radius = sizeOf(styled, type, true)[0];
  const bool isRound = type == kCapsule || type == kCylinder;
  return {span.X,
          isRound ? Eigen::Vector3d(radius, span.half, 0) : Eigen::Vector3d(radius, radius, span.half)};
}

constexpr Solid::Kind kSolidKinds[] = {Solid::Kind::kSphere, Solid::Kind::kCapsule,   Solid::Kind::kCylinder,
                                       Solid::Kind::kBox,    Solid::Kind::kEllipsoid, Solid::Kind::kMesh};

std::optional<Solid> solidOf(const Styled& styled, GeomType type, const Extent& extent,
                             const Compiler& compiler) {
  const double group = styled.number("group", 0);
  if (type > kMesh || group < compiler.leastGroup || group > compiler.mostGroup) return {};
  Solid solid;
  solid.kind = kSolidKinds[type];
  solid.size = extent.size;
  solid.X_BS = extent.X_BS;
  solid.where = styled.own().where();
  if (styled.has("mass")) solid.mass = styled.giver("mass").notNegative("mass");
  if (styled.has("density")) solid.density = styled.giver("density").notNegative("density");
  if (const Tag& giver = styled.giver("shellinertia"); giver.has("shellinertia"))
    solid.isShell = flag(giver, "shellinertia");
  const bool weighs = solid.mass ? *solid.mass > 0 : solid.density > 0;
  return weighs ? std::optional(solid) : std::nullopt;
}

// As MuJoCo since version 3.3: a mesh says itself whether it is a shell.
void weighMesh(const Styled& styled, const MjcfAssets& assets, Solid& solid) {
  solid.inertia = assets.meshes.at(styled.giver("mesh").text("mesh")).inertia;
  if (solid.isShell)
    styled.own().warn(
        styled.own().where(),
        "'shellinertia' has no effect on a mesh, as in MuJoCo since version 3.3: its <mesh> needs "
        "inertia=\"shell\"");
}

}  // namespace

Geom readGeom(const Styled& styled, bool isOnWorld, const Compiler& compiler, const MjcfAssets& assets) {
  const Tag& tag = styled.own();
  const Tag& typed = styled.giver("type");
  const auto given = typed.has("type") ? static_cast<GeomType>(choice(typed, "type", kGeomTypes)) : kSphere;
  Geom geom;
  if (given > kHeightField) {
    tag.remark(fmt::format("a <geom> of type '{}' is ignored, with its mass", kGeomTypes[given]),
               Difference::kMotion);
    return geom;
  }
  const bool isFitted = given < kMesh && styled.has("mesh");
  const GeomType type = isFitted ? kMesh : given;
  const Extent extent = extentOf(styled, type, compiler);
  geom.solid = solidOf(styled, type, extent, compiler);
  ShapeSpec shape{.name = tag.has("name") ? tag.nameIn("name") : "", .X_BS = extent.X_BS, .shape = {}};
  shape.where = tag.where();
  shape.color = geomColor(styled, assets);
  shape.mask = {.type = bits(styled, "contype"), .affinity = bits(styled, "conaffinity")};
  shape.contact = shape.mask.type != 0 || shape.mask.affinity != 0;
  constexpr double kFirstHiddenGroup = 3;  // as in MuJoCo's viewer
  shape.visible = styled.number("group", 0) < kFirstHiddenGroup && shape.color[3] > 0;
  if (type == kMesh && !readMesh(styled, assets, shape)) {
    tag.remark("a <geom> whose mesh is not read is ignored, with its mass", Difference::kMotion);
    geom.solid.reset();
    return geom;
  }
  if (type == kHeightField) {
    addHeightField(assetIn(styled, "hfield", assets.heightFields), shape, tag, geom.shapes);
    return geom;
  }
  if (type == kMesh && geom.solid) geom.solid->X_BS = shape.X_BS;
  if (isFitted) {
    const Tag& scaled = styled.giver("fitscale");
    geom.fit = GeomFit{kSolidKinds[given], assetIn(styled, "mesh", assets.meshes).inertia,
                       scaled.has("fitscale") ? scaled.positive("fitscale") : 1,
                       std::exchange(shape.contact, false)};
  }
  if (given == kMesh && geom.solid) weighMesh(styled, assets, *geom.solid);
  if (type != kMesh) shape.shape = shapeOf(type, extent.size);
  if (type == kPlane) readPlane(styled, isOnWorld, shape);
  geom.shapes.push_back(std::move(shape));
  return geom;
}

}  // namespace rex::mjcf
