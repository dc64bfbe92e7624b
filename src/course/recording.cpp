#include "course/recording.h"

#include <cmath>
#include <utility>

#include "base/require.h"

namespace rex {
namespace {

// The postures nearest to `most` evenly spaced times from the first to the last, each at most once.
std::vector<RecordedPosture> thinnedByTime(const std::vector<RecordedPosture>& all, std::size_t most) {
  std::vector<RecordedPosture> thinned;
  const double first = all.front().time, span = all.back().time - first;
  std::size_t at = 0, last = all.size();
  for (std::size_t i = 0; i < most; ++i) {
    const double time = first + span * static_cast<double>(i) / static_cast<double>(most - 1);
    while (at + 1 < all.size() && std::abs(all[at + 1].time - time) <= std::abs(all[at].time - time)) ++at;
    if (at != last) thinned.push_back(all[at]);
    last = at;
  }
  return thinned;
}

std::vector<RecordedPosture> thinnedByCount(const std::vector<RecordedPosture>& all, std::size_t most) {
  std::vector<RecordedPosture> thinned;
  const std::size_t gaps = most - 1, span = all.size() - 1;
  for (std::size_t i = 0; i <= gaps; ++i) thinned.push_back(all[(i * span + gaps / 2) / gaps]);
  return thinned;
}

}  // namespace

void Recording::startAt(const Eigen::VectorXd& q) {
  clear();
  append(q, 0);
  isStart_ = true;
}

void Recording::add(const Eigen::VectorXd& q, std::optional<double> seconds) {
  if (isStart_) clear();
  isTimed_ = isTimed_ || seconds.has_value();
  append(q, empty() ? 0 : seconds.value_or(0));
}

void Recording::step(const Eigen::VectorXd& q, double seconds) {
  isStart_ = false;
  isTimed_ = true;
  append(q, seconds);
}

void Recording::append(const Eigen::VectorXd& q, double seconds) {
  last_ = {last_.time + seconds, q};
  if (count_ % stride_ == 0) kept_.push_back(last_);
  ++count_;
  if (kept_.size() <= 2 * kCapacity) return;
  for (std::size_t i = 0; 2 * i < kept_.size(); ++i) std::swap(kept_[i], kept_[2 * i]);
  kept_.resize((kept_.size() + 1) / 2);
  stride_ *= 2;
}

void Recording::clear() { *this = Recording(); }

double Recording::duration() const {
  if (count_ == 0) return 0;
  return isTimed_ ? last_.time - kept_.front().time : static_cast<double>(count_ - 1) / kRate;
}

std::vector<RecordedPosture> Recording::kept() const {
  std::vector<RecordedPosture> all = kept_;
  if (count_ > 0 && (count_ - 1) % stride_ != 0) all.push_back(last_);
  if (!isTimed_) return all;
  std::vector<RecordedPosture> increasing;
  for (RecordedPosture& one : all) {
    if (!increasing.empty() && !(one.time > increasing.back().time)) increasing.pop_back();
    increasing.push_back(std::move(one));
  }
  return increasing;
}

std::vector<RecordedPosture> Recording::evenly(std::size_t most) const {
  requireCount("number of postures", static_cast<long long>(most), 2);
  std::vector<RecordedPosture> chosen = kept();
  if (chosen.size() > most) chosen = isTimed_ ? thinnedByTime(chosen, most) : thinnedByCount(chosen, most);
  const double first = chosen.empty() ? 0 : chosen.front().time;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    chosen[i].time = isTimed_ ? chosen[i].time - first : static_cast<double>(i) / kRate;
  return chosen;
}

}  // namespace rex
