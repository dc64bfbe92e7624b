#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/robot/posture_option.h"
#include "render/film.h"
#include "scene/model.h"

namespace rex::cli {

/// The pictures of a motion above one level ground. Each is made on demand, because a film of a large scene
/// would not fit into memory.
class MotionPictures {
 public:
  /// Shows the postures with the indices `shown`, in this order. `traces` are bodies whose paths over the
  /// whole motion are drawn, and every picture has the `caption`. Throws UsageError for an unknown body.
  MotionPictures(const Model& model, const Motion& motion, const std::vector<std::size_t>& shown,
                 const std::vector<std::string>& traces, std::string caption);

  [[nodiscard]] std::size_t size() const { return shown_.size(); }
  /// The time of picture i, seconds.
  [[nodiscard]] double time(std::size_t i) const { return motion_.times[shown_[i]]; }
  /// Picture i, with the traces up to its time.
  [[nodiscard]] Picture picture(std::size_t i) const;
  /// All pictures.
  [[nodiscard]] Film film() const;
  /// The bounding box of everything they show.
  [[nodiscard]] const Bounds& bounds() const { return bounds_; }

 private:
  [[nodiscard]] Picture solidsAt(std::size_t i) const;

  Model model_;
  Motion motion_;
  std::vector<std::size_t> shown_;
  std::vector<std::vector<Eigen::Vector3d>> ways_;
  std::string caption_;
  Bounds bounds_;
  double ground_ = 0;
};

}  // namespace rex::cli
