#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "collision/contacts.h"
#include "live/drag.h"
#include "live/live_simulation.h"

namespace rex {

/// One robot that is moved by its viewers: what the live page shows and what it asks
/// for, as values and without a network. In a posture, sliders and drags move it; in a simulation, forces do,
/// and sliders move what the joints are held at.
class LiveSession {
 public:
  static constexpr double kLongestRecording = 120;  ///< seconds
  static constexpr double kPatience = 1;  ///< seconds after which a drag or push that nobody renews ends
  static constexpr std::size_t kMostShownContacts = 60, kMostContactPairs = 20000;

  /// Starts at posture q (nq). Throws Error as compile(), liveGlb() and forwardKinematics().
  LiveSession(const SceneSpec& spec, const Eigen::VectorXd& q);

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const State& state() const { return state_; }
  /// See liveGlb() and liveDescription().
  [[nodiscard]] const std::string& glb() const { return glb_; }
  [[nodiscard]] const std::string& description() const { return description_; }

  /// Does what a page asks for: a list of events in JSON, such as [{"do": "move", "q": {"3": 0.5}}], see
  /// share/doc/commands.md. Throws Error for the first that is wrong; those before it are done.
  void obey(std::string_view message);
  /// Lets this much time pass, of the clock on the wall, at most 0.1 s. What goes wrong is a notice of the
  /// next frames.
  void advance(double seconds);
  /// Puts a sentence for all viewers into the next frames.
  void tell(const std::string& notice);
  /// All that pages show, as JSON on one line.
  [[nodiscard]] std::string frame() const;
  /// The recording, once somebody has ended it.
  [[nodiscard]] std::optional<LiveRecording> takeRecording();
  /// Whether somebody has asked for a film of the recording since the last call.
  [[nodiscard]] bool takeFilmWish();
  /// Tells pages that there is a new film of it.
  void addFilm() { ++films_; }
  /// Whether time changes anything: while nothing does, frames stay the same.
  [[nodiscard]] bool isMoving() const;

 private:
  struct Event;  // as JSON
  void obeyOne(const Event& event);
  void obeySimulation(const Event& event);
  void move(const Event& event);
  void goHome(const Event& event);
  void setTarget(const Eigen::VectorXd& q);
  void drag(const Event& event);
  void push(const Event& event);
  void record(const Event& event);
  void restartSimulation();
  void setContactsShown(bool shown, bool avoided);
  void addToRecording();
  void simulate(double seconds);

  SceneSpec spec_;
  Model model_;
  std::string glb_, description_;
  State state_;
  BodyPoses poses_;

  std::optional<ContactModel> contacts_{};
  std::optional<TaskMap> avoid_{};
  bool showsContacts_ = false, avoidsContacts_ = false;

  std::optional<DragGoal> drag_{};
  std::optional<Push> push_{};
  double patience_ = 0;  // seconds left for the drag or push

  std::optional<LiveSimulation> simulation_{};
  LiveSimulationOptions settings_{};
  Eigen::VectorXd target_;  // posture at which joints are held
  bool isRunning_ = false;
  double speed_ = 1, owed_ = 0;  // owed: seconds that are not simulated yet
  double zero_ = 0;              // potential energy at the start

  std::optional<LiveRecording> recording_{}, recorded_{};
  double recordedFor_ = 0, sinceRecorded_ = 0;
  bool wantsFilm_ = false;
  int films_ = 0;
  std::string notice_{};
  int noticeNumber_ = 0;
};

}  // namespace rex
