#include "live/live_scene.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/error.h"
#include "base/text.h"
#include "geometry/rotation.h"
#include "render/glb.h"
#include "render/picture.h"
#include "scene/state.h"

namespace rex {
namespace {

std::size_t uint32At(const std::string& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

}  // namespace

LivePieces splitGlb(const std::string& glb) {
  constexpr std::size_t kHeader = 12, kChunk = 8;  // bytes before a file and before a chunk
  const std::size_t length = uint32At(glb, kHeader), binary = kHeader + kChunk + length + kChunk;
  LivePieces result{.json = glb.substr(kHeader + kChunk, length)};
  const nlohmann::json all = nlohmann::json::parse(result.json);
  for (const nlohmann::json& view : all.value("bufferViews", nlohmann::json::array())) {
    const std::size_t at = view.value("byteOffset", std::size_t{0});
    std::string bytes = glb.substr(binary + at, view.at("byteLength").get<std::size_t>());
    assert(!bytes.empty());
    std::string name = fmt::format("piece-{:016x}-{}", std::hash<std::string>()(bytes), bytes.size());
    result.pieces.push_back({at, std::move(name), std::move(bytes)});
  }
  return result;
}

namespace {

using LiveJson = nlohmann::ordered_json;

bool isDrawable(const ModelShape& shape) {
  return shape.color[3] > 0 && !(usesMesh(shape.shape.type) && shape.shape.mesh.isEmpty());
}

LiveJson poseJson(const Pose& pose) {
  const Quaternion r = quaternionFromRotation(pose.R);
  return {pose.p.x(), pose.p.y(), pose.p.z(), r[1], r[2], r[3], r[0]};
}

LiveJson limitJson(double limit) { return std::isfinite(limit) ? LiveJson(limit) : LiveJson(); }

// Of the i-th coordinate of a joint.
const char* unitOf(const Joint& joint, int i) {
  if (joint.type == JointType::kFree) return i < 3 ? "m" : "";
  if (joint.nq != joint.nv) return "";
  return joint.freedoms[static_cast<std::size_t>(i)].angular.isZero() ? "m" : "rad";
}

LiveJson coordinatesJson(const Model& model) {
  const std::vector<std::string> names = positionNames(model);
  LiveJson all = LiveJson::array();
  for (int i = 0; i < model.nq(); ++i)
    all.push_back({{"name", names[static_cast<std::size_t>(i)]},
                   {"low", limitJson(model.lowerLimits()[i])},
                   {"high", limitJson(model.upperLimits()[i])}});
  for (const Joint& joint : model.joints()) {
    if (joint.mimics) continue;
    for (int i = 0; i < joint.nq; ++i) {
      LiveJson& one = all[static_cast<std::size_t>(joint.qIndex + i)];
      one["unit"] = unitOf(joint, i);
      one["turns"] = joint.nq != joint.nv && !(joint.type == JointType::kFree && i < 3);
    }
  }
  return all;
}

}  // namespace

std::string liveGlb(const Model& model, const BodyPoses& poses) {
  Picture picture;
  Picture visible = scenePicture(model, poses);
  picture.ground = visible.ground;
  picture.ground.scene = bounds(visible);
  for (std::size_t i = 0; i < model.shapes().size(); ++i) {
    const ModelShape& shape = model.shapes()[i];
    if (!isDrawable(shape)) continue;
    const Eigen::Vector4f c = shape.color.cast<float>();
    picture.solids.push_back({.shape = shape.shape,
                              .X_WS = poses[shape.body] * shape.X_BS,
                              .color = {c[0], c[1], c[2], c[3]},
                              .name = fmt::format("s{}", i)});
  }
  if (picture.solids.empty())
    throw Error({.what = model.name(), .found = "no shape", .wanted = "something to see"});
  return toGlb({{.picture = std::move(picture)}});
}

std::string liveDescription(const Model& model) {
  LiveJson bodies = LiveJson::array(), shapes = LiveJson::array();
  for (const Body& body : model.bodies())
    bodies.push_back({{"name", body.name}, {"mass", body.mass}, {"moves", body.joint != kNoJoint}});
  bool anyVisible = false;
  for (const ModelShape& shape : model.shapes()) anyVisible |= shape.visible && isDrawable(shape);
  for (const ModelShape& shape : model.shapes())
    shapes.push_back({{"name", shape.name},
                      {"body", static_cast<int>(shape.body)},
                      {"pose", poseJson(shape.X_BS)},
                      {"drawn", isDrawable(shape)},
                      {"visible", shape.visible || !anyVisible},
                      {"contact", shape.contact}});
  LiveJson postures = LiveJson::array();
  for (const NamedPosture& one : model.postures()) postures.push_back(one.name);
  const bool isOrs = endingOf(model.name()) == ".ors";
  const LiveJson all = {{"kind", "robot"},      {"title", model.name()},
                        {"mass", model.mass()}, {"bodies", bodies},
                        {"shapes", shapes},     {"coordinates", coordinatesJson(model)},
                        {"postures", postures}, {"front", isOrs ? LiveJson{0, -1} : LiveJson{1, 0}}};
  return all.dump(-1, ' ', false, LiveJson::error_handler_t::replace);
}

std::string posesText(const BodyPoses& poses) {
  std::string bytes;
  const auto add = [&](double value) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
  };
  for (const Pose& pose : poses.X_WB) {
    const Quaternion r = quaternionFromRotation(pose.R);
    for (const double value : {pose.p.x(), pose.p.y(), pose.p.z(), r[1], r[2], r[3], r[0]}) add(value);
  }
  return base64(bytes);
}

}  // namespace rex
