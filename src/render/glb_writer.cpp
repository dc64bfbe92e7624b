#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <tuple>

#include <tiny_gltf.h>

#include "geometry/rotation.h"
#include "render/glb_writer_internal.h"
#include "render/picture_internal.h"
#include "render/solid_mesh_internal.h"

namespace rex::internal {
namespace {

using Eigen::Vector3d;

constexpr int kSides = 28;  // around it; a replay is looked at closely, and loaded over a network

GlbSurface surfaceOf(const SolidMesh& mesh, const Vector3d& halfSize,
                     const Vector3d& stretch = Vector3d::Zero(), double lift = 0) {
  GlbSurface surface;
  for (const MeshVertex& vertex : mesh.vertices) {
    const Vector3d unit = Eigen::Map<const Eigen::Vector3f>(vertex.position).cast<double>();
    const Vector3d normal = Eigen::Map<const Eigen::Vector3f>(vertex.normal).cast<double>();
    const Vector3d end = Eigen::Map<const Eigen::Vector3f>(vertex.end).cast<double>();
    const Vector3d at = halfSize.cwiseProduct(unit) + stretch.cwiseProduct(end) + Vector3d(0, 0, lift);
    surface.positions.push_back(at.cast<float>());
    surface.normals.push_back(normal.cwiseQuotient(halfSize).normalized().cast<float>());
  }
  surface.indices.assign(mesh.indices.begin(), mesh.indices.end());
  return surface;
}

}  // namespace

int GlbMeshes::ofShape(const Shape& shape, const Color& color) {
  const double r = shape.radius;
  const bool hasBox = shape.extent.minCoeff() > 0;
  switch (shape.type) {
    case ShapeType::kBox:
      return hasBox ? add(surfaceOf(makeBoxMesh(), shape.extent / 2), color) : -1;
    case ShapeType::kRoundedBox:
      return hasBox ? ofRoundedBox(shape, color) : -1;
    case ShapeType::kSphere:
      return r > 0 ? ball(color) : -1;
    case ShapeType::kCapsule: {
      const Vector3d stretch(0, 0, shape.extent.z() / 2);
      return r > 0 ? add(surfaceOf(makeCapsuleMesh(kSides), Vector3d::Constant(r), stretch), color) : -1;
    }
    case ShapeType::kEllipsoid:
      return hasBox ? add(surfaceOf(makeCapsuleMesh(kSides), shape.extent / 2), color) : -1;
    case ShapeType::kCylinder:
    case ShapeType::kCone: {
      const Vector3d halfSize(r, r, shape.extent.z() / 2);
      const auto make = shape.type == ShapeType::kCone ? makeConeMesh : makeCylinderMesh;
      return halfSize.minCoeff() > 0 ? add(surfaceOf(make(kSides), halfSize), color) : -1;
    }
    case ShapeType::kMarker:
      return ofAxes(-shape.extent.x() / 2, shape.extent.x() / 2);
    case ShapeType::kMesh:
    case ShapeType::kPointCloud:
    case ShapeType::kSphereSweptConvex:
      return ofMesh(shape, color);
  }
  return -1;
}

int GlbMeshes::shaft(const Color& color) {
  return add(surfaceOf(makeCylinderMesh(kSides), {1, 1, 0.5}, Vector3d::Zero(), 0.5), color);
}

int GlbMeshes::head(const Color& color) {
  return add(surfaceOf(makeConeMesh(kSides), {1, 1, 0.5}, Vector3d::Zero(), 0.5), color);
}

int GlbMeshes::ball(const Color& color) {
  return add(surfaceOf(makeCapsuleMesh(kSides), Vector3d::Ones()), color);
}

int GlbMeshes::plane(double half, const Color& color) {
  const auto h = static_cast<float>(half);
  const std::vector<Eigen::Vector3f> up(4, Eigen::Vector3f::UnitZ());
  return add({{{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}}, up, {0, 1, 2, 0, 2, 3}}, color);
}

int GlbMeshes::axes(double size) { return ofAxes(0, size); }

int GlbMeshes::add(const GlbSurface& surface, const Color& color) {
  return intern({{.positions = writer_->addVertices(surface.positions, surface.positions.size()),
                  .normals = writer_->addVertices(surface.normals, surface.normals.size()),
                  .indices = writer_->addIndices(surface.indices),
                  .color = color}});
}

int GlbMeshes::ofMesh(const Shape& shape, const Color& color) {
  const TriangleMesh& mesh = shape.mesh;
  if (mesh.isEmpty()) return -1;
  const int positions = writer_->addVertices(mesh.positions(), mesh.positions().size());
  if (mesh.triangles().empty() || shape.type == ShapeType::kPointCloud)
    return points(positions, color, 2 * kCloudPointRadius);
  const int normals = writer_->addVertices(mesh.normals(), mesh.normals().size());
  std::vector<GlbPrimitive> primitives;
  for (const TriangleMesh::Part& part : mesh.parts()) {
    if (part.triangleCount == 0) continue;
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : mesh.triangles().subspan(part.firstTriangle, part.triangleCount))
      indices.insert(indices.end(), triangle.begin(), triangle.end());
    Eigen::Vector4f own = part.color.value_or(Eigen::Vector4f(color.r, color.g, color.b, 1));
    own[3] *= color.a;
    primitives.push_back({.positions = positions,
                          .normals = normals,
                          .indices = writer_->addIndices(indices),
                          .color = {own[0], own[1], own[2], own[3]},
                          .doubleSided = true});  // it may be open
  }
  return intern(primitives);
}

int GlbMeshes::ofRoundedBox(const Shape& shape, const Color& color) {
  const Vector3d half = shape.extent / 2;
  const double r = std::min(shape.radius, half.minCoeff());
  if (!(r > 0)) return add(surfaceOf(makeBoxMesh(), half), color);
  return add(surfaceOf(makeRoundedBoxMesh(kSides), Vector3d::Constant(r), half.array() - r), color);
}

int GlbMeshes::ofAxes(double from, double to) {
  if (from == to) return -1;
  std::vector<GlbPrimitive> primitives;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3f axis = Eigen::Vector3f::Unit(i);
    const std::vector<Eigen::Vector3f> ends = {static_cast<float>(from) * axis,
                                               static_cast<float>(to) * axis};
    primitives.push_back({.topology = GlbTopology::kLines,
                          .positions = writer_->addVertices(ends, ends.size()),
                          .color = kAxisColors[static_cast<std::size_t>(i)]});
  }
  return intern(primitives, {.numbers = {{"width", {kAxisWidth}}}});
}

int GlbMeshes::lines(int positions, const Color& color, double width) {
  return intern({{.topology = GlbTopology::kLines, .positions = positions, .color = color}},
                {.numbers = {{"width", {width}}}});
}

int GlbMeshes::line(int positions, const Color& color, double width) {
  return intern({{.topology = GlbTopology::kLineStrip, .positions = positions, .color = color}},
                {.numbers = {{"width", {width}}}});
}

int GlbMeshes::points(int positions, const Color& color, double size) {
  return intern({{.topology = GlbTopology::kPoints, .positions = positions, .color = color}},
                {.numbers = {{"size", {size}}}});
}

int GlbMeshes::intern(const std::vector<GlbPrimitive>& primitives, const GlbExtras& extras) {
  std::vector<Part> parts;
  for (const auto& [topology, positions, normals, indices, color, doubleSided] : primitives)
    parts.push_back(
        {topology, positions, normals, indices, doubleSided, {color.r, color.g, color.b, color.a}});
  const auto known = known_.find({parts, extras});
  if (known != known_.end()) return known->second;
  return known_[{parts, extras}] = writer_->addMesh(primitives, extras);
}

namespace {

tinygltf::Value valueOf(const std::vector<double>& numbers) {
  if (numbers.size() == 1) return tinygltf::Value(numbers[0]);
  tinygltf::Value::Array list;
  for (const double number : numbers) list.emplace_back(number);
  return tinygltf::Value(std::move(list));
}

tinygltf::Value valueOf(const GlbExtras& extras) {
  if (extras.numbers.empty() && extras.texts.empty()) return {};
  tinygltf::Value::Object object;
  for (const auto& [name, numbers] : extras.numbers) object.emplace(name, valueOf(numbers));
  for (const auto& [name, text] : extras.texts) object.emplace(name, tinygltf::Value(text));
  return tinygltf::Value(std::move(object));
}

// Colours are linear in glTF, but not on a screen.
double linear(float part) {
  const double c = std::clamp<double>(part, 0, 1);
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

int modeOf(GlbTopology topology) {
  switch (topology) {
    case GlbTopology::kLines:
      return TINYGLTF_MODE_LINE;
    case GlbTopology::kLineStrip:
      return TINYGLTF_MODE_LINE_STRIP;
    case GlbTopology::kPoints:
      return TINYGLTF_MODE_POINTS;
    case GlbTopology::kTriangles:
      break;
  }
  return TINYGLTF_MODE_TRIANGLES;
}

const char* nameOf(GlbPath path) {
  if (path == GlbPath::kTranslation) return "translation";
  return path == GlbPath::kRotation ? "rotation" : "scale";
}

template <class Vector>
std::vector<double> listOf(const Vector& v) {
  return {v.data(), v.data() + v.size()};
}

}  // namespace

struct GlbWriter::Impl {
  tinygltf::Model model;
  std::map<std::string, int> views;  // by bytes and target
  std::map<std::tuple<int, int, int>, int> accessors;
  std::map<std::pair<std::array<float, 4>, bool>, int> materials;
  std::map<std::tuple<int, int, bool>, int> samplers;

  Impl() {
    model.asset.version = "2.0";
    model.asset.generator = "rex";
    model.scenes.resize(1);
    model.defaultScene = 0;
  }

  int viewOf(const void* data, std::size_t size, int target) {
    const std::string text(static_cast<const char*>(data), size);
    const auto [known, isNew] =
        views.try_emplace(text + std::to_string(target), static_cast<int>(model.bufferViews.size()));
    if (!isNew) return known->second;
    model.buffers.resize(1);
    std::vector<unsigned char>& all = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = all.size();
    view.byteLength = size;
    view.target = target;
    all.insert(all.end(), text.begin(), text.end());
    all.resize((all.size() + 3) / 4 * 4);
    model.bufferViews.push_back(view);
    return known->second;
  }

  // glTF requires an explicit stride if several accessors share vertices.
  int vertexViewOf(std::span<const Eigen::Vector3f> values) {
    const int view = viewOf(values.data(), values.size_bytes(), TINYGLTF_TARGET_ARRAY_BUFFER);
    model.bufferViews[view].byteStride = sizeof(Eigen::Vector3f);
    return view;
  }

  int accessorOf(int view, std::size_t count, int type, int component = TINYGLTF_COMPONENT_TYPE_FLOAT) {
    const auto [known, isNew] = accessors.try_emplace({view, static_cast<int>(count), type},
                                                      static_cast<int>(model.accessors.size()));
    if (!isNew) return known->second;
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.componentType = component;
    accessor.count = count;
    accessor.type = type;
    model.accessors.push_back(accessor);
    return known->second;
  }

  int materialOf(const Color& color, bool doubleSided) {
    const auto [known, isNew] = materials.try_emplace({{color.r, color.g, color.b, color.a}, doubleSided},
                                                      static_cast<int>(model.materials.size()));
    if (!isNew) return known->second;
    tinygltf::Material material;
    material.pbrMetallicRoughness.baseColorFactor = {linear(color.r), linear(color.g), linear(color.b),
                                                     std::clamp<double>(color.a, 0, 1)};
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.7;
    if (color.a < 1) material.alphaMode = "BLEND";
    material.doubleSided = doubleSided;
    model.materials.push_back(material);
    return known->second;
  }

  int samplerOf(int times, int values, bool stepwise) {
    std::vector<tinygltf::AnimationSampler>& all = model.animations[0].samplers;
    const auto [known, isNew] = samplers.try_emplace({times, values, stepwise}, static_cast<int>(all.size()));
    if (!isNew) return known->second;
    tinygltf::AnimationSampler sampler;
    sampler.input = times;
    sampler.output = values;
    sampler.interpolation = stepwise ? "STEP" : "LINEAR";
    all.push_back(sampler);
    return known->second;
  }
};

GlbWriter::GlbWriter() : impl_(std::make_unique<Impl>()) {}
GlbWriter::~GlbWriter() = default;

int GlbWriter::addTimes(const std::vector<float>& times) {
  const int view = impl_->viewOf(times.data(), times.size() * sizeof(float), 0);
  const int accessor = impl_->accessorOf(view, times.size(), TINYGLTF_TYPE_SCALAR);
  impl_->model.accessors[accessor].minValues = {times.front()};
  impl_->model.accessors[accessor].maxValues = {times.back()};
  return accessor;
}

int GlbWriter::addKeys(std::span<const Eigen::Vector3f> keys) {
  return impl_->accessorOf(impl_->viewOf(keys.data(), keys.size_bytes(), 0), keys.size(), TINYGLTF_TYPE_VEC3);
}

int GlbWriter::addKeys(std::span<const Eigen::Vector4f> keys) {
  return impl_->accessorOf(impl_->viewOf(keys.data(), keys.size_bytes(), 0), keys.size(), TINYGLTF_TYPE_VEC4);
}

int GlbWriter::addVertices(std::span<const Eigen::Vector3f> values, std::size_t count) {
  const int accessor = impl_->accessorOf(impl_->vertexViewOf(values), count, TINYGLTF_TYPE_VEC3);
  Eigen::Vector3f low = values[0], high = values[0];
  for (const Eigen::Vector3f& value : values.first(count)) {
    low = low.cwiseMin(value);
    high = high.cwiseMax(value);
  }
  impl_->model.accessors[accessor].minValues = listOf(low);
  impl_->model.accessors[accessor].maxValues = listOf(high);
  return accessor;
}

int GlbWriter::addIndices(const std::vector<std::uint32_t>& indices) {
  constexpr std::uint32_t kShort = 65535;  // this one itself means "start again"
  if (*std::max_element(indices.begin(), indices.end()) >= kShort) {
    const int view = impl_->viewOf(indices.data(), indices.size() * 4, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    return impl_->accessorOf(view, indices.size(), TINYGLTF_TYPE_SCALAR,
                             TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
  }
  std::vector<std::uint16_t> narrow;
  for (const std::uint32_t index : indices) narrow.push_back(static_cast<std::uint16_t>(index));
  const int view = impl_->viewOf(narrow.data(), narrow.size() * 2, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  return impl_->accessorOf(view, narrow.size(), TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
}

int GlbWriter::addMesh(const std::vector<GlbPrimitive>& primitives, const GlbExtras& extras) {
  tinygltf::Mesh mesh;
  for (const GlbPrimitive& part : primitives) {
    tinygltf::Primitive primitive;
    primitive.mode = modeOf(part.topology);
    primitive.attributes["POSITION"] = part.positions;
    if (part.normals >= 0) primitive.attributes["NORMAL"] = part.normals;
    primitive.indices = part.indices;
    primitive.material = impl_->materialOf(part.color, part.doubleSided);
    mesh.primitives.push_back(primitive);
  }
  mesh.extras = valueOf(extras);
  impl_->model.meshes.push_back(mesh);
  return static_cast<int>(impl_->model.meshes.size()) - 1;
}

int GlbWriter::addNode(const GlbNode& from) {
  tinygltf::Node node;
  node.name = from.name;
  node.mesh = from.mesh;
  if (!from.pose.p.isZero(0)) node.translation = listOf(from.pose.p);
  const Quaternion q = quaternionFromRotation(from.pose.R).normalized();
  if (q[0] < 1) node.rotation = {q[1], q[2], q[3], q[0]};
  if (from.scale != Eigen::Vector3d::Ones()) node.scale = listOf(from.scale);
  node.extras = valueOf(from.extras);
  const int index = static_cast<int>(impl_->model.nodes.size());
  impl_->model.nodes.push_back(node);
  if (from.parent < 0)
    impl_->model.scenes[0].nodes.push_back(index);
  else
    impl_->model.nodes[from.parent].children.push_back(index);
  return index;
}

int GlbWriter::addCamera(const Camera& camera, int parent) {
  tinygltf::Camera lens;
  lens.type = "perspective";
  lens.perspective.yfov = camera.verticalFov;
  lens.perspective.znear = camera.nearPlane;
  lens.perspective.zfar = camera.farPlane;
  impl_->model.cameras.push_back(lens);
  const int node = addNode({.name = "camera", .parent = parent, .pose = camera.X_WC});
  impl_->model.nodes[node].camera = static_cast<int>(impl_->model.cameras.size()) - 1;
  return node;
}

void GlbWriter::animate(int node, GlbPath path, int times, int values, bool stepwise) {
  impl_->model.animations.resize(1);
  tinygltf::AnimationChannel channel;
  channel.target_node = node;
  channel.target_path = nameOf(path);
  channel.sampler = impl_->samplerOf(times, values, stepwise);
  impl_->model.animations[0].channels.push_back(channel);
}

std::string GlbWriter::bytes() const {
  std::ostringstream stream;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&impl_->model, stream, false, true);
  return stream.str();
}

}  // namespace rex::internal
