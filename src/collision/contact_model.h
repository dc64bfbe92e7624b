#pragma once

#include <memory>
#include <span>
#include <vector>

#include "scene/model.h"

namespace rex {

/// Two shapes, as indices of Model::shapes(), a < b.
struct ShapePair {
  int a, b;
  bool operator==(const ShapePair&) const = default;
};

/// The pairs of shapes of a model that may collide, sorted for fast queries. It copies the data it needs;
/// copies of it share them.
class ContactModel {
 public:
  /// The pairs of shapes that may collide, see collidingPairs(). Markers never collide. Throws Error for a
  /// shape whose mesh is not loaded.
  explicit ContactModel(const Model& model);
  /// The given pairs. Throws Error for an invalid pair of indices, a marker, and a mesh that is not loaded.
  ContactModel(const Model& model, std::span<const ShapePair> pairs);

  [[nodiscard]] std::span<const ShapePair> pairs() const;
  /// The body of a shape that occurs in a pair.
  [[nodiscard]] BodyId body(int shape) const;

  struct Data;
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace rex
