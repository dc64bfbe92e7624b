#include "cli/robot/start_overlaps.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "cli/terminal.h"
#include "collision/proxy_report.h"

namespace rex::cli {

std::vector<BodyOverlap> startOverlaps(const Model& model, const PhysicsOptions& options,
                                       const State& start) {
  PhysicsWorld world(model, options);
  world.setState(start);
  const auto nameOf = [&](int shape) {
    const BodyId body = model.shapes()[static_cast<std::size_t>(shape)].body;
    return body == kWorld ? shapeLabel(model, shape) : model[body].name;
  };
  std::map<std::pair<std::string, std::string>, double> depths;
  for (const PhysicsContact& contact : world.overlaps()) {
    double& depth = depths[{nameOf(contact.shapeA), nameOf(contact.shapeB)}];
    depth = std::max(depth, -contact.distance);
  }
  std::vector<BodyOverlap> overlaps;
  for (const auto& [pair, depth] : depths) overlaps.push_back({pair.first, pair.second, depth});
  std::ranges::stable_sort(overlaps, std::greater(), &BodyOverlap::depth);
  return overlaps;
}

std::string toString(const std::vector<BodyOverlap>& overlaps) {
  constexpr std::size_t kMost = 12;
  std::string text = fmt::format("{} pair{}: ", overlaps.size(), overlaps.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(overlaps.size(), kMost); ++i)
    text += fmt::format("{}'{}' and '{}' by {:.3g} m", i == 0 ? "" : ", ", harmless(overlaps[i].a),
                        harmless(overlaps[i].b), overlaps[i].depth);
  if (overlaps.size() > kMost) text += fmt::format(" and {} more", overlaps.size() - kMost);
  return text;
}

}  // namespace rex::cli
