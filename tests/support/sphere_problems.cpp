#include "support/sphere_problems.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text_file.h"
#include "geometry/rotation.h"
#include "planning/robot_problem.h"

namespace rex {
namespace {

using Json = nlohmann::json;

// Part of a file, and its name in messages.
struct Item {
  const std::filesystem::path& file;
  std::string name;
  const Json& json;

  [[noreturn]] void fail(const std::string& key, std::string found, std::string wanted) const {
    throw Error({.what = name.empty()  ? key
                         : key.empty() ? name
                                       : fmt::format("{}: {}", name, key),
                 .where = {.file = file.string()},
                 .found = std::move(found),
                 .wanted = std::move(wanted)});
  }
  const Json& at(const char* key, const char* wanted) const {
    if (!json.is_object()) fail("", json.type_name(), "an object");
    const auto found = json.find(key);
    if (found == json.end()) fail(fmt::format("'{}'", key), "nothing", wanted);
    return *found;
  }
  std::string text(const char* key) const {
    const Json& value = at(key, "a text");
    if (!value.is_string()) fail(fmt::format("'{}'", key), value.dump(), "a text");
    return value.get<std::string>();
  }
  const Json& list(const char* key) const {
    const Json& value = at(key, "a list");
    if (!value.is_array()) fail(fmt::format("'{}'", key), value.dump(), "a list");
    return value;
  }
  double length(const char* key) const {
    const Json& value = at(key, "a positive number of metres");
    if (!value.is_number() || !(value.get<double>() > 0))
      fail(fmt::format("'{}'", key), value.dump(), "a positive number of metres");
    return value.get<double>();
  }
  Eigen::VectorXd numbers(const char* key, int count) const {
    const std::string wanted = fmt::format("{} numbers", count);
    const Json& value = at(key, wanted.c_str());
    const auto isNumber = [](const Json& one) { return one.is_number(); };
    if (!value.is_array() || !std::all_of(value.begin(), value.end(), isNumber))
      fail(fmt::format("'{}'", key), value.dump(), wanted);
    if (value.size() != static_cast<std::size_t>(count))
      fail(fmt::format("'{}'", key), fmt::format("{} numbers", value.size()), wanted);
    Eigen::VectorXd result(count);
    for (int i = 0; i < count; ++i) result[i] = value[static_cast<std::size_t>(i)].get<double>();
    return result;
  }
};

ShapeSpec obstacleOf(const Item& item) {
  ShapeSpec obstacle{.name = item.text("id"), .X_BS = {}, .shape = {}, .contact = true};
  const Item named{item.file, fmt::format("{}: object '{}'", item.name, obstacle.name), item.json};
  const Eigen::VectorXd w = named.numbers("quat_wxyz", 4);
  if (w.norm() < 1e-6) named.fail("'quat_wxyz'", "a quaternion of length zero", "a rotation");
  obstacle.X_BS = {rotationFromQuaternion(Quaternion(w)), named.numbers("position", 3)};
  const std::string type = named.text("type");
  Shape& shape = obstacle.shape;
  if (type == "box") {
    shape.type = ShapeType::kBox;
    shape.extent = named.numbers("size", 3);
    if (!(shape.extent.minCoeff() > 0)) named.fail("'size'", named.at("size", "").dump(), "positive numbers");
    return obstacle;
  }
  if (type != "sphere" && type != "cylinder" && type != "capsule")
    named.fail("'type'", fmt::format("'{}'", type), "'box', 'sphere', 'cylinder' or 'capsule'");
  shape.type = type == "sphere"     ? ShapeType::kSphere
               : type == "cylinder" ? ShapeType::kCylinder
                                    : ShapeType::kCapsule;
  shape.radius = named.length("radius");
  if (type != "sphere") shape.extent.z() = named.length("height");
  return obstacle;
}

void readFile(const std::filesystem::path& file, int coordinates, std::vector<SphereProblem>& problems) {
  const Json json = Json::parse(readTextFile(file), nullptr, false);
  if (json.is_discarded())
    throw Error(
        {.what = "problem file", .where = {.file = file.string()}, .found = "no JSON", .wanted = "JSON"});
  const Item whole{file, "", json};
  const std::string set = whole.text("set");
  int number = 0;
  for (const Json& one : whole.list("problems")) {
    const Item unnamed{file, fmt::format("problem {}", ++number), one};
    const Item item{file, fmt::format("problem '{}'", unnamed.text("name")), one};
    SphereProblem problem{
        set, item.text("name"), item.numbers("start", coordinates), item.numbers("goal", coordinates), {}};
    int count = 0;
    for (const Json& object : item.list("objects"))
      problem.obstacles.push_back(
          obstacleOf({file, fmt::format("{}: object {}", item.name, ++count), object}));
    problems.push_back(std::move(problem));
  }
}

SceneSpec withObstacles(SceneSpec robot, const std::vector<ShapeSpec>& obstacles) {
  for (ShapeSpec obstacle : obstacles) {
    obstacle.contact = true;
    robot.worldShapes.push_back(std::move(obstacle));
  }
  return robot;
}

bool isMoved(const Model& model, BodyId body) {
  for (; body != kWorld; body = model[body].parent)
    if (model[body].joint != kNoJoint && model[model[body].joint].nv > 0) return true;
  return false;
}

// The indices of the robot's shapes are the same with and without obstacles, up to where those of the world
// come in.
std::vector<ShapePair> pairsOf(const SceneSpec& robot, const Model& model) {
  std::vector<int> ofRobot, obstacles;
  for (int i = 0; i < static_cast<int>(model.shapes().size()); ++i)
    (model.shapes()[static_cast<std::size_t>(i)].body == kWorld ? obstacles : ofRobot).push_back(i);
  std::vector<ShapePair> pairs;
  const auto add = [&](int a, int b) { pairs.push_back({std::min(a, b), std::max(a, b)}); };
  for (const ShapePair& pair : collidingPairs(compile(robot)))
    add(ofRobot[static_cast<std::size_t>(pair.a)], ofRobot[static_cast<std::size_t>(pair.b)]);
  for (const int i : ofRobot) {
    const ModelShape& shape = model.shapes()[static_cast<std::size_t>(i)];
    if (!shape.contact || !isMoved(model, shape.body)) continue;
    for (const int obstacle : obstacles) add(i, obstacle);
  }
  return pairs;
}

}  // namespace

std::vector<std::filesystem::path> sphereProblemFiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty())
    throw Error({.what = "problems",
                 .where = {.file = folder.string()},
                 .found = std::filesystem::exists(folder) ? "no .json file" : "no such folder",
                 .wanted = "a folder of problem files"});
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<SphereProblem> readSphereProblems(const std::filesystem::path& folder, int coordinates) {
  std::vector<SphereProblem> problems;
  for (const std::filesystem::path& file : sphereProblemFiles(folder)) readFile(file, coordinates, problems);
  return problems;
}

SceneSpec readSphereRobot(const std::filesystem::path& urdf, const std::filesystem::path& srdf) {
  SceneSpec robot = readScene(urdf, {.allowMissingMeshes = true, .srdf = srdf}).spec;
  if (!robot.worldShapes.empty())
    throw Error({.what = "robot",
                 .where = {.file = urdf.string()},
                 .found = "shapes fixed to the world itself",
                 .wanted = "a base link that carries them"});
  for (BodySpec& body : robot.bodies) {
    std::erase_if(body.shapes, [](const ShapeSpec& shape) { return !shape.contact; });
    for (const ShapeSpec& shape : body.shapes)
      if (!shape.meshFile.empty())
        throw Error({.what = fmt::format("collision shape of '{}'", body.name),
                     .where = {.file = urdf.string()},
                     .found = fmt::format("mesh '{}'", shape.meshFile),
                     .wanted = "spheres"});
  }
  return robot;
}

ExactJudge::ExactJudge(const SceneSpec& robot, const std::vector<ShapeSpec>& obstacles)
    : model_(compile(withObstacles(robot, obstacles))), contacts_(model_, pairsOf(robot, model_)) {}

std::string ExactJudge::faultOf(const VectorArg& q) const {
  for (int i = 0; i < model_.nq(); ++i)
    if (!(q[i] >= model_.lowerLimits()[i] && q[i] <= model_.upperLimits()[i]))
      return fmt::format("coordinate {} is {:.6g}, outside its limits {:.6g} and {:.6g}", i, q[i],
                         model_.lowerLimits()[i], model_.upperLimits()[i]);
  const ClearanceBounds bounds = clearanceBounds(model_, contacts_, q, q, 1e-7);
  return bounds.atLeast >= 0 ? "" : nearestContact(model_, contacts_, q);
}

std::string ExactJudge::faultOf(const MatrixArg& path, const VectorArg& start, const VectorArg& goal) const {
  if (path.cols() < 2 || path.col(0) != start || path.col(path.cols() - 1) != goal)
    return "the path does not lead from start to goal";
  for (Eigen::Index k = 0; k < path.cols(); ++k)
    if (const std::string fault = faultOf(VectorArg(path.col(k))); !fault.empty())
      return fmt::format("posture {} of the path: {}", k + 1, fault);
  const Space space = Space::box(model_.lowerLimits(), model_.upperLimits());
  ClearanceBounds bounds;
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    bounds = pathClearance(model_, contacts_, space, path, tolerance);
    if (bounds.atLeast >= 0) return "";
    if (bounds.atMost < 0) break;
  }
  return fmt::format("the clearance of the path is between {:.3g} and {:.3g} m", bounds.atLeast,
                     bounds.atMost);
}

}  // namespace rex
