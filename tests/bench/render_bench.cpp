#include <memory>
#include <numbers>
#include <stdexcept>

#include <sys/resource.h>

#include "base/process.h"
#include "bench/row.h"
#include "bench/shapes_scene.h"
#include "render/draw_film.h"
#include "render/renderer.h"
#include "render/video_sink.h"

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

// Draws the sixty shapes, the camera a degree further round each time.
class Frames {
 public:
  explicit Frames(AntiAliasing antiAliasing)
      : picture_{.solids = sixtyShapes()}, antiAliasing_(antiAliasing) {}

  Image draw() {
    if (!renderer_)
      renderer_ = std::make_unique<Renderer>(
          RendererOptions{.width = kFrameWidth, .height = kFrameHeight, .antiAliasing = antiAliasing_});
    const View view;
    angle_ += std::numbers::pi / 180;
    const Eigen::Vector3d eye =
        view.target + rotation(angle_, Eigen::Vector3d::UnitZ()) * (view.eye - view.target);
    Camera camera = lookAt(eye, view.target);
    camera.verticalFov = view.verticalFovDegrees * std::numbers::pi / 180;
    return renderer_->draw(picture_, camera);
  }

 private:
  Picture picture_;
  AntiAliasing antiAliasing_;
  std::unique_ptr<Renderer> renderer_;
  double angle_ = 0;
};

constexpr int kFilmFrames = 100;

// A hundred frames, from the first line to the finished video: ours and the encoder's time.
double film() {
  const double before = cpuSeconds(RUSAGE_SELF) + cpuSeconds(RUSAGE_CHILDREN);
  Frames frames(kFilmAntiAliasing);
  VideoSink video(REX_BINARY_DIR "/film.mp4");
  for (int i = 0; i < kFilmFrames; ++i) video.add(frames.draw());
  video.finish();
  return cpuSeconds(RUSAGE_SELF) + cpuSeconds(RUSAGE_CHILDREN) - before;
}

double firstFrame() {
  const double before = cpuSeconds(RUSAGE_CHILDREN);
  outputOf({REX_FIRST_FRAME, REX_BINARY_DIR "/first_frame.png"});
  return cpuSeconds(RUSAGE_CHILDREN) - before;
}

// So many times what MuJoCo takes to draw one frame, its mean over a few.
Measurement mujocoFrames(int times, int measured) {
#ifdef REX_MUJOCO_FRAMES
  return [=] { return times * std::stod(outputOf({REX_MUJOCO_FRAMES, std::to_string(measured)})); };
#else
  static_cast<void>(times + measured);
  return {};
#endif
}

}  // namespace

std::vector<Row> renderRows() {
  const auto frames = std::make_shared<Frames>(AntiAliasing::kMsaa4);
  constexpr double kFirstFrameLimit = 0.5;
  return {{.name = "frame-60-shapes",
           .ours = timed([frames] { static_cast<void>(frames->draw()); }),
           .peerName = "MuJoCo",
           .peer = mujocoFrames(1, 3),
           .target = 0.4,
           .unit = "ms"},
          {.name = "film-100-frames-mp4",
           .ours = film,
           .peerName = "MuJoCo",
           .peer = mujocoFrames(kFilmFrames, 25),
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
