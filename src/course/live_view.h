#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

namespace rex {

class Simulator;
struct Picture;

/// Shows a program while it runs, as a page in a browser with sliders, buttons, handles and plots of the
/// program's own. In a terminal it prints the address of the page, opens a browser where there is a screen,
/// and waits half a minute at most for somebody to look. Without anybody, as in tests, no method ever waits.
/// In any case it writes NAME.html at the end, a replay of what was shown. `rex run` links what it needs.
class LiveView {
 public:
  explicit LiveView(const std::string& name = "live");
  /// The same, and shows the robot at once.
  explicit LiveView(const Simulator& simulator, const std::string& name = "live");
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  /// Whether a page shows this now. A program whose loop should run while somebody looks asks this.
  [[nodiscard]] bool isWatched();

  /// Shows the robot in its present posture, or a picture of anything; 1/30 s after the one before, while
  /// somebody looks. Throws Error as toGlb() (render/glb.h), and for a robot without any shape.
  void show(const Simulator& simulator);
  void show(const Picture& picture);

  /// Sets the direction (W, any length) from which page and replay show pictures from now on.
  void lookFrom(const Eigen::Vector3d& direction);

  /// The value of a slider on the page, which first is `start`. Throws Error unless low <= start <= high.
  double slider(const std::string& name, double low, double high, double start);
  /// A point that the mouse moves on the page, metres in W; first `start`. It moves in the plane with this
  /// normal, such as the third axis for flat worlds, and parallel to the window if that is zero. Throws Error
  /// for numbers that are not finite.
  Eigen::Vector3d handle(const std::string& name, const Eigen::Vector3d& start,
                         const Eigen::Vector3d& normal = Eigen::Vector3d::Zero());
  /// Whether this button was pressed since the last call.
  bool button(const std::string& name);
  /// Adds a point to the curve of this name, on the page (over time the last ten seconds) and in the replay.
  void plot(const std::string& name, double x, double y, const std::string& xLabel = "time [s]");
  /// Waits until somebody presses "Go on" on the page, as long as one is open.
  void pause();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rex
