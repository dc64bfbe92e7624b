#include "course/film.h"

#include <algorithm>
#include <cmath>

#include "course/recording.h"
#include "course/simulator.h"
#include "render/scene_picture.h"

namespace rex {
namespace {

const Color kTraceColor{0.84f, 0.37f, 0.0f};
const Color kPathColor{0.35f, 0.45f, 0.55f};
const Color kPointColor{0.80f, 0.10f, 0.12f};

Picture decorate(Picture picture, const PictureOptions& options) {
  for (const auto& path : options.paths)
    picture.polylines.push_back({.points = path, .color = kPathColor, .width = 1.5});
  if (!options.points.empty())
    picture.pointSets.push_back({.points = options.points, .color = kPointColor, .size = 9});
  if (!options.caption.empty()) picture.captions.push_back({.text = options.caption});
  return picture;
}

// The paths of the traced bodies through all the poses, one per body.
std::vector<std::vector<Eigen::Vector3d>> tracesOf(const Simulator& simulator,
                                                   const std::vector<BodyPoses>& poses,
                                                   const PictureOptions& options) {
  std::vector<std::vector<Eigen::Vector3d>> traces;
  for (const std::string& name : options.traces) {
    const BodyId body = simulator.model().body(name);
    traces.emplace_back();
    for (const BodyPoses& at : poses) traces.back().push_back(at[body].p);
  }
  return traces;
}

// There is a frame at both ends.
int framesFor(double seconds) {
  return static_cast<int>(std::clamp(std::ceil(seconds * kFilmRate - 1e-9) + 1, 2., 1. * kMostFrames));
}

// From frame `first` on.
Film filmOf(const Simulator& simulator, const std::vector<RecordedPosture>& moments,
            const PictureOptions& options, std::size_t first = 0) {
  std::vector<BodyPoses> poses;
  for (const RecordedPosture& one : moments) poses.push_back(forwardKinematics(simulator.model(), one.q));
  const auto traces = tracesOf(simulator, poses, options);
  Film film;
  for (std::size_t i = first; i < poses.size(); ++i) {
    film.push_back({moments[i].time, decorate(pictureOf(simulator.model(), poses[i]), options)});
    if (i == 0) continue;
    for (const auto& trace : traces) {
      const auto end = trace.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      film.back().picture.polylines.push_back(
          {.points = {trace.begin(), end}, .color = kTraceColor, .width = 2.5});
    }
  }
  settleGround(film);
  return film;
}

}  // namespace

Film filmOf(const Simulator& simulator, const PictureOptions& options, std::optional<int> most) {
  const Recording& recording = simulator.recording();
  const int asked = most.value_or(framesFor(recording.duration()));
  return filmOf(simulator, recording.evenly(static_cast<std::size_t>(std::max(asked, 0))), options);
}

Film filmOf(const Simulator& simulator, const std::vector<Eigen::VectorXd>& postures,
            const PictureOptions& options) {
  std::vector<RecordedPosture> moments;
  for (const Eigen::VectorXd& q : postures)
    moments.push_back({static_cast<double>(moments.size()) / kFilmRate, q});
  return filmOf(simulator, moments, options);
}

Film stillOf(const Simulator& simulator, const PictureOptions& options) {
  std::vector<RecordedPosture> moments;
  if (!options.traces.empty()) moments = simulator.recording().evenly(Recording::kCapacity);
  moments.push_back({0, simulator.getJointAngles()});
  return filmOf(simulator, moments, options, moments.size() - 1);
}

int videoRateOf(const Film& film) {
  if (film.size() < 2) return kFilmRate;
  const double seconds = film.back().time - film.front().time;
  const double rate = std::round(static_cast<double>(film.size() - 1) / seconds);
  return static_cast<int>(std::clamp(rate, 1., static_cast<double>(kFilmRate)));
}

Camera cameraFor(const Film& film, const PictureOptions& options) {
  return framing(film, options.view, static_cast<double>(options.width) / options.height);
}

}  // namespace rex
