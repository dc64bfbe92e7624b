#include "scene/pose_text.h"

#include <fmt/format.h>

#include "scene/ors_graph_internal.h"

namespace rex {

Pose parsePose(std::string_view text, const std::string& name) {
  constexpr const char* kWanted = "one pose <T ...>";
  const ors::Document document = ors::parseGraph(text, name);
  const ors::Graph& graph = document.nodes;
  if (graph.empty())
    throw Error({.what = "not a pose", .where = {name, 1, 1}, .found = "nothing", .wanted = kWanted});
  const ors::Node& node = graph.front();
  const Pose* pose = std::get_if<Pose>(&node.value);
  if (!pose || !node.keys.empty() || !node.parents.empty())
    throw Error(
        {.what = "not a pose",
         .where = node.where,
         .found = node.keys.empty() ? ors::describe(node.value) : fmt::format("'{}'", node.keys.front().text),
         .wanted = kWanted});
  if (graph.size() > 1)
    throw Error({.what = "text after a pose", .where = graph[1].where, .wanted = kWanted});
  return *pose;
}

}  // namespace rex
