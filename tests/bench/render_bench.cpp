#include <memory>
#include <numbers>
#include <stdexcept>

#include <sys/resource.h>

#include "base/process.h"
#include "bench/row.h"
#include "bench/shapes_scene.h"
#include "render/renderer.h"

namespace rex::bench {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// CPU time of all children that have ended.
double childSeconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
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
  Frames() : picture_{.solids = sixtyShapes()} {}

  void draw() {
    if (!renderer_)
      renderer_ = std::make_unique<Renderer>(RendererOptions{.width = kFrameWidth, .height = kFrameHeight});
    const View view;
    angle_ += std::numbers::pi / 180;
    const Eigen::Vector3d eye =
        view.target + rotation(angle_, Eigen::Vector3d::UnitZ()) * (view.eye - view.target);
    Camera camera = lookAt(eye, view.target);
    camera.verticalFov = view.verticalFovDegrees * std::numbers::pi / 180;
    static_cast<void>(renderer_->draw(picture_, camera));
  }

 private:
  Picture picture_;
  std::unique_ptr<Renderer> renderer_;
  double angle_ = 0;
};

double firstFrame() {
  const double before = childSeconds();
  outputOf({REX_FIRST_FRAME, REX_BINARY_DIR "/first_frame.png"});
  return childSeconds() - before;
}

Measurement mujocoFrame() {
#ifdef REX_MUJOCO_FRAMES
  return [] { return std::stod(outputOf({REX_MUJOCO_FRAMES, "3"})); };
#else
  return {};
#endif
}

}  // namespace

std::vector<Row> renderRows() {
  const auto frames = std::make_shared<Frames>();
  constexpr double kFirstFrameLimit = 0.5;
  return {{.name = "frame-60-shapes",
           .ours = timed([frames] { frames->draw(); }),
           .peerName = "MuJoCo",
           .peer = mujocoFrame(),
           .target = 0.4,
           .unit = "ms"},
          {.name = "first-frame",
           .ours = firstFrame,
           .peerName = "limit",
           .peer = [] { return kFirstFrameLimit; },
           .target = 1,
           .unit = "ms"}};
}

}  // namespace rex::bench
