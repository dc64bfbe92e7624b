#include "live/live_session.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/escape.h"
#include "base/text.h"
#include "collision/contacts.h"
#include "geometry/rotation.h"
#include "kinematics/center_of_mass.h"
#include "live/live_scene.h"

namespace rex {
namespace {

using SessionJson = nlohmann::ordered_json;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kAvoidMargin = 0.02;   // metres
constexpr double kRecordingRate = 30;   // postures per second
constexpr double kMostPerTick = 0.05;   // seconds simulated in one tick: where that is too slow, it lags
constexpr double kStrongestPush = 1e4;  // newtons

Model compiled(const SceneSpec& spec) { return compile(spec); }

[[noreturn]] void refuse(const std::string& what, const std::string& found, const std::string& wanted) {
  throw Error({.what = "an event from the page: " + what, .found = found, .wanted = wanted});
}

std::vector<double> listOf(const VectorXd& v) { return {v.data(), v.data() + v.size()}; }

struct HoldName {
  const char* name;
  Hold hold;
};
constexpr HoldName kHolds[] = {{"free", Hold::kNone},
                               {"pd", Hold::kPd},
                               {"gravity", Hold::kGravity},
                               {"exact", Hold::kExact},
                               {"motor", Hold::kMotor}};

const char* nameOf(Hold hold) {
  for (const HoldName& one : kHolds)
    if (one.hold == hold) return one.name;
  return "";
}

}  // namespace

// Reads members and refuses what has another type.
struct LiveSession::Event {
  const SessionJson& json;

  bool has(const char* key) const { return json.contains(key); }
  double number(const char* key) const {
    if (!has(key) || !json[key].is_number() || !std::isfinite(json[key].get<double>()))
      refuse(key, "no finite number", "one");
    return json[key].get<double>();
  }
  bool flag(const char* key) const {
    if (!has(key) || !json[key].is_boolean()) refuse(key, "neither true nor false", "one of them");
    return json[key].get<bool>();
  }
  std::string text(const char* key) const {
    if (!has(key) || !json[key].is_string()) refuse(key, "no text", "one");
    return json[key].get<std::string>();
  }
  VectorXd vector(const char* key, long size) const {
    const bool isList = has(key) && json[key].is_array();
    if (!isList || static_cast<long>(json[key].size()) != size)
      refuse(key, isList ? fmt::format("{} numbers", json[key].size()) : "no list",
             fmt::format("{} numbers", size));
    VectorXd v(size);
    for (long i = 0; i < size; ++i) {
      const SessionJson& one = json[key][static_cast<std::size_t>(i)];
      if (!one.is_number() || !std::isfinite(one.get<double>()))
        refuse(key, "something else", "finite numbers");
      v[i] = one.get<double>();
    }
    return v;
  }
  BodyId body(const Model& model) const {
    const double index = number("body");
    if (index != std::floor(index) || index < 0 || index >= static_cast<double>(model.bodies().size()))
      refuse("body", fmt::format("{:g}", index), fmt::format("0 to {}", model.bodies().size() - 1));
    return BodyId{static_cast<int>(index)};
  }
};

LiveSession::LiveSession(const SceneSpec& spec, const VectorXd& q)
    : spec_(spec),
      model_(compiled(spec)),
      state_{q, VectorXd::Zero(model_.nv()), 0},
      poses_(forwardKinematics(model_, q)),
      target_(q) {
  glb_ = liveGlb(model_, poses_);
  description_ = liveDescription(model_);
  settings_.hold = hasFloatingBase(model_) ? Hold::kMotor : Hold::kGravity;
}

void LiveSession::obey(std::string_view message) {
  const SessionJson events = SessionJson::parse(message, nullptr, false);
  if (!events.is_array()) refuse("the message", "no list in JSON", "one");
  for (const SessionJson& event : events) {
    if (!event.is_object()) refuse("the message", "no object", "a list of objects");
    obeyOne({event});
  }
}

void LiveSession::obeyOne(const Event& event) {
  const std::string what = event.text("do");
  if (what == "move") return move(event);
  if (what == "home") return goHome(event);
  if (what == "drag") return drag(event);
  if (what == "push") return push(event);
  if (what == "release") {
    drag_.reset(), push_.reset();
    return;
  }
  if (what == "contacts") return setContactsShown(event.flag("show"), event.flag("avoid"));
  if (what == "record") return record(event);
  if (what == "film") {
    wantsFilm_ = true;
    return;
  }
  obeySimulation(event);
}

void LiveSession::obeySimulation(const Event& event) {
  const std::string what = event.text("do");
  if (what == "run") {
    if (!simulation_) restartSimulation();
    isRunning_ = event.flag("on");
  } else if (what == "step") {
    if (!simulation_) restartSimulation();
    isRunning_ = false;
    simulate(0.01);
  } else if (what == "stop") {
    isRunning_ = false, simulation_.reset(), push_.reset();
    state_.v.setZero(), state_.time = 0, owed_ = 0;
    target_ = state_.q;
  } else if (what == "speed") {
    speed_ = std::clamp(event.number("value"), 0.01, 4.);
  } else if (what == "settings") {
    LiveSimulationOptions next{.gravity = event.flag("gravity"), .friction = event.number("friction")};
    if (event.flag("floor")) next.floor = event.number("height");
    if (next.friction < 0 || next.friction > 100) refuse("friction", "out of range", "0 to 100");
    if (next.floor && std::abs(*next.floor) > 1e3) refuse("height", "out of range", "-1000 to 1000 m");
    const std::string hold = event.text("hold");
    const auto known =
        std::find_if(std::begin(kHolds), std::end(kHolds), [&](auto& h) { return hold == h.name; });
    if (known == std::end(kHolds))
      refuse("hold", "'" + printable(hold) + "'", "free, pd, gravity, exact or motor");
    next.hold = known->hold;
    settings_ = next;
    if (simulation_) restartSimulation();
  } else {
    refuse("do", "'" + printable(what) + "'", "something that the page can do");
  }
}

// Either all coordinates, or some by their index.
void LiveSession::move(const Event& event) {
  if (event.has("q") && event.json["q"].is_array()) return setTarget(event.vector("q", model_.nq()));
  if (!event.has("q") || !event.json["q"].is_object()) refuse("q", "no list or object", "one");
  VectorXd q = simulation_ ? target_ : state_.q;
  for (const auto& [key, value] : event.json["q"].items()) {
    const int index = parseNumber<int>(key).value_or(-1);
    if (index < 0 || index >= model_.nq())
      refuse("q", "'" + printable(key) + "'", fmt::format("0 to {}", model_.nq() - 1));
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      refuse("q", "something else", "finite numbers");
    q[index] = value.get<double>();
  }
  setTarget(q);
}

// In a simulation joints that are held follow; others jump.
// No motor moves a free base: in a simulation it is put back, with all the rest.
void LiveSession::goHome(const Event& event) {
  const VectorXd& home =
      event.has("posture") ? model_.posture(event.text("posture")) : model_.initialPositions();
  if (!simulation_ || !hasFloatingBase(model_)) return setTarget(home);
  state_.q = target_ = home;
  state_.v.setZero();
  poses_ = forwardKinematics(model_, state_.q);
  restartSimulation();
}

void LiveSession::setTarget(const VectorXd& wanted) {
  VectorXd q = wanted.cwiseMax(model_.lowerLimits()).cwiseMin(model_.upperLimits());
  for (const Joint& joint : model_.joints()) {
    if (joint.mimics || joint.nq == joint.nv) continue;
    auto turn = q.segment<4>(joint.qIndex + joint.nq - 4);
    turn.normalize();
    if (!turn.allFinite() || turn.isZero(1e-9)) refuse("q", "a quaternion of length zero", "another one");
  }
  if (!simulation_) {
    state_.q = target_ = q;
    poses_ = forwardKinematics(model_, q);
    return;
  }
  target_ = q;
  if (settings_.hold != Hold::kNone) return simulation_->holdAt(q);
  state_.q = q, state_.v.setZero();
  restartSimulation();
}

void LiveSession::drag(const Event& event) {
  DragGoal goal{.body = event.body(model_), .p_BQ = event.vector("point", 3), .p_WQ = event.vector("to", 3)};
  if (event.has("turn")) {
    const Eigen::Vector4d r = event.vector("turn", 4);  // x y z w
    if (!(r.norm() > 1e-9)) refuse("turn", "a quaternion of length zero", "another one");
    const Eigen::Vector4d unit = r.normalized();
    goal.R_WB = rotationFromQuaternion({unit[3], unit[0], unit[1], unit[2]});
  }
  if (simulation_) refuse("drag", "a simulation", "a push");
  drag_ = goal;
  patience_ = kPatience;
}

void LiveSession::push(const Event& event) {
  Push next{
      .body = event.body(model_), .p_BQ = event.vector("point", 3), .force_W = event.vector("force", 3)};
  if (next.force_W.norm() > kStrongestPush) next.force_W *= kStrongestPush / next.force_W.norm();
  push_ = next;
  patience_ = kPatience;
}

void LiveSession::record(const Event& event) {
  if (event.flag("on")) {
    recording_ = LiveRecording{};
    recordedFor_ = sinceRecorded_ = 0;
    addToRecording();
  } else if (recording_) {
    recorded_ = std::move(recording_);
    recording_.reset();
  }
}

void LiveSession::addToRecording() {
  recording_->times.push_back(recordedFor_);
  recording_->postures.push_back(state_.q);
  if (simulation_ && settings_.floor) recording_->floor = settings_.floor;
  sinceRecorded_ = 0;
}

void LiveSession::restartSimulation() {
  try {
    State start = state_;
    simulation_.emplace(spec_, settings_, start);
    simulation_->holdAt(target_);
    zero_ = simulation_->energyNow().potential;
  } catch (const Error&) {
    simulation_.reset(), isRunning_ = false;
    throw;
  }
}

void LiveSession::setContactsShown(bool shown, bool avoided) {
  if ((shown || avoided) && !contacts_) {
    ContactModel contacts(model_);
    if (contacts.pairs().size() > kMostContactPairs)
      throw Error({.what = "contacts of " + model_.name(),
                   .found = fmt::format("{} pairs of shapes", contacts.pairs().size()),
                   .wanted = fmt::format("at most {}", kMostContactPairs)});
    contacts_ = std::move(contacts);
  }
  showsContacts_ = shown, avoidsContacts_ = avoided;
  avoid_ = avoided ? std::optional(contactTask(*contacts_, kAvoidMargin)) : std::nullopt;
}

void LiveSession::simulate(double seconds) {
  owed_ = std::min(owed_ + seconds, kMostPerTick);
  const int steps = static_cast<int>(std::floor(owed_ * 1000 + 1e-9));
  owed_ -= steps * 1e-3;
  if (steps == 0) return;
  simulation_->advance(steps, push_);
  const double time = state_.time + steps * 1e-3;
  state_ = simulation_->state();
  state_.time = time;
  poses_ = forwardKinematics(model_, state_.q);
}

void LiveSession::advance(double seconds) {
  seconds = std::clamp(seconds, 0., 0.1);
  try {
    if (isRunning_) simulate(seconds * speed_);
    if (drag_ && !simulation_) {
      state_.q = target_ = dragged(model_, state_.q, *drag_, avoid_);
      poses_ = forwardKinematics(model_, state_.q);
    }
  } catch (const Error& error) {
    isRunning_ = false, drag_.reset();
    tell(error.what());
  }
  patience_ -= seconds;
  if (patience_ <= 0) drag_.reset(), push_.reset();
  if (!recording_) return;
  recordedFor_ += seconds, sinceRecorded_ += seconds;
  if (sinceRecorded_ + 1e-9 >= 1 / kRecordingRate) addToRecording();
  if (recordedFor_ < kLongestRecording) return;
  recorded_ = std::move(recording_);
  recording_.reset();
  tell(fmt::format("The recording ended after {:g} seconds.", kLongestRecording));
}

void LiveSession::tell(const std::string& notice) {
  notice_ = notice;
  ++noticeNumber_;
}

bool LiveSession::isMoving() const { return isRunning_ || drag_ || push_ || recording_; }

std::optional<LiveRecording> LiveSession::takeRecording() { return std::exchange(recorded_, std::nullopt); }

bool LiveSession::takeFilmWish() { return std::exchange(wantsFilm_, false); }

std::string LiveSession::frame() const {
  SessionJson all = {{"time", state_.time},
                     {"simulates", simulation_.has_value()},
                     {"runs", isRunning_},
                     {"q", listOf(state_.q)},
                     {"poses", posesText(poses_)},
                     {"settings",
                      {{"speed", speed_},
                       {"gravity", settings_.gravity},
                       {"floor", settings_.floor.has_value()},
                       {"height", settings_.floor.value_or(0)},
                       {"friction", settings_.friction},
                       {"hold", nameOf(settings_.hold)},
                       {"contacts", showsContacts_},
                       {"avoid", avoidsContacts_}}}};
  if (simulation_) {
    const Energy energy = simulation_->energyNow();
    all["energy"] = {energy.kinetic, energy.potential - zero_};
    all["target"] = listOf(target_);
  }
  if (model_.mass() > 0) all["com"] = listOf(centerOfMass(model_, poses_));
  if (showsContacts_) {
    std::vector<Proxy> near = proxies(*contacts_, poses_, kContactMargin);
    std::sort(near.begin(), near.end(),
              [](const Proxy& a, const Proxy& b) { return a.proximity.distance < b.proximity.distance; });
    near.resize(std::min(near.size(), kMostShownContacts));
    SessionJson list = SessionJson::array();
    for (const auto& [pair, found] : near)
      list.push_back({pair.a, pair.b, found.distance, listOf(found.p_WA), listOf(found.p_WB)});
    all["contacts"] = list;
  }
  if (drag_) {
    const Vector3d at = poses_[drag_->body] * drag_->p_BQ;
    all["drag"] = {{"at", listOf(at)}, {"to", listOf(drag_->p_WQ)}};
  }
  if (push_) {
    const Vector3d at = poses_[push_->body] * push_->p_BQ;
    all["push"] = {{"at", listOf(at)}, {"force", listOf(push_->force_W)}};
  }
  if (recording_) all["recording"] = std::round(recordedFor_ * 10) / 10;
  if (films_ > 0) all["film"] = films_;
  if (noticeNumber_ > 0) all["notice"] = {{"number", noticeNumber_}, {"text", notice_}};
  return all.dump(-1, ' ', false, SessionJson::error_handler_t::replace);
}

}  // namespace rex
