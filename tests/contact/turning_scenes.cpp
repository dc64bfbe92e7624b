// Tops, chains and loops: what holds in an engine of contacts without any contact.
#include <cmath>

#include "contact/contact_scenes.h"
#include "geometry/rotation.h"

namespace rex::contact {
namespace {

using Eigen::Vector3d;

// A top: its inertia about the tip and its axis, the height of its centre; on a ball joint at the origin.
constexpr double kTopMass = 0.5, kHeight = 0.1, kAcross = 8.5e-3, kAlong = 6e-3, kTilt = 0.5, kSpin = 40;
Model top() {
  SceneSpec spec;
  BodySpec body;
  body.name = "top";
  body.mass = kTopMass;
  body.p_BBcm = {0, 0, kHeight};
  const double aboutCentre = kAcross - kTopMass * kHeight * kHeight;
  body.inertia = Vector3d(aboutCentre, aboutCentre, kAlong).asDiagonal();
  ShapeSpec shape;
  shape.shape = capsuleShape(0.02, 0.16);
  shape.X_BS = translation(0, 0, kHeight);
  body.shapes.push_back(shape);
  spec.bodies.push_back(body);
  JointSpec ball;
  ball.name = ball.child = "top";
  ball.parent = "world";
  ball.type = JointType::kBall;
  ball.q0 = quaternionFromRotation(rotation(kTilt, Vector3d::UnitY()).R);
  spec.joints.push_back(ball);
  return compile(spec);
}

// The slow rate of steady precession: I W^2 cos a - L W + m g l = 0, where L is the momentum about the axis.
double precessionRate() {
  const double L = kAlong * kSpin, a = kAcross * std::cos(kTilt);
  return 2 * kTopMass * kGravity * kHeight / (L + std::sqrt(L * L - 4 * a * kTopMass * kGravity * kHeight));
}

Vector3d axisOf(const State& state, int place) {
  return rotationFromQuaternion(state.q.segment<4>(place)).col(2);
}

double precessionOfTop(const Engine& engine) {
  const Model model = top();
  const auto world = engine(model, {});
  State state = initialState(model);
  const Eigen::Matrix3d R = rotationFromQuaternion(state.q.head<4>());
  const double rate = precessionRate();
  state.v = R.transpose() * Vector3d(0, 0, rate) + Vector3d(0, 0, kSpin - rate * std::cos(kTilt));
  world->setState(state);
  double turned = 0, before = 0;
  for (int i = 0; i < 1000; ++i) {
    world->step();
    const Vector3d axis = axisOf(world->state(), 0);
    const double angle = std::atan2(axis.y(), axis.x());
    turned += std::remainder(angle - before, 2 * M_PI);
    before = angle;
  }
  return turned;
}

// A disc that was thrown wobbles at its angular momentum divided by its inertia across.
constexpr double kDiscAcross = 1e-3, kDiscAlong = 2e-3;
Model disc() {
  SceneSpec spec;
  addLoose(spec, "disc", 0.2, capsuleShape(0.05, 0.01), translation(0, 0, 20));
  spec.bodies.back().inertia = Vector3d(kDiscAcross, kDiscAcross, kDiscAlong).asDiagonal();
  return compile(spec);
}

double wobbleOfDisc(const Engine& engine) {
  const Model model = disc();
  const auto world = engine(model, {});
  State state = initialState(model);
  state.v.tail<3>() << 2, 0, 10;
  world->setState(state);
  const Vector3d along = Vector3d(2 * kDiscAcross, 0, 10 * kDiscAlong).normalized(),
                 across = Vector3d::UnitY(), aside(along.z(), 0, -along.x());
  double turned = 0, before = 0;
  for (int i = 0; i <= 1000; ++i) {
    if (i > 0) world->step();
    const Vector3d axis = axisOf(world->state(), 3);
    const double angle = std::atan2(axis.dot(aside), axis.dot(across));
    if (i > 0) turned += std::remainder(angle - before, 2 * M_PI);
    before = angle;
  }
  return std::abs(turned);
}

// Links of 0.1 m between two points at the same height.
constexpr int kLinks = 20;
constexpr double kLink = 0.1, kSpan = 1.2;
// It starts as a V that closes exactly.
const double kDown = std::acos(kSpan / (kLinks * kLink));
Model chain() {
  SceneSpec spec;
  std::string parent = "world";
  for (int i = 0; i < kLinks; ++i) {
    BodySpec body;
    body.name = "link" + std::to_string(i);
    body.mass = 0.1;
    body.p_BBcm = {kLink / 2, 0, 0};
    body.inertia = 0.1 * kLink * kLink / 12 * Eigen::Matrix3d::Identity();
    ShapeSpec shape;
    shape.shape = capsuleShape(0.01, kLink);
    shape.X_BS = translation(kLink / 2, 0, 0) * rotation(M_PI / 2, Vector3d::UnitY());
    body.shapes.push_back(shape);
    spec.bodies.push_back(body);
    JointSpec joint;
    joint.name = joint.child = body.name;
    joint.parent = parent;
    joint.axis = Vector3d::UnitY();
    joint.damping = 0.1;
    if (i == 0) joint.X_PF.R = rotation(kDown, Vector3d::UnitY()).R;
    if (i == kLinks / 2) joint.X_PF.R = rotation(-2 * kDown, Vector3d::UnitY()).R;
    if (i > 0) joint.X_PF.p = {kLink, 0, 0};
    spec.joints.push_back(joint);
    parent = body.name;
  }
  spec.pins.push_back({.a = parent, .b = "world", .p_AP = {kLink, 0, 0}, .p_BQ = {kSpan, 0, 0}});
  return compile(spec);
}

double sagOfChain(const Engine& engine) {
  const Model model = chain();
  const auto world = engine(model, {});
  world->run(10);
  double angle = kDown, sag = 0;
  for (int i = 0; i < kLinks / 2; ++i) {
    angle += world->state().q[i];
    sag += kLink * std::sin(angle);
  }
  return sag;
}

// The slope of link i is proportional to the weight between it and the middle; the span says how steep.
double sagByStatics() {
  const auto sumOf = [](double steepness, auto term) {
    double sum = 0;
    for (int i = 0; i < kLinks / 2; ++i) sum += kLink * term(std::atan(steepness * (i + 0.5)));
    return sum;
  };
  double lower = 0, upper = 100;
  for (int i = 0; i < 100; ++i) {
    const double middle = (lower + upper) / 2;
    (sumOf(middle, [](double a) { return std::cos(a); }) > kSpan / 2 ? lower : upper) = middle;
  }
  return sumOf(lower, [](double a) { return std::sin(a); });
}

// A bar that hangs on two equal arms: a parallelogram, closed by a pin.
constexpr double kArm = 0.4, kArmMass = 0.2, kBarMass = 2, kSwing = 0.1;
Model swing() {
  SceneSpec spec;
  const auto add = [&](const std::string& name, const std::string& parent, double mass, double length,
                       const Vector3d& along, const Vector3d& at) {
    BodySpec body;
    body.name = name;
    body.mass = mass;
    body.p_BBcm = length / 2 * along;
    body.inertia = mass * length * length / 12 * Eigen::Matrix3d::Identity();
    ShapeSpec shape;
    shape.shape = capsuleShape(0.02, length);
    shape.X_BS.p = body.p_BBcm;
    if (along.x() > 0) shape.X_BS.R = rotation(M_PI / 2, Vector3d::UnitY()).R;
    body.shapes.push_back(shape);
    spec.bodies.push_back(body);
    JointSpec joint;
    joint.name = joint.child = name;
    joint.parent = parent;
    joint.axis = Vector3d::UnitY();
    joint.X_PF.p = at;
    spec.joints.push_back(joint);
  };
  add("left", "world", kArmMass, kArm, {0, 0, -1}, {0, 0, 1});
  add("right", "world", kArmMass, kArm, {0, 0, -1}, {0.6, 0, 1});
  add("bar", "left", kBarMass, 0.6, {1, 0, 0}, {0, 0, -kArm});
  spec.pins.push_back({.a = "bar", .b = "right", .p_AP = {0.6, 0, 0}, .p_BQ = {0, 0, -kArm}});
  return compile(spec);
}

double periodOfSwing(const Engine& engine) {
  const Model model = swing();
  const auto world = engine(model, {});
  State state = initialState(model);
  state.q << kSwing, kSwing, -kSwing;
  world->setState(state);
  double first = -1, last = 0, before = kSwing;
  int crossings = 0;
  for (int i = 1; i <= 8000; ++i) {
    world->step();
    const double x = world->state().q[0];
    if (x * before < 0) {
      last = (i - x / (x - before)) * kStep;
      if (first < 0) first = last;
      ++crossings;
    }
    before = x;
  }
  return 2 * (last - first) / (crossings - 1);
}

}  // namespace

std::vector<ContactScene> turningScenes() {
  const double L = std::hypot(2 * kDiscAcross, 10 * kDiscAlong);
  const Model bars = swing();
  State raised = initialState(bars);
  raised.q << 0.4, 0.4, -0.4;
  return {{.name = "top",
           .quantity = "how far a top precesses in 1 s",
           .law = "I W^2 cos a - L W + m g l = 0",
           .unit = "rad",
           .formula = precessionRate(),
           .reached = 0.02,
           .measured = precessionOfTop,
           .model = top()},
          {.name = "wobble",
           .quantity = "how far the axis of a thrown disc turns in 1 s",
           .law = "L / I",
           .unit = "rad",
           .formula = L / kDiscAcross,
           .reached = 0.02,
           .measured = wobbleOfDisc,
           .model = disc()},
          {.name = "catenary",
           .quantity = "sag of a chain of 20 links of 2 m across 1.2 m",
           .law = "tan a_i = (i - 9.5) m g / H",
           .unit = "m",
           .formula = sagByStatics(),
           .reached = 1e-3,
           .measured = sagOfChain,
           .model = chain()},
          {.name = "loop",
           .quantity = "period of a bar on two arms, a closed loop",
           .law = "2 pi sqrt((M + 2m/3) l / ((M + m) g)) (1 + a^2 / 16)",
           .unit = "s",
           .formula = 2 * M_PI *
                      std::sqrt((kBarMass + 2 * kArmMass / 3) * kArm / ((kBarMass + kArmMass) * kGravity)) *
                      (1 + kSwing * kSwing / 16),
           .reached = 1e-3,
           .measured = periodOfSwing,
           .model = bars,
           .shown = raised.q}};
}

}  // namespace rex::contact
