#include "collision/contact_model.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "collision/contact_data_internal.h"

namespace rex {
namespace {

// A body and its next ancestors, the world left out: it is nobody's kin.
std::vector<BodyId> kin(const Model& model, BodyId body) {
  constexpr std::size_t kGenerations = 4;
  std::vector<BodyId> line;
  for (BodyId at = body; at != kWorld && line.size() <= kGenerations; at = model[at].parent)
    line.push_back(at);
  return line;
}

bool hasJointTo(const Model& model, BodyId child, BodyId parent) {
  if (model[child].parent != parent || model[child].joint == kNoJoint) return false;
  return parent != kWorld || model[model[child].joint].type != JointType::kFree;
}

bool mayCollide(const Model& model, BodyId a, BodyId b) {
  if (a == b || hasJointTo(model, a, b) || hasJointTo(model, b, a)) return false;
  const std::vector<BodyId> kinOfA = kin(model, a), kinOfB = kin(model, b);
  return std::find_first_of(kinOfA.begin(), kinOfA.end(), kinOfB.begin(), kinOfB.end()) == kinOfA.end();
}

std::vector<ShapePair> pairsInContact(const Model& model) {
  std::vector<ShapePair> pairs;
  const auto collides = [&](int i) {
    const ModelShape& shape = model.shapes()[static_cast<std::size_t>(i)];
    return shape.contact && shape.shape.type != ShapeType::kMarker;
  };
  const auto bodyOf = [&](int i) { return model.shapes()[static_cast<std::size_t>(i)].body; };
  const int count = static_cast<int>(model.shapes().size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b)
      if (collides(a) && collides(b) && mayCollide(model, bodyOf(a), bodyOf(b))) pairs.push_back({a, b});
  }
  return pairs;
}

ContactShape contactShape(const Model& model, const ModelShape& shape) {
  internal::requireSolid(
      fmt::format("scene '{}': shape '{}' of body '{}'", model.name(), shape.name, model[shape.body].name),
      shape.shape);
  return {shape.body, shape.X_BS, shape.shape, internal::coreOf(shape.shape), halfBounds(shape.shape).norm()};
}

}  // namespace

ContactModel::ContactModel(const Model& model) : ContactModel(model, pairsInContact(model)) {}

ContactModel::ContactModel(const Model& model, std::span<const ShapePair> pairs) {
  const int count = static_cast<int>(model.shapes().size());
  auto data = std::make_shared<Data>();
  data->shapes.resize(model.shapes().size());
  data->pairs.assign(pairs.begin(), pairs.end());
  for (const ShapePair& pair : pairs) {
    if (pair.a < 0 || pair.a >= pair.b || pair.b >= count) {
      throw Error({.what = fmt::format("scene '{}': pair of shapes in contact", model.name()),
                   .found = fmt::format("({}, {})", pair.a, pair.b),
                   .wanted = fmt::format("0 <= a < b < {}", count)});
    }
    for (const int i : {pair.a, pair.b}) {
      const auto place = static_cast<std::size_t>(i);
      data->shapes[place] = contactShape(model, model.shapes()[place]);
    }
  }
  data_ = std::move(data);
}

std::span<const ShapePair> ContactModel::pairs() const { return data_->pairs; }

BodyId ContactModel::body(int shape) const { return data_->shapes[static_cast<std::size_t>(shape)].body; }

}  // namespace rex
