#include "locomotion/simulated_walk.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "kinematics/forward_kinematics.h"

namespace rex {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kMillisecond = 1e-3;
constexpr double kBeyond = 1;       // metres of floor beyond the footsteps
constexpr double kThickness = 0.1;  // of tiles, metres
constexpr double kSunk = 0.3;  // of the trunk's height at the start: lower, it falls, also beyond the floor
constexpr double kMostTiles = 1e5;

void requireSimulation(const WalkPlan& plan, const SimulatedWalkOptions& options) {
  const double count = std::round(options.step / kMillisecond);
  if (!(count >= 1 && std::abs(count * kMillisecond - options.step) < 1e-9))
    throw Error({.what = "simulated walk: step",
                 .found = fmt::format("{:g} s", options.step),
                 .wanted = "a whole number of milliseconds"});
  requireNotNegative("simulated walk: height above the ground at the start", options.startAbove);
  for (const TrunkPush& push : options.pushes) {
    requirePositive("simulated walk: duration of a push", push.duration);
    requireFinite("simulated walk: impulse of a push", push.impulse_W);
    const double last = duration(plan) - push.duration;
    if (!(push.time >= 0 && push.time <= last))
      throw Error({.what = "simulated walk: time of a push",
                   .found = fmt::format("{:g} s", push.time),
                   .wanted = fmt::format("0 to {:g} s, so that all of it happens", last)});
  }
}

// The body that the world touches in a contact, if it is one of those.
std::optional<BodyId> touched(const Model& model, const PhysicsContact& contact) {
  const auto bodyOf = [&](int shape) { return model.shapes()[static_cast<std::size_t>(shape)].body; };
  const BodyId a = bodyOf(contact.shapeA), b = bodyOf(contact.shapeB);
  if (a == kWorld && b != kWorld) return b;
  if (b == kWorld && a != kWorld) return a;
  return std::nullopt;
}

// One walk, step by step.
class Walking {
 public:
  Walking(const Model& model, const Legs& legs, const WalkPlan& plan, const VectorArg& home,
          const SimulatedWalkOptions& options)
      : model_(model),
        legs_(legs),
        options_(options),
        controller_(model, legs, plan, home, options.control),
        world_(model, options.physics),
        motors_(static_cast<std::size_t>(model.nv())),
        effort_(model.nv()),
        base_(model[model[legs.trunk].joint].vIndex),
        height_(model[model[legs.trunk].joint].qIndex + 2),
        steps_(std::lround(duration(plan) / options.step)) {
    for (const Joint& joint : model.joints())
      effort_.segment(joint.vIndex, joint.nv).setConstant(joint.maxEffort);
    State state = initialState(model);
    state.q = home;
    const BodyPoses poses = forwardKinematics(model, state.q);
    const double sole =
        std::min((poses[legs.leftFoot] * legs.p_FS).z(), (poses[legs.rightFoot] * legs.p_FS).z());
    state.q[height_] += options.startAbove - sole;
    world_.setState(state);
    walk_.state = state;
    lowest_ = kSunk * state.q[height_];
  }

  SimulatedWalk run() {
    double squares = 0;
    for (long i = 0; i < steps_ && !walk_.falls; ++i) {
      step();
      const WalkMeasurement& now = walk_.samples.back();
      if (now.measured.exists) squares += (now.measured.p_W.head<2>() - now.control.plannedZmp).squaredNorm();
    }
    walk_.rmsZmpError =
        std::sqrt(squares / static_cast<double>(std::max<std::size_t>(walk_.samples.size(), 1)));
    return std::move(walk_);
  }

 private:
  void step() {
    WalkMeasurement sample{.control = controller_.control(walk_.state, loads_)};
    WholeBodyForces& forces = sample.control.forces;
    if (forces.status != QuadraticStatus::kOptimal) {
      fall("no joint forces obey all limits");
    } else {
      command(forces);
      walk_.largestResidual = std::max(walk_.largestResidual, forces.residual);
    }
    push();
    world_.setMotors(motors_);
    world_.step(options_.step);
    walk_.state = world_.state();
    walk_.time = sample.time = walk_.state.time;
    sample.q = walk_.state.q;
    walk_.largestCaptureError = std::max(walk_.largestCaptureError, sample.control.captureError.norm());
    forces = {};
    measure(sample);
    if (walk_.state.q[height_] < lowest_) fall("the trunk has sunk too low");
    walk_.samples.push_back(std::move(sample));
  }

  void command(const WholeBodyForces& forces) {
    for (Eigen::Index i = 0; i < forces.u.size(); ++i) {
      motors_[static_cast<std::size_t>(i)] = {.target = forces.u[i]};
      if (forces.u[i] != 0)
        walk_.largestEffort = std::max(walk_.largestEffort, std::abs(forces.u[i]) / effort_[i]);
    }
  }

  void push() {
    Vector3d force = Vector3d::Zero();
    for (const TrunkPush& one : options_.pushes) {
      const double into = walk_.state.time - one.time + kMillisecond / 2;
      if (into >= 0 && into < one.duration) force += one.impulse_W / one.duration;
    }
    for (int i = 0; i < 3; ++i) motors_[static_cast<std::size_t>(base_ + i)] = {.target = force[i]};
  }

  void measure(WalkMeasurement& sample) {
    const std::vector<PhysicsContact> contacts = world_.contacts();
    Eigen::Matrix2Xd points(2, 0);
    loads_ = {};
    for (const PhysicsContact& contact : contacts) {
      const std::optional<BodyId> body = touched(model_, contact);
      if (!body || contact.impulse == 0) continue;
      if (*body != legs_.leftFoot && *body != legs_.rightFoot)
        fall(fmt::format("'{}' touches the ground", model_[*body].name));
      (*body == legs_.leftFoot ? loads_.left : loads_.right) +=
          contact.impulse * std::abs(contact.normal_W.z()) / kMillisecond;
      points.conservativeResize(2, points.cols() + 1);
      points.rightCols<1>() = contact.p_WA.head<2>();
    }
    sample.loads = loads_;
    sample.measured = zmpOfContacts(groundForces(model_, contacts, kMillisecond));
    if (sample.measured.exists)
      sample.margin = supportMargin(supportPolygon(points), sample.measured.p_W.head<2>()).margin;
  }

  void fall(const std::string& why) {
    if (!walk_.falls) walk_.message = fmt::format("falls at {:.3g} s: {}", walk_.state.time, why);
    walk_.falls = true;
  }

  const Model& model_;
  const Legs& legs_;
  const SimulatedWalkOptions& options_;
  WalkController controller_;
  PhysicsWorld world_;
  std::vector<Motor> motors_;
  VectorXd effort_;
  int base_, height_;
  double lowest_ = 0;
  long steps_;
  FootLoads loads_{};
  SimulatedWalk walk_{};
};

}  // namespace

void addUnevenFloor(SceneSpec& scene, const WalkPlan& plan, double unevenness, double tile, Rng& rng) {
  static_cast<void>(duration(plan));  // throws if the plan is not valid
  requireNotNegative("uneven floor: unevenness", unevenness);
  requirePositive("uneven floor: tile", tile);
  Vector2d low = plan.footsteps.front().p, high = low;
  for (const Footstep& foot : plan.footsteps) {
    low = low.cwiseMin(foot.p);
    high = high.cwiseMax(foot.p);
  }
  low.array() -= kBeyond;
  const double columns = std::ceil((high.x() + kBeyond - low.x()) / tile),
               rows = std::ceil((high.y() + kBeyond - low.y()) / tile);
  if (!(columns * rows <= kMostTiles))
    throw Error({.what = "uneven floor: tile",
                 .found = fmt::format("{:g} tiles", columns * rows),
                 .wanted = fmt::format("at most {:g}", kMostTiles)});
  for (double i = 0; i < columns; ++i) {
    for (double j = 0; j < rows; ++j) {
      const double height = unevenness * rng.uniform();
      // A chessboard in greys that tell the heights.
      const double grey = 0.62 + (unevenness > 0 ? 0.2 * height / unevenness : 0.1);
      ShapeSpec shape{.name = "floor",
                      .X_BS = translation(low.x() + (i + 0.5) * tile, low.y() + (j + 0.5) * tile,
                                          height - kThickness / 2),
                      .shape = {.extent = {tile, tile, kThickness}},
                      .color = {grey, grey, grey + 0.02, 1},
                      .contact = true};
      scene.worldShapes.push_back(shape);
    }
  }
}

std::vector<ContactForce> groundForces(const Model& model, std::span<const PhysicsContact> contacts,
                                       double h) {
  requirePositive("ground forces: step", h);
  std::vector<ContactForce> forces;
  for (const PhysicsContact& contact : contacts) {
    const std::optional<BodyId> body = touched(model, contact);
    if (!body || contact.impulse == 0) continue;
    const bool isA = model.shapes()[static_cast<std::size_t>(contact.shapeA)].body == *body;
    const Vector3d onA = (contact.impulse * contact.normal_W + contact.friction_W) / h;
    forces.push_back({isA ? contact.p_WA : contact.p_WB, isA ? onA : -onA});
  }
  return forces;
}

SimulatedWalk simulateWalk(const Model& model, const Legs& legs, const WalkPlan& plan, const VectorArg& home,
                           const SimulatedWalkOptions& options) {
  requireSimulation(plan, options);
  return Walking(model, legs, plan, home, options).run();
}

double largestPush(const Model& model, const Legs& legs, const WalkPlan& plan, const VectorArg& home,
                   const Vector3d& direction_W, double time, double most, double resolution,
                   const SimulatedWalkOptions& options) {
  requirePositive("largest push: direction", direction_W.norm());
  requirePositive("largest push: most", most);
  requirePositive("largest push: resolution", resolution);
  const auto fallsAfter = [&](double impulse) {
    SimulatedWalkOptions pushed = options;
    pushed.pushes.push_back({.time = time, .impulse_W = impulse * direction_W.normalized()});
    return simulateWalk(model, legs, plan, home, pushed).falls;
  };
  if (!fallsAfter(most)) return most;
  double survived = 0, fatal = most;
  while (fatal - survived > resolution) {
    const double impulse = (survived + fatal) / 2;
    (fallsAfter(impulse) ? fatal : survived) = impulse;
  }
  return survived;
}

}  // namespace rex
