#include "collision/contact_model.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "collision/collision_pairs.h"
#include "collision/contact_data_internal.h"

namespace rex {
namespace {

void requirePair(const Model& model, const ShapePair& pair) {
  const int count = static_cast<int>(model.shapes().size());
  if (0 <= pair.a && pair.a < pair.b && pair.b < count) return;
  throw Error({.what = fmt::format("scene '{}': pair of shapes in contact", model.name()),
               .found = fmt::format("({}, {})", pair.a, pair.b),
               .wanted = fmt::format("0 <= a < b < {}", count)});
}

// The solid of a shape, which is added on first use.
int solidOf(ContactModel::Data& data, const Model& model, int place) {
  int& solid = data.solidOf[static_cast<std::size_t>(place)];
  if (solid >= 0) return solid;
  solid = static_cast<int>(data.solids.size());
  const ModelShape& shape = model.shapes()[static_cast<std::size_t>(place)];
  internal::requireSolid(
      fmt::format("scene '{}': shape '{}' of body '{}'", model.name(), shape.name, model[shape.body].name),
      shape.shape);
  const internal::Core core = internal::coreOf(shape.shape);
  data.solids.push_back({place, shape.body, shape.X_BS, shape.shape, core, halfBounds(shape.shape).norm()});
  const Pose& X_BS = shape.X_BS;
  data.X_BS.insert(data.X_BS.end(), X_BS.R.data(), X_BS.R.data() + 9);
  data.X_BS.insert(data.X_BS.end(), X_BS.p.data(), X_BS.p.data() + 3);
  for (const double number : {core.half.x(), core.half.y(), core.half.z(), core.radius})
    data.sizes.insert(data.sizes.end(), internal::kContactLanes, number);
  return solid;
}

// Adds a pair to those of its kind; kernels expect segments before boxes.
void addPair(ContactModel::Data& data, int row, int a, int b) {
  const auto& solids = data.solids;
  const auto solid = [&](int i) -> const ContactSolid& { return solids[static_cast<std::size_t>(i)]; };
  const double reach = solid(a).reach + solid(b).reach;
  const auto [first, last] = std::minmax(solid(a).core.type, solid(b).core.type);
  if (last == internal::CoreType::kOther) {
    data.others.push_back({a, b, row, reach});
  } else {
    if (solid(a).core.type != first) std::swap(a, b);
    data.cores[static_cast<std::size_t>(first) + static_cast<std::size_t>(last)].push_back(
        {a, b, row, reach});
  }
}

}  // namespace

ContactModel::ContactModel(const Model& model) : ContactModel(model, collidingPairs(model)) {}

ContactModel::ContactModel(const Model& model, std::span<const ShapePair> pairs) {
  auto data = std::make_shared<Data>();
  data->pairs.assign(pairs.begin(), pairs.end());
  data->solidOf.assign(model.shapes().size(), -1);
  for (std::size_t row = 0; row < pairs.size(); ++row) {
    requirePair(model, pairs[row]);
    const int a = solidOf(*data, model, pairs[row].a), b = solidOf(*data, model, pairs[row].b);
    addPair(*data, static_cast<int>(row), a, b);
  }
  data_ = std::move(data);
}

std::span<const ShapePair> ContactModel::pairs() const { return data_->pairs; }

BodyId ContactModel::body(int shape) const {
  const int solid = data_->solidOf[static_cast<std::size_t>(shape)];
  assert(solid >= 0 && "the shape takes no part");
  return data_->solids[static_cast<std::size_t>(solid)].body;
}

}  // namespace rex
