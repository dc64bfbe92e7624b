#include "cli/robot/contact_limit.h"

#include <vector>

#include <fmt/format.h>

#include "cli/wrong_use_internal.h"
#include "collision/collision_pairs.h"

namespace rex::cli {
namespace {

std::size_t pairsOfBodies(const Model& model) {
  std::vector<std::size_t> onBody(model.bodies().size());
  std::size_t all = 0, pairs = 0;
  for (const ModelShape& shape : model.shapes())
    if (shape.contact) pairs += all++ - onBody[static_cast<std::size_t>(shape.body)]++;
  return pairs;
}

}  // namespace

ContactModel contactModelOf(const Model& model) {
  if (const std::size_t pairs = pairsOfBodies(model); pairs > kMostContactPairs)
    throw UsageError({.what = harmless(model.name()) + ": too many shapes take part in contacts",
                      .found = fmt::format("{} pairs of shapes", pairs),
                      .wanted = fmt::format("at most {}", kMostContactPairs)});
  return asWrongUse([&] {
    noteCollisionWarnings(model);
    return ContactModel(model);
  });
}

void noteCollisionWarnings(const Model& model) {
  for (const Diagnostic& one : collisionWarnings(model)) note(wrap(harmless(toString(one)), 2, 0));
}

}  // namespace rex::cli
