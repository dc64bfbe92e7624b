#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/robot/posture_option.h"
#include "render/film.h"
#include "scene/model.h"

namespace rex::cli {

/// The pictures of a motion on one level ground, each made when it is asked for: a film of a large scene
/// would not fit into memory at once.
class MotionPictures {
 public:
  /// Of the motion only the postures `shown` count, in this order; all of it leaves `traces`, the ways of
  /// bodies, and every picture says `caption`. Throws UsageError for an unknown body.
  MotionPictures(const Model& model, const Motion& motion, const std::vector<std::size_t>& shown,
                 const std::vector<std::string>& traces, std::string caption);

  [[nodiscard]] std::size_t size() const { return shown_.size(); }
  /// Of picture i, seconds.
  [[nodiscard]] double time(std::size_t i) const { return motion_.times[shown_[i]]; }
  /// Picture i, with the ways up to its moment.
  [[nodiscard]] Picture picture(std::size_t i) const;
  /// All of them.
  [[nodiscard]] Film film() const;
  /// The box around all that they show.
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
