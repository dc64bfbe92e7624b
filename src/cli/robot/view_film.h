#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "cli/robot/render_plan.h"
#include "scene/model.h"

namespace rex::cli {

/// Films of what was recorded on the live page, drawn beside it as by `rex render --motion`. HeldSignals must
/// outlive it: it ends its own thread with one of them.
class ViewFilm {
 public:
  struct Drawn {
    std::string text{};   ///< a sentence for the user
    std::string bytes{};  ///< of the film, MP4; empty: there is none
  };

  /// Draws in `folder`. Keeps a reference to the model.
  ViewFilm(const Model& model, Facing facing, std::filesystem::path folder)
      : model_(model), facing_(facing), folder_(std::move(folder)) {}
  /// Gives up what is being drawn.
  ~ViewFilm();

  /// The table of the motion that is drawn next; see toTable().
  void setMotion(const std::string& table) { table_ = table; }
  /// Begins to draw, unless it draws already or there is no motion. Returns a sentence about it. Signals of
  /// HeldSignals end the drawing, but stay for the caller's throwIfInterrupted().
  [[nodiscard]] std::string draw();
  /// What was drawn since the last call.
  [[nodiscard]] std::optional<Drawn> takeDrawn();

 private:
  Drawn drawn(const std::string& table) const;

  const Model& model_;
  Facing facing_;
  std::filesystem::path folder_;
  std::string table_{};
  std::mutex mutex_{};
  bool isBusy_ = false;
  std::optional<Drawn> drawn_{};
  std::atomic<bool> isEnding_ = false;
  std::thread painter_{};
};

}  // namespace rex::cli
