#include <algorithm>

#include <fmt/format.h>

#include "base/text.h"
#include "formats/assets.h"
#include "formats/urdf_parts_internal.h"
#include "geometry/mesh_mass.h"
#include "geometry/rotation.h"

namespace rex::urdf {
namespace {

// Negative moments count as rounding error up to a millionth of the sum of moments, as files give some six
// digits, or up to mass times the square of a micrometre, as no file means lengths below that.
constexpr double kRelativeRounding = 1e-6, kRoundingLength = 1e-6;
constexpr double kOwnRounding = 1e-14;

std::string whatIsDone(const Eigen::Vector3d& moments, double mass) {
  const double sum = moments.cwiseAbs().sum();
  const bool isRounding =
      moments[0] >= -std::max(kRelativeRounding * sum, kRoundingLength * kRoundingLength * mass);
  std::vector<std::string> negative;
  for (const double moment : moments)
    if (moment < -kOwnRounding * sum) negative.push_back(fmt::format("{:.6g}", moment));
  const bool isOne = negative.size() == 1;
  return fmt::format("{} kg m^2 {} and {} as 0", join(negative, " and "),
                     isRounding ? (isOne ? "is within rounding error" : "are within rounding error")
                                : (isOne ? "is physically impossible" : "are physically impossible"),
                     isOne ? "counts" : "count");
}

}  // namespace

Eigen::Matrix3d judgedMoments(Reading& reading, const SourceLocation& where, const std::string& subject,
                              const Eigen::Matrix3d& I, double mass) {
  const InertiaFault fault = inertiaFault(I);
  const auto warn = [&](const std::string& message) { reading.notes.warn(where, subject + ": " + message); };
  if (fault == InertiaFault::kTriangle)
    warn("no body has this inertia: one principal moment exceeds the sum of the others");
  const Eigen::Vector3d moments = principalMoments(I);
  if (moments[0] >= -kOwnRounding * moments.cwiseAbs().sum()) return I;
  const std::string instead = whatIsDone(moments, mass);
  if (fault == InertiaFault::kNegative) {
    reading.forgive({subject + ": a negative principal moment", where, "", "principal moments >= 0"},
                    instead);
  } else {
    warn("a negative principal moment; " + instead);
  }
  return nearestWithoutNegativeMoments(I);
}

namespace {

// Bounds the work for the names in messages.
constexpr std::size_t kMostGuesses = 100, kLongestGuess = 32;

Eigen::Vector4d readColor(const Tag& tag) {
  static const Known kKnown = {{"rgba"}, {}};
  tag.expect(kKnown);
  const Eigen::Vector4d color = tag.numbers("rgba", 4);
  if (color.minCoeff() < 0 || color.maxCoeff() > 1)
    tag.failAt("rgba", xml::quoted(tag.text("rgba")), "4 numbers from 0 to 1");
  return color;
}

const Known& knownOfMaterial() {
  static const Known kKnown = {{"name"}, {"color", "texture"}};
  return kKnown;
}

// The colour that a material gives here, else that of its name.
Eigen::Vector4d colorOf(const Tag& material, const Materials& materials, const Eigen::Vector4d& otherwise) {
  material.expect(knownOfMaterial());
  const std::optional<Tag> texture = material.child("texture");
  if (texture) texture->ignore("<texture>");
  if (const std::optional<Tag> color = material.child("color")) return readColor(*color);
  if (texture) return otherwise;
  const std::string& name = material.nameIn("name");
  if (const auto found = materials.colors.find(name); found != materials.colors.end()) return found->second;
  material.warn(material.where("name"), [&] {
    const bool isShort = name.size() <= kLongestGuess;
    const std::vector<std::string> nearest =
        nearestNames(name, isShort ? materials.guesses : std::vector<std::string>{});
    return fmt::format("unknown material {} is drawn grey{}", xml::quoted(name),
                       nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest.front()));
  });
  return otherwise;
}

// What a size of 0 counts as, metres: points, lines and disks are tiny solids. The same for factors of a
// scale.
constexpr double kTiniestSize = 1e-6;

// Replaces zeros among the numbers of an attribute.
template <class Numbers>
void thicken(const Tag& tag, const char* attribute, const char* wanted, Numbers& sizes) {
  if ((sizes.array() != 0).all()) return;
  tag.forgiveAt(attribute, xml::quoted(tag.text(attribute)), wanted,
                fmt::format("0 counts as {}", kTiniestSize));
  sizes = (sizes.array() == 0).select(Numbers::Constant(sizes.size(), kTiniestSize), sizes);
}

double sizeIn(const Tag& tag, const char* attribute) {
  if (tag.number(attribute) != 0) return tag.positive(attribute);
  Eigen::VectorXd size = Eigen::VectorXd::Zero(1);
  thicken(tag, attribute, "a number > 0", size);
  return size[0];
}

Shape roundShape(const Tag& tag, ShapeType type) {
  static const Known kKnown = {{"radius", "length"}, {}};
  tag.expect(kKnown);
  return {.type = type, .extent = {0, 0, sizeIn(tag, "length")}, .radius = sizeIn(tag, "radius")};
}

Shape boxShape(const Tag& tag) {
  static const Known kKnown = {{"size"}, {}};
  tag.expect(kKnown);
  Eigen::Vector3d size = tag.numbers("size", 3);
  if (!(size.minCoeff() >= 0)) tag.failAt("size", xml::quoted(tag.text("size")), "3 numbers > 0");
  thicken(tag, "size", "3 numbers > 0", size);
  return {.type = ShapeType::kBox, .extent = size};
}

Shape sphereShape(const Tag& tag) {
  static const Known kKnown = {{"radius"}, {}};
  tag.expect(kKnown);
  return {.type = ShapeType::kSphere, .extent = Eigen::Vector3d::Zero(), .radius = sizeIn(tag, "radius")};
}

// A plane with that normal, which Bullet knows. It is touched, but not drawn: pictures have a ground.
void readPlane(const Tag& tag, ShapeSpec& spec) {
  static const Known kKnown = {{"normal"}, {}};
  tag.expect(kKnown);
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  if (tag.has("normal")) normal = tag.numbers("normal", 3);
  if (!(normal.stableNorm() > 1e-100 && normal.stableNorm() < 1e100))
    tag.failAt("normal", xml::quoted(tag.text("normal")), "a direction");
  spec.shape = {.type = ShapeType::kBox, .extent = {kPlaneWidth, kPlaneWidth, kPlaneThickness}};
  spec.X_BS.R *= rotationBetween(Eigen::Vector3d::UnitZ(), normal);
  spec.X_BS = spec.X_BS * translation(0, 0, -kPlaneThickness / 2);
  spec.visible = false;
  tag.remark(fmt::format("a plane becomes a box {:g} m thick and {:g} m wide, which is not drawn",
                         kPlaneThickness, kPlaneWidth));
}

// One number counts for all axes, as in Drake; of four the first three, as in Bullet.
Eigen::Vector3d readScale(const Tag& tag) {
  const auto forgive = [&](const char* instead) {
    tag.forgiveAt("scale", xml::quoted(tag.text("scale")), "3 numbers", instead);
  };
  const std::size_t count = splitWords(tag.text("scale")).size();
  Eigen::VectorXd scale = tag.numbers("scale", count == 1 || count == 4 ? static_cast<int>(count) : 3);
  if (count == 1) forgive("it scales all three axes");
  if (count == 1) scale = Eigen::VectorXd::Constant(3, scale[0]);
  if (count == 4) forgive("the first three are used");
  scale.conservativeResize(3);
  thicken(tag, "scale", "3 numbers that are not 0", scale);
  return scale;
}

void readMesh(const Tag& tag, ShapeSpec& spec) {
  static const Known kKnown = {{"filename", "scale"}, {}};
  tag.expect(kKnown);
  spec.shape.type = ShapeType::kMesh;
  spec.ignoresUpAxis = true;
  spec.meshFile = tag.text("filename");
  spec.where = tag.where("filename");
  if (spec.meshFile.empty()) tag.failAt("filename", "nothing", "a file");
  if (!tag.isStrict() && namesNoPackage(spec.meshFile))
    tag.forgiveAt("filename", xml::quoted(spec.meshFile), "package://PACKAGE/PATH",
                  "the path is looked up in the folders above the file");
  if (tag.has("scale")) spec.meshScale = readScale(tag);
}

// Whether there is a shape: one of an unknown kind, which is not a misspelt one, is left out with its
// <visual> or <collision>.
bool readGeometry(const Tag& geometry, std::string_view holder, ShapeSpec& spec) {
  static const Known kKnown = {{}, {"box", "cylinder", "sphere", "capsule", "mesh", "plane"}};
  static const char* const kWanted = "<box>, <cylinder>, <sphere>, <capsule>, <mesh> or <plane>";
  const std::vector<Tag> others = geometry.children();
  const auto isMeant = [&](const Tag& tag) {
    return !nearestNames(std::string(tag.name()), kKnown.children).empty();
  };
  if (!others.empty() && std::ranges::none_of(others, isMeant)) {
    geometry.forgive(others.front().where(), "a shape of an unknown kind",
                     fmt::format("<{}>", others.front().name()), kWanted,
                     fmt::format("this <{}> is left out", holder));
    return false;
  }
  geometry.expect(kKnown);
  std::optional<Tag> only;
  for (const Tag& shape : others) {
    if (std::ranges::find(kKnown.children, shape.name()) == kKnown.children.end()) continue;
    if (only)
      geometry.forgive(shape.where(), "two shapes", fmt::format("<{}> and <{}>", only->name(), shape.name()),
                       "one", "the first is used");
    else
      only = shape;
  }
  if (!only) {
    const std::string found = others.empty() ? "" : std::string(others.front().name());
    geometry.fail(geometry.where(), "no shape", found.empty() ? "" : fmt::format("<{}>", found), kWanted,
                  nearestNames(found, kKnown.children));
  }
  if (only->name() == "box") spec.shape = boxShape(*only);
  if (only->name() == "cylinder") spec.shape = roundShape(*only, ShapeType::kCylinder);
  if (only->name() == "sphere") spec.shape = sphereShape(*only);
  if (only->name() == "capsule") spec.shape = roundShape(*only, ShapeType::kCapsule);
  if (only->name() == "mesh") readMesh(*only, spec);
  if (only->name() == "plane") readPlane(*only, spec);
  return true;
}

// <visual> or <collision>.
std::optional<ShapeSpec> readShape(const Tag& tag, const std::string& link, const Materials& materials) {
  static const Known kVisual = {{"name"}, {"origin", "geometry", "material"}};
  static const Known kCollision = {{"name"}, {"origin", "geometry"}, {"material"}};
  const bool visible = tag.name() == "visual";
  tag.expect(visible ? kVisual : kCollision);
  ShapeSpec spec;
  spec.name = tag.has("name") && !tag.text("name").empty() ? tag.nameIn("name") : link;
  spec.X_BS = tag.origin();
  spec.visible = visible;
  spec.contact = !visible;
  spec.where = tag.where();
  if (!readGeometry(tag.neededChild("geometry"), tag.name(), spec)) return {};
  if (const std::optional<Tag> material = visible ? tag.child("material") : std::nullopt)
    spec.color = colorOf(*material, materials, spec.color);
  return spec;
}

// About the centre of mass, along the axes of <inertial>.
Eigen::Matrix3d readMoments(const Tag& tag) {
  static const Known kKnown = {{"ixx", "iyy", "izz", "ixy", "ixz", "iyz"}, {}};
  tag.expect(kKnown);
  std::vector<std::string> missing;
  const auto entry = [&](const char* name) {
    if (tag.isStrict() || tag.has(name)) return tag.number(name);
    missing.push_back(fmt::format("'{}'", name));
    return 0.0;
  };
  const double xx = entry("ixx"), yy = entry("iyy"), zz = entry("izz");
  const double xy = entry("ixy"), xz = entry("ixz"), yz = entry("iyz");
  if (missing.size() == 1)
    tag.warn(tag.where(), fmt::format("attribute {} is missing and counts as 0", missing[0]));
  if (missing.size() > 1)
    tag.warn(tag.where(), fmt::format("attributes {} are missing and count as 0", join(missing, ", ")));
  return (Eigen::Matrix3d() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
}

void readInertial(const Tag& tag, BodySpec& body) {
  static const Known kKnown = {{}, {"origin", "mass", "inertia"}};
  static const Known kKnownOfMass = {{"value"}, {}};
  tag.expect(kKnown);
  const Pose X_BI = tag.origin();
  const Tag mass = tag.neededChild("mass");
  mass.expect(kKnownOfMass);
  body.mass = mass.notNegative("value");
  body.p_BBcm = X_BI.p;
  const Tag inertia = tag.neededChild("inertia");
  const Eigen::Matrix3d given = readMoments(inertia);
  if (body.mass == 0) {
    if (given.isZero(0)) {
      mass.warn(mass.where("value"), "0 kg: the link has no mass, as without <inertial>");
      return;
    }
    mass.forgive(mass.where("value"), "an inertia without mass", "0", "a mass > 0 kg", "the inertia is kept");
  }
  // Without a mass, rounding errors are those of a kilogram.
  const Eigen::Matrix3d I = judgedMoments(inertia, given, body.mass > 0 ? body.mass : 1);
  const Eigen::Matrix3d I_B = X_BI.R * I * X_BI.R.transpose();
  body.inertia = (I_B + I_B.transpose()) / 2;
}

std::string thingOf(const Tag& link) { return fmt::format("link '{}'", link.nameIn("name")); }

}  // namespace

bool Materials::add(const std::string& name, const Eigen::Vector4d& color) {
  const bool isNew = colors.emplace(name, color).second;
  if (isNew && guesses.size() < kMostGuesses && name.size() <= kLongestGuess) guesses.push_back(name);
  return isNew;
}

Materials readMaterials(const Tag& robot) {
  Materials materials;
  for (const Tag& material : robot.children("material")) {
    material.expect(knownOfMaterial());
    const std::string& name = material.nameIn("name");
    const std::optional<Tag> color = material.child("color"), texture = material.child("texture");
    if (texture) texture->ignore("<texture>");
    if (!color && !texture) material.fail(material.where(), "<color> is missing", "", "");
    const bool isNew = materials.add(name, color ? readColor(*color) : ShapeSpec{}.color);
    if (!isNew)
      material.fail(material.where("name"), "a second material of this name", xml::quoted(name),
                    "a name of its own");
  }
  for (const Tag& link : robot.children("link")) {
    if (!link.has("name")) continue;  // readLink() says so
    for (const Tag& visual : link.of(thingOf(link.of("<link>"))).children("visual"))
      if (const std::vector<Tag> all = visual.children("material"); !all.empty() && all[0].has("name"))
        for (const Tag& color : all[0].children("color"))
          materials.add(all[0].text("name"), color.numbers("rgba", 4));
  }
  return materials;
}

BodySpec readLink(const Tag& tag, const Materials& materials) {
  static const Known kKnown = {{"name"}, {"inertial", "visual", "collision"}, {"sensor", "gazebo"}};
  const Tag link = tag.of(thingOf(tag));
  BodySpec body;
  body.name = link.text("name");
  link.expect(kKnown);
  body.where = link.where();
  if (const std::optional<Tag> inertial = link.child("inertial")) readInertial(*inertial, body);
  for (const Tag& part : link.children()) {
    if (part.name() != "visual" && part.name() != "collision") continue;
    if (std::optional<ShapeSpec> shape = readShape(part, body.name, materials))
      body.shapes.push_back(*std::move(shape));
  }
  return body;
}

}  // namespace rex::urdf
