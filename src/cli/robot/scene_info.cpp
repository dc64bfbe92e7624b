#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "cli/results_internal.h"
#include "cli/robot/scene_verbs.h"
#include "cli/robot/simulation.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

// "q3", "q3..q5", or the rule by which the joint mimics another.
std::string coordinatesOf(const Joint& joint) {
  if (joint.nq == 0) return "rigid";
  const std::string last = joint.nq > 1 ? fmt::format("..q{}", joint.qIndex + joint.nq - 1) : "";
  const std::string own = fmt::format("q{}{}", joint.qIndex, last);
  if (!joint.mimics || (joint.ratio == 1 && joint.offset == 0)) return joint.mimics ? "as " + own : own;
  const std::string offset = joint.offset == 0 ? "" : fmt::format(" {:+g}", joint.offset);
  return fmt::format("{:g} {}{}", joint.ratio, own, offset);
}

// "2 mesh, box" of the shapes that are `chosen`.
std::string typesOf(const std::vector<const ModelShape*>& shapes, bool ModelShape::*chosen) {
  std::vector<std::pair<std::string, int>> counts;
  for (const ModelShape* shape : shapes) {
    if (!(shape->*chosen)) continue;
    const std::string type(toString(shape->shape.type));
    const auto known =
        std::find_if(counts.begin(), counts.end(), [&](auto& one) { return one.first == type; });
    known == counts.end() ? counts.emplace_back(type, 1).second : ++known->second;
  }
  std::vector<std::string> texts;
  for (const auto& [type, count] : counts)
    texts.push_back(count == 1 ? type : fmt::format("{} {}", count, type));
  return join(texts, ", ");
}

std::vector<std::vector<BodyId>> childrenOf(const Model& model) {
  std::vector<std::vector<BodyId>> children(model.bodies().size());
  for (std::size_t b = 1; b < model.bodies().size(); ++b)
    children[static_cast<std::size_t>(model.bodies()[b].parent)].push_back(BodyId{static_cast<int>(b)});
  return children;
}

// Deep in a long chain, a number shows the depth instead of more blanks.
std::string indented(const std::string& name, std::size_t depth) {
  constexpr std::size_t kDeepest = 12;
  if (depth <= kDeepest) return std::string(2 * depth, ' ') + name;
  return std::string(2 * kDeepest, ' ') + fmt::format("({}) {}", depth, name);
}

void sayTree(const Model& model) {
  const std::vector<std::vector<BodyId>> children = childrenOf(model);
  std::vector<std::pair<BodyId, std::size_t>> waiting = {{kWorld, 0}};
  Table table;
  table.add({"body", "kg", "joint", "coordinates"});
  while (!waiting.empty()) {
    const auto [id, depth] = waiting.back();
    waiting.pop_back();
    const Body& body = model[id];
    const bool hangs = body.joint != kNoJoint;
    table.add({indented(escapeForTerminal(body.name), depth),
               body.mass == 0 ? "-" : fmt::format("{:.4g}", body.mass),
               hangs ? escapeForTerminal(model[body.joint].name) : "-",
               hangs ? coordinatesOf(model[body.joint]) : "-"});
    const auto& below = children[static_cast<std::size_t>(id)];
    for (auto child = below.rbegin(); child != below.rend(); ++child) waiting.emplace_back(*child, depth + 1);
  }
  say(table.text());
}

void sayCoordinates(const Model& model) {
  Table table;
  table.add({"q", "joint", "type", "start", "low", "high"});
  for (const Joint& joint : model.joints()) {
    if (joint.mimics) continue;
    for (int i = 0; i < joint.nq; ++i) {
      const int at = joint.qIndex + i;
      const auto limit = [](double value) {
        return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("-");
      };
      table.add({std::to_string(at), i == 0 ? escapeForTerminal(joint.name) : "",
                 i == 0 ? std::string(toString(joint.type)) : "",
                 fmt::format("{:.4g}", model.initialPositions()[at]), limit(model.lowerLimits()[at]),
                 limit(model.upperLimits()[at])});
    }
  }
  say(table.text());
}

void sayPostures(const Model& model) {
  std::vector<std::string> names;
  for (const NamedPosture& one : model.postures()) names.push_back(escapeForTerminal(one.name));
  say(wrap("postures for --q: " + join(names, ", "), 2, 0));
}

void sayShapes(const Model& model) {
  std::vector<std::vector<const ModelShape*>> shapes(model.bodies().size());
  for (const ModelShape& shape : model.shapes())
    shapes[static_cast<std::size_t>(shape.body)].push_back(&shape);
  Table table;
  table.add({"body", "drawn", "in contact"});
  for (std::size_t b = 0; b < shapes.size(); ++b) {
    const std::string drawn = typesOf(shapes[b], &ModelShape::visible);
    const std::string contact = typesOf(shapes[b], &ModelShape::contact);
    if (drawn.empty() && contact.empty()) continue;
    table.add({escapeForTerminal(model.bodies()[b].name), drawn.empty() ? "-" : drawn,
               contact.empty() ? "-" : contact});
  }
  say(table.text());
}

void sayPins(const Model& model) {
  const Eigen::VectorXd gaps = loopClosureErrors(model, model.initialPositions());
  Table table;
  table.add({"pin", "at", "to", "at", "gap at the start, m"});
  const auto point = [](const Eigen::Vector3d& p) {
    return fmt::format("{:.4g} {:.4g} {:.4g}", p.x(), p.y(), p.z());
  };
  for (Eigen::Index i = 0; i < gaps.size(); ++i) {
    const Pin& pin = model.pins()[static_cast<std::size_t>(i)];
    table.add({escapeForTerminal(model[pin.a].name), point(pin.p_AP), escapeForTerminal(model[pin.b].name),
               point(pin.p_BQ), fmt::format("{:.2g}", gaps[i])});
  }
  say(table.text());
}

// For a joint that mimics another: which one, and how.
Json mimicOf(const Model& model, const Joint& joint) {
  if (!joint.mimics) return {};
  const auto target = std::find_if(model.joints().begin(), model.joints().end(), [&](const Joint& other) {
    return !other.mimics && other.nq > 0 && other.qIndex == joint.qIndex;
  });
  return {{"joint", target->name}, {"ratio", joint.ratio}, {"offset", joint.offset}};
}

Json infoOf(const Model& model) {
  Json joints = Json::array(), bodies = Json::array(), masses = Json::array(), shapes = Json::array();
  for (const Joint& joint : model.joints()) {
    Json& one = joints.emplace_back(Json{{"name", joint.name},
                                         {"from", model[joint.parent].name},
                                         {"to", model[joint.child].name},
                                         {"type", toString(joint.type)},
                                         {"q_index", joint.qIndex},
                                         {"dim", joint.nq},
                                         {"mimics", mimicOf(model, joint)}});
    if (joint.nq == 0) continue;
    one["low"] = toJson(model.lowerLimits().segment(joint.qIndex, joint.nq));
    one["high"] = toJson(model.upperLimits().segment(joint.qIndex, joint.nq));
  }
  for (const BodyId id : model.bodiesInFileOrder()) {
    bodies.push_back(model[id].name);
    masses.push_back(model[id].mass);
  }
  for (const ModelShape& shape : model.shapes())
    shapes.push_back({{"name", shape.name},
                      {"body", model[shape.body].name},
                      {"type", toString(shape.shape.type)},
                      {"contact", shape.contact},
                      {"visible", shape.visible}});
  Json pins = Json::array();
  const Eigen::VectorXd gaps = loopClosureErrors(model, model.initialPositions());
  for (Eigen::Index i = 0; i < gaps.size(); ++i) {
    const Pin& pin = model.pins()[static_cast<std::size_t>(i)];
    pins.push_back({{"a", model[pin.a].name},
                    {"p_AP", toJson(pin.p_AP)},
                    {"b", model[pin.b].name},
                    {"p_BQ", toJson(pin.p_BQ)},
                    {"gap", gaps[i]}});
  }
  Json postures = Json::object();
  for (const NamedPosture& one : model.postures()) postures[one.name] = toJson(one.q);
  return {{"ndof", model.nv()},    {"nq", model.nq()}, {"q", toJson(model.initialPositions())},
          {"postures", postures},  {"joints", joints}, {"bodies", bodies},
          {"body_masses", masses}, {"shapes", shapes}, {"pins", pins},
          {"mass", model.mass()}};
}

}  // namespace

ExitCode sceneInfo(const Project& project, const SceneOptions& options) {
  const Model model = loadScene(project, options.scene);
  if (options.json) {
    say(dump(infoOf(model)));
    return ExitCode::kFull;
  }
  const auto count = [](std::size_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
  };
  say(paint(Colour::kBold, escapeForTerminal(model.name())) +
      fmt::format(": {}, {}, {}, {}, {:.6g} kg", count(model.bodies().size() - 1, "body", "bodies"),
                  count(model.joints().size(), "joint", "joints"),
                  count(static_cast<std::size_t>(model.nv()), "degree of freedom", "degrees of freedom"),
                  count(model.shapes().size(), "shape", "shapes"), model.mass()));
  say();
  sayTree(model);
  if (model.nq() > 0) {
    say();
    sayCoordinates(model);
  }
  if (!model.postures().empty()) {
    say();
    sayPostures(model);
  }
  if (!model.pins().empty()) {
    say();
    sayPins(model);
  }
  if (!model.shapes().empty()) {
    say();
    sayShapes(model);
  }
  return ExitCode::kFull;
}

}  // namespace rex::cli
