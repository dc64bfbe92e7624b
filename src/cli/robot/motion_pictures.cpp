#include "cli/robot/motion_pictures.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/error.h"
#include "base/interruption.h"
#include "render/scene_picture.h"

namespace rex::cli {
namespace {

BodyId tracedBody(const Model& model, const std::string& name) {
  try {
    return model.body(name);
  } catch (const Error& error) {
    ErrorParts parts = error.parts();
    parts.what = "--trace: " + parts.what;
    throw UsageError(std::move(parts));
  }
}

}  // namespace

MotionPictures::MotionPictures(const Model& model, const Motion& motion,
                               const std::vector<std::size_t>& shown, const std::vector<std::string>& traces,
                               std::string caption)
    : model_(model), motion_(motion), shown_(shown), ways_(traces.size()), caption_(std::move(caption)) {
  std::vector<BodyId> traced;
  for (const std::string& name : traces) traced.push_back(tracedBody(model_, name));
  if (!traced.empty()) {
    for (const Eigen::VectorXd& q : motion_.postures) {
      const BodyPoses poses = forwardKinematics(model_, q);
      for (std::size_t k = 0; k < traced.size(); ++k) ways_[k].push_back(poses[traced[k]].p);
    }
  }
  double lowest = 0;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    throwIfInterrupted();
    const Bounds box = rex::bounds(solidsAt(i));
    if (box.isEmpty()) continue;
    lowest = std::min(lowest, box.low.z());
    bounds_.include(box.low);
    bounds_.include(box.high);
  }
  ground_ = groundHeight(model_, forwardKinematics(model_, model_.initialPositions())).value_or(lowest);
  for (const auto& way : ways_)
    for (const Eigen::Vector3d& point : way) bounds_.include(point);
}

// Not by pictureOf(): it visits every vertex to find the height of the ground, which is known here.
Picture MotionPictures::solidsAt(std::size_t i) const {
  return {.solids = solidsOf(model_, forwardKinematics(model_, motion_.postures[shown_[i]]))};
}

Picture MotionPictures::picture(std::size_t i) const {
  Picture picture = solidsAt(i);
  picture.ground.height = ground_;
  picture.ground.scene = bounds_;
  if (!caption_.empty()) picture.captions.push_back({.text = caption_});
  if (shown_[i] == 0) return picture;
  for (const auto& way : ways_)
    picture.polylines.push_back(
        {.points = {way.begin(), way.begin() + static_cast<std::ptrdiff_t>(shown_[i]) + 1}});
  return picture;
}

Film MotionPictures::film() const {
  Film film;
  for (std::size_t i = 0; i < size(); ++i) film.push_back({time(i), picture(i)});
  return film;
}

}  // namespace rex::cli
