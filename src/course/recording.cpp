#include "course/recording.h"

#include <fmt/format.h>

#include "base/error.h"

namespace rex {

void Recording::add(const Eigen::VectorXd& q) {
  if (count_ % stride_ == 0) kept_.push_back(q);
  last_ = q;
  ++count_;
  if (kept_.size() <= 2 * kCapacity) return;
  for (std::size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i].swap(kept_[2 * i]);
  kept_.resize((kept_.size() + 1) / 2);
  stride_ *= 2;
}

void Recording::clear() { *this = Recording(); }

std::vector<Eigen::VectorXd> Recording::evenly(std::size_t most) const {
  if (most < 2)
    throw Error({.what = "number of postures", .found = fmt::format("{}", most), .wanted = "at least 2"});
  std::vector<Eigen::VectorXd> chosen = kept_;
  if (count_ > 0 && (count_ - 1) % stride_ != 0) chosen.push_back(last_);
  if (chosen.size() <= most) return chosen;
  std::vector<Eigen::VectorXd> thinned;
  const std::size_t gaps = most - 1, span = chosen.size() - 1;
  for (std::size_t i = 0; i <= gaps; ++i) thinned.push_back(chosen[(i * span + gaps / 2) / gaps]);
  return thinned;
}

}  // namespace rex
