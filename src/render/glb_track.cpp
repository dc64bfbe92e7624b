#include <algorithm>
#include <map>

#include "geometry/rotation.h"
#include "render/glb_track_internal.h"

namespace rex::internal {
namespace {

// The track without gaps: an absent item waits where it was, or where it will appear.
std::vector<GlbState> withoutGaps(const GlbTrack& track) {
  const auto first = std::find_if(track.begin(), track.end(), [](const auto& s) { return s.has_value(); });
  std::vector<GlbState> way;
  GlbState last = **first;
  for (const std::optional<GlbState>& state : track) way.push_back(last = state.value_or(last));
  return way;
}

template <class Keys>
bool areConstant(const Keys& keys) {
  return std::all_of(keys.begin(), keys.end(), [&](const auto& key) { return key == keys.front(); });
}

// Neighbouring quaternions have the same sign, because a viewer would otherwise take the long way between
// them.
std::vector<Eigen::Vector4f> rotationKeys(const std::vector<GlbState>& way) {
  std::vector<Eigen::Vector4f> keys;
  Quaternion last(1, 0, 0, 0);
  for (const GlbState& state : way) {
    Quaternion q = quaternionFromRotation(state.pose.R).normalized();
    if (q.dot(last) < 0) q = -q;
    last = q;
    keys.push_back(Eigen::Vector4d(q[1], q[2], q[3], q[0]).cast<float>());
  }
  return keys;
}

}  // namespace

GlbTracks::GlbTracks(GlbWriter& writer, std::vector<float> times, int parent)
    : writer_(&writer), times_(std::move(times)), parent_(parent) {}

void GlbTracks::add(const std::string& name, const GlbTrack& track) {
  std::map<std::pair<int, GlbExtras>, std::vector<bool>> forms;
  for (std::size_t k = 0; k < track.size(); ++k) {
    if (!track[k]) continue;
    const auto form = forms.try_emplace({track[k]->mesh, track[k]->extras}, track.size(), false).first;
    form->second[k] = true;
  }
  if (forms.empty()) return;
  const std::vector<GlbState> way = withoutGaps(track);
  const auto hasSize = [](const GlbState& state) { return state.scale != Eigen::Vector3d::Ones(); };
  const bool sized = std::any_of(way.begin(), way.end(), hasSize);
  for (const auto& [form, shown] : forms) {
    GlbNode node{.name = name,
                 .parent = parent_,
                 .mesh = form.first,
                 .pose = way[0].pose,
                 .scale = way[0].scale,
                 .extras = form.second};
    const bool always = std::find(shown.begin(), shown.end(), false) == shown.end();
    const Eigen::Vector3d atFirst = Eigen::Vector3d::Constant(shown[0] ? 1 : 0);
    // If the item has a scale of its own, the scale of a parent node hides it.
    if (!always && sized) node.parent = writer_->addNode({.name = name, .parent = parent_, .scale = atFirst});
    if (!always && !sized) node.scale = atFirst;
    const int index = writer_->addNode(node);
    move(index, way);
    if (!always) blink(sized ? node.parent : index, shown);
  }
}

void GlbTracks::move(int node, const std::vector<GlbState>& way) {
  std::vector<Eigen::Vector3f> places, scales;
  for (const GlbState& state : way) {
    places.push_back(state.pose.p.cast<float>());
    scales.push_back(state.scale.cast<float>());
  }
  const std::vector<Eigen::Vector4f> turns = rotationKeys(way);
  const auto animate = [&](GlbPath path, const auto& keys) {
    if (areConstant(keys)) return;
    writer_->animate(node, path, writer_->addTimes(times_), writer_->addKeys(keys), false);
  };
  animate(GlbPath::kTranslation, places);
  animate(GlbPath::kRotation, turns);
  animate(GlbPath::kScale, scales);
}

void GlbTracks::blink(int node, const std::vector<bool>& shown) {
  std::vector<float> times;
  std::vector<Eigen::Vector3f> scales;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (k > 0 && shown[k] == shown[k - 1]) continue;
    times.push_back(times_[k]);
    scales.push_back(Eigen::Vector3f::Constant(shown[k] ? 1 : 0));
  }
  writer_->animate(node, GlbPath::kScale, writer_->addTimes(times), writer_->addKeys(scales), true);
}

}  // namespace rex::internal
