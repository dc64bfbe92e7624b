#include <memory>
#include <numbers>
#include <stdexcept>

#include <sys/resource.h>

#include "base/process.h"
#include "bench/row.h"
#include "bench/shapes_scene.h"
#include "render/film.h"
#include "render/renderer.h"
#include "render/video_sink.h"
#include "support/paths.h"

namespace rex::bench {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// CPU time of this process, or of all children that have ended.
double cpuSeconds(int who) {
  rusage usage{};
  getrusage(who, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string outputOf(const std::vector<std::string>& argv) {
  const ProcessResult result = runProcess(argv);
  if (!result.ok()) throw std::runtime_error(argv[0] + " failed: " + result.error);
  return result.output;
}

// Draws the shapes, the camera a degree further round each time.
class Frames {
 public:
  explicit Frames(const FrameSize& size)
      : picture_{.solids = sixtyShapes()},
        // The peer's smoothing of edges, not the cheaper one of our films.
        renderer_({.width = size.width, .height = size.height, .antiAliasing = AntiAliasing::kMsaa4}) {}

  Image draw() {
    const View view;
    angle_ += std::numbers::pi / 180;
    const Eigen::Vector3d eye =
        view.target + rotation(angle_, Eigen::Vector3d::UnitZ()) * (view.eye - view.target);
    Camera camera = lookAt(eye, view.target);
    camera.verticalFov = view.verticalFovDegrees * std::numbers::pi / 180;
    return renderer_.draw(picture_, camera);
  }

 private:
  Picture picture_;
  Renderer renderer_;
  double angle_ = 0;
};

constexpr int kFilmFrames = 100;

// A hundred frames, from the first line to the finished video: ours and the encoder's time.
double film() {
  const double before = cpuSeconds(RUSAGE_SELF) + cpuSeconds(RUSAGE_CHILDREN);
  Frames frames({});
  VideoSink video(buildPath("film.mp4"));
  for (int i = 0; i < kFilmFrames; ++i) video.add(frames.draw());
  video.finish();
  return cpuSeconds(RUSAGE_SELF) + cpuSeconds(RUSAGE_CHILDREN) - before;
}

double firstFrame() {
  const double before = cpuSeconds(RUSAGE_CHILDREN);
  outputOf({REX_FIRST_FRAME, buildPath("first_frame.png")});
  return cpuSeconds(RUSAGE_CHILDREN) - before;
}

constexpr int kMeasured = 3;

// What one frame takes, once a first one has warmed up what it needs; MuJoCo is measured in the same way.
double oneFrame(Frames& frames) {
  static_cast<void>(frames.draw());
  const double before = cpuSeconds(RUSAGE_SELF);
  for (int i = 0; i < kMeasured; ++i) static_cast<void>(frames.draw());
  return (cpuSeconds(RUSAGE_SELF) - before) / kMeasured;
}

// So many times what MuJoCo takes to draw one frame, its mean over a few.
Measurement mujocoFrames(const FrameSize& size, int times, int measured) {
#ifdef REX_MUJOCO_FRAMES
  std::vector<std::string> command = {REX_MUJOCO_FRAMES};
  for (const int number : {measured, size.width, size.height}) command.push_back(std::to_string(number));
  return [=] { return times * std::stod(outputOf(command)); };
#else
  static_cast<void>(size.width + times + measured);
  return {};
#endif
}

Row frameRow(const std::string& name, const FrameSize& size, double target) {
  // Made when first measured, for its context takes time and there are several rows.
  const auto frames = std::make_shared<std::unique_ptr<Frames>>();
  return {.name = name,
          .ours =
              [=] {
                if (!*frames) *frames = std::make_unique<Frames>(size);
                return oneFrame(**frames);
              },
          .peerName = "MuJoCo",
          .peer = mujocoFrames(size, 1, kMeasured),
          .target = target,
          .unit = "ms"};
}

}  // namespace

std::vector<Row> renderRows() {
  constexpr double kFirstFrameLimit = 0.5;
  return {frameRow("frame-60-shapes", {}, 0.35),
          frameRow("frame-60-shapes-1280x720", {.width = 1280, .height = 720}, 0.5),
          {.name = "film-100-frames-mp4",
           .ours = film,
           .peerName = "MuJoCo",
           .peer = mujocoFrames({}, kFilmFrames, 25),
           .target = 0.5,
           .unit = "s",
           .repetitions = 3},
          {.name = "first-frame",
           .ours = firstFrame,
           .peerName = "limit",
           .peer = [] { return kFirstFrameLimit; },
           .target = 1,
           .unit = "ms"}};
}

}  // namespace rex::bench
