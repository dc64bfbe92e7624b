#include "course/simulator.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <variant>

#include <fmt/format.h>

#include "base/folders.h"
#include "base/require.h"
#include "base/rng.h"
#include "base/text.h"
#include "collision/collision_pairs.h"
#include "collision/contacts.h"
#include "course/contact_world_internal.h"
#include "course/pictures.h"
#include "course/recording.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/joint_springs.h"
#include "dynamics/stepper.h"
#include "formats/assets.h"
#include "formats/ors_writer.h"
#include "formats/scene_file.h"
#include "formats/srdf.h"
#include "kinematics/center_of_mass.h"
#include "kinematics/jacobians.h"
#include "kinematics/task_maps.h"
#include "scene/scene_edit.h"
#include "scene/state.h"

namespace rex {
namespace {

// The scene of a description. Its text may come from another process, whose files are not ours: meshes are
// left out.
SceneSpec parsed(const SimulatorDescription& description) {
  SceneFile scene = parseScene(description.sceneText, description.sceneName);
  if (!description.srdf.empty()) parseSrdf(description.srdf, description.sceneName, scene);
  return std::move(scene.spec);
}

// The collision choices as an SRDF; other formats hold them in their own text.
std::string srdfOf(const std::filesystem::path& file, const SceneSpec& spec) {
  if (spec.collisionChoices.empty() || lowerCase(file.extension().string()) != ".urdf") return {};
  return writeSrdf(file.stem().string(), spec.collisionChoices);
}

ReadOptions readingOf(const std::filesystem::path& file, const SimulatorOptions& options) {
  if (!options.srdf.empty() && lowerCase(file.extension().string()) != ".urdf")
    throw Error({.what = "an SRDF", .where = {file.string()}, .wanted = "a .urdf robot"});
  if (options.freeBase && lowerCase(file.extension().string()) == ".ors")
    throw Error({.what = "free base",
                 .where = {file.string()},
                 .found = "an .ors scene",
                 .wanted = "a .urdf robot; an .ors scene has a joint of type free instead"});
  const UpAxis axis = options.ignoresUpAxis.value_or(true) ? UpAxis::kIgnored : UpAxis::kRespected;
  return {.assetRoot = options.assetRoot,
          .allowMissingMeshes = !options.strict,
          .freeBase = options.freeBase,
          .strict = options.strict,
          .srdf = options.srdf,
          .upAxis = options.ignoresUpAxis ? axis : UpAxis::kAsUsual};
}

// As text, without meshes that are in no file: readers of a text draw none.
std::string textOf(SceneSpec spec) {
  removeMeshesWithoutFile(spec);
  return writeOrs(spec);
}

std::string orsNameOf(const std::string& name) {
  return std::filesystem::path(name).replace_extension(".ors").string();
}

// The contact model, or the error to throw when contacts are queried.
using Contacts = std::variant<ContactModel, Error>;

Contacts contactsOf(const Model& model) {
  try {
    return ContactModel(model);
  } catch (const Error& error) {
    return error;
  }
}

void requireNumbers(const char* method, const char* what, const Eigen::VectorXd& numbers, int size) {
  requireSize(method, numbers.size(), size);
  for (Eigen::Index i = 0; i < size; ++i)
    requireFinite(fmt::format("{}: {} {}", method, what, i), numbers[i]);
}

void requireSolid(const Shape& shape, const std::string& name) {
  if (!usesMesh(shape.type) && shape.type != ShapeType::kMarker) return;
  throw Error({.what = fmt::format("addObstacle: shape of '{}'", name),
               .found = fmt::format("a {}", toString(shape.type)),
               .wanted = "a box, sphere, capsule, cylinder or rounded box"});
}

void requireNewName(const Model& model, const std::string& name) {
  const auto isTaken = [&](const auto& one) { return one.name == name; };
  if (!name.empty() && name != kWorldName && std::ranges::none_of(model.bodies(), isTaken) &&
      std::ranges::none_of(model.shapes(), isTaken))
    return;
  throw Error({.what = "addObstacle: name",
               .found = "'" + name + "'",
               .wanted = "one that no body and no shape of the scene has"});
}

}  // namespace

struct Simulator::Parts {
  std::string sceneName;
  std::string sceneText, srdf;            // no text where only the spec is complete
  std::shared_ptr<const SceneSpec> spec;  // never changes; copies of a simulator share it
  Model model;
  Contacts contacts;
  double contactMargin = kContactMargin;
  Eigen::VectorXd q{}, v{};
  BodyPoses poses{};
  Recording recording{};
  double dynamicNoise = 0;
  bool gravity = true;
  std::uint64_t seed = 0;
  Rng rng{};
  std::optional<Stepper> stepper{};  // made for the first step, and anew when gravity or noise change
  State next{};                      // where a step leads; its time counts all steps
  internal::ContactWorld contactWorld{};
  std::vector<Motor> motors{};  // nv

  // A posture that is refused changes nothing.
  void moveTo(const Eigen::VectorXd& newQ, const Eigen::VectorXd& newV) {
    forwardKinematics(model, newQ, poses);
    q = newQ;
    v = newV;
  }
  Eigen::Vector3d gravity_W() const { return gravity ? earthGravity() : Eigen::Vector3d::Zero(); }
  const ContactModel& requireContacts() const {
    if (const Error* error = std::get_if<Error>(&contacts)) throw *error;
    return std::get<ContactModel>(contacts);
  }
  // Only plain coordinates have motors.
  Motor& motorOf(const std::string& joint) {
    const std::vector<std::string> names = velocityNames(model);
    const auto found = std::find(names.begin(), names.end(), joint);
    if (found == names.end())
      throw Error({.what = fmt::format("scene '{}' has no joint '{}'", model.name(), joint),
                   .nearest = nearestNames(joint, names)});
    const auto iv = found - names.begin();
    const JointType type = jointOfVelocity(model, iv).type;
    if (positionCount(type) != velocityCount(type))
      throw Error({.what = fmt::format("motor of joint '{}'", joint),
                   .found = fmt::format("a {} joint", toString(type)),
                   .wanted = "a joint whose coordinates are angles and lengths"});
    return motors[static_cast<std::size_t>(iv)];
  }
  TaskValue valueOf(const TaskMap& map) const {
    TaskValue value;
    map({model, q, poses}, value);
    return value;
  }
};

Simulator::Simulator(const std::string& sceneFile, const SimulatorOptions& options) {
  const std::filesystem::path path = findScene(sceneFile, homeFolder() / "data");
  SceneFile scene = readScene(path, readingOf(path, options));
  for (const Diagnostic& one : grouped(scene.notes))
    if (one.severity == Severity::kWarning) std::cerr << toString(one) << "\n";
  const bool hasEnding = std::filesystem::path(sceneFile).has_extension();
  scene.spec.name = hasEnding ? sceneFile : path.filename().string();
  const SimulatorDescription description{.sceneName = scene.spec.name,
                                         .sceneText = options.freeBase ? "" : std::move(scene.text),
                                         .q = {},
                                         .srdf = srdfOf(path, scene.spec)};
  start(description, std::move(scene.spec), options.posture);
  for (const Diagnostic& one : collisionWarnings(parts_->model)) std::cerr << toString(one) << "\n";
  if (!parts_->model.pins().empty())
    std::cerr << parts_->model.name()
              << ": pins close loops here: stepPhysics() keeps them closed, everything else "
              << "sees the tree of joints only\n";
}

Simulator::Simulator(const SimulatorDescription& description) { start(description, parsed(description), ""); }

void Simulator::start(const SimulatorDescription& description, SceneSpec spec, const std::string& posture) {
  Model model = compile(spec);
  Contacts contacts = contactsOf(model);
  const Eigen::VectorXd q = description.q.size() > 0 ? description.q
                            : posture.empty()        ? model.initialPositions()
                                                     : model.posture(posture);
  parts_.reset(new Parts{description.sceneName, description.sceneText, description.srdf,
                         std::make_shared<const SceneSpec>(std::move(spec)), std::move(model),
                         std::move(contacts)});
  parts_->motors.resize(static_cast<std::size_t>(parts_->model.nv()));
  setContactMargin(description.contactMargin);
  setDynamicSimulationNoise(description.dynamicNoise);
  setDynamicGravity(description.gravity);
  setSeed(description.seed);
  setJointAnglesAndVels(q,
                        description.v.size() > 0 ? description.v : Eigen::VectorXd::Zero(parts_->model.nv()));
  parts_->recording.startAt(parts_->q);
}

Simulator::Simulator(const Simulator& other) : parts_(std::make_unique<Parts>(*other.parts_)) {}
Simulator& Simulator::operator=(const Simulator& other) {
  if (this != &other) parts_ = std::make_unique<Parts>(*other.parts_);
  return *this;
}
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;
Simulator::~Simulator() = default;

int Simulator::getJointDimension() const { return parts_->model.nq(); }

std::vector<std::string> Simulator::getJointNames() const { return positionNames(parts_->model); }

Eigen::VectorXd Simulator::getLowerLimits() const { return parts_->model.lowerLimits(); }

Eigen::VectorXd Simulator::getUpperLimits() const { return parts_->model.upperLimits(); }

std::vector<std::string> Simulator::getBodyNames() const {
  std::vector<std::string> names;
  for (const BodyId body : parts_->model.bodiesInFileOrder()) names.push_back(parts_->model[body].name);
  return names;
}

Eigen::VectorXd Simulator::getJointAngles() const { return parts_->q; }

void Simulator::setJointAngles(const Eigen::VectorXd& q) {
  requireNumbers("setJointAngles", "angle", q, parts_->model.nq());
  parts_->moveTo(q, parts_->v);
  parts_->recording.add(q);
}

void Simulator::setJointAngles(const Eigen::VectorXd& q, double tau) {
  requireNumbers("setJointAngles", "angle", q, parts_->model.nq());
  requirePositive("setJointAngles: duration", tau, kSeconds);
  parts_->moveTo(q, parts_->v);
  parts_->recording.add(q, tau);
}

Eigen::VectorXd Simulator::getJointVels() const { return parts_->v; }

void Simulator::getJointAnglesAndVels(Eigen::VectorXd& q, Eigen::VectorXd& qdot) const {
  q = parts_->q;
  qdot = parts_->v;
}

void Simulator::setJointAnglesAndVels(const Eigen::VectorXd& q, const Eigen::VectorXd& qdot) {
  requireNumbers("setJointAnglesAndVels", "angle", q, parts_->model.nq());
  requireNumbers("setJointAnglesAndVels", "velocity", qdot, parts_->model.nv());
  parts_->moveTo(q, qdot);
  parts_->recording.add(q);
}

void Simulator::getDynamics(Eigen::MatrixXd& M, Eigen::VectorXd& F) const {
  const EquationOfMotion motion = equationOfMotion(parts_->model, parts_->q, parts_->v, parts_->gravity_W());
  M = motion.M;
  F = motion.F - springForces(parts_->model, parts_->q);
}

double Simulator::getEnergy() const {
  return energy(parts_->model, parts_->q, parts_->v, parts_->gravity_W()).total();
}

void Simulator::stepDynamics(const Eigen::VectorXd& u, double tau) {
  if (!parts_->stepper) {
    const StepperOptions options{.gravity_W = parts_->gravity_W(), .noise = parts_->dynamicNoise};
    parts_->stepper.emplace(parts_->model, options);
  }
  parts_->next.q = parts_->q;
  parts_->next.v = parts_->v;
  parts_->stepper->step(parts_->next, u, tau, parts_->rng);
  parts_->moveTo(parts_->next.q, parts_->next.v);
  parts_->recording.step(parts_->q, tau);
}

void Simulator::stepPhysics(const Eigen::VectorXd& u, double tau) {
  parts_->next.q = parts_->q;
  parts_->next.v = parts_->v;
  parts_->contactWorld.step(parts_->model, parts_->gravity_W(), parts_->motors, u, tau, parts_->next);
  parts_->moveTo(parts_->next.q, parts_->next.v);
  parts_->recording.step(parts_->q, tau);
}

void Simulator::stepPhysics(double tau) { stepPhysics(Eigen::VectorXd::Zero(parts_->model.nv()), tau); }

void Simulator::setPositionMotor(const std::string& joint, double position, double maxForce) {
  requireFinite("setPositionMotor: position", position);
  requirePositive("setPositionMotor: maxForce", maxForce);
  parts_->motorOf(joint) = {.kind = Motor::Kind::kPosition, .target = position, .maxForce = maxForce};
}

void Simulator::setVelocityMotor(const std::string& joint, double velocity, double maxForce) {
  requireFinite("setVelocityMotor: velocity", velocity);
  requirePositive("setVelocityMotor: maxForce", maxForce);
  parts_->motorOf(joint) = {.kind = Motor::Kind::kVelocity, .target = velocity, .maxForce = maxForce};
}

void Simulator::removeMotor(const std::string& joint) { parts_->motorOf(joint) = {}; }

std::vector<SimulatorContact> Simulator::getContacts() const {
  std::vector<SimulatorContact> contacts;
  for (const PhysicsContact& one : parts_->contactWorld.contacts())
    contacts.push_back({shapeLabel(parts_->model, one.shapeA), shapeLabel(parts_->model, one.shapeB),
                        one.p_WA, one.p_WB, one.normal_W, one.distance,
                        one.impulse / parts_->contactWorld.innerStep()});
  return contacts;
}

void Simulator::setDynamicSimulationNoise(double noise) {
  requireNotNegative("setDynamicSimulationNoise", noise);
  parts_->dynamicNoise = noise;
  parts_->stepper.reset();
}

void Simulator::setDynamicGravity(bool gravity) {
  parts_->gravity = gravity;
  parts_->stepper.reset();
}

void Simulator::setSeed(std::uint64_t seed) {
  parts_->seed = seed;
  parts_->rng = Rng(seed);
}

Eigen::Vector3d Simulator::kinematicsPos(const std::string& body, const Eigen::Vector3d& rel) const {
  return position(parts_->poses, parts_->model.body(body), rel);
}

Eigen::MatrixXd Simulator::jacobianPos(const std::string& body, const Eigen::Vector3d& rel) const {
  return positionJacobian(parts_->model, parts_->poses, parts_->model.body(body), rel);
}

Eigen::Vector3d Simulator::kinematicsVec(const std::string& body, const Eigen::Vector3d& vec) const {
  return direction(parts_->poses, parts_->model.body(body), vec);
}

Eigen::MatrixXd Simulator::jacobianVec(const std::string& body, const Eigen::Vector3d& vec) const {
  return directionJacobian(parts_->model, parts_->poses, parts_->model.body(body), vec);
}

Eigen::Vector2d Simulator::kinematicsCOM() const {
  return centerOfMass(parts_->model, parts_->poses).head<2>();
}

Eigen::MatrixXd Simulator::jacobianCOM() const {
  return centerOfMassJacobian(parts_->model, parts_->poses).topRows<2>();
}

Eigen::Vector4d Simulator::kinematicsQuat(const std::string& body) const {
  return parts_->valueOf(quaternionTask(parts_->model.body(body))).y;
}

Eigen::MatrixXd Simulator::jacobianQuat(const std::string& body) const {
  return parts_->valueOf(quaternionTask(parts_->model.body(body))).J;
}

Eigen::VectorXd Simulator::kinematicsContacts() const {
  return Eigen::VectorXd::Constant(
      1, contactCost(parts_->requireContacts(), parts_->poses, parts_->contactMargin));
}

Eigen::MatrixXd Simulator::jacobianContacts() const {
  return parts_->valueOf(contactTask(parts_->requireContacts(), parts_->contactMargin)).J;
}

void Simulator::setContactMargin(double margin) {
  requirePositive("setContactMargin", margin, kMetres);
  parts_->contactMargin = margin;
}

std::string Simulator::proxyReport() const {
  const double reach = std::max(kQueryCutoff, parts_->contactMargin);
  return rex::proxyReport(parts_->model, proxies(parts_->requireContacts(), parts_->poses, reach));
}

void Simulator::reportProxies() const { fmt::print("{}", proxyReport()); }

void Simulator::addObstacle(const Shape& shape, const Pose& X_WS, const std::string& name) {
  requireSolid(shape, name);
  requireNewName(parts_->model, name);
  const Eigen::Vector4d kColor(0.85, 0.55, 0.3, 1);
  SceneSpec spec = *parts_->spec;
  BodySpec body{.name = name, .X_WB = X_WS, .kind = BodyKind::kStatic};
  body.shapes.push_back({.name = name, .X_BS = {}, .shape = shape, .color = kColor, .contact = true});
  spec.bodies.push_back(std::move(body));
  // An added obstacle counts even if the robot is in it already.
  spec.collisionChoices.push_back({.a = name, .b = "", .mayCollide = true, .reason = "an obstacle"});
  Model model = compile(spec);
  Contacts contacts = contactsOf(model);
  parts_->spec = std::make_shared<const SceneSpec>(std::move(spec));
  parts_->model = std::move(model);
  parts_->contacts = std::move(contacts);
  parts_->sceneText.clear();
  parts_->stepper.reset();
  parts_->contactWorld = {};
  parts_->moveTo(parts_->q, parts_->v);
}

void Simulator::anchorKinematicChainIn(const std::string& body) {
  const std::string& root = parts_->model[parts_->model.body(body)].name;
  SceneSpec spec = reconfigureRoot(atPositions(*parts_->spec, parts_->q), root);
  // The name decides how the text is read, and the text is .ors now.
  spec.name = orsNameOf(parts_->sceneName);
  const SimulatorDescription description{.sceneName = spec.name,
                                         .sceneText = textOf(spec),
                                         .q = {},
                                         .contactMargin = parts_->contactMargin,
                                         .dynamicNoise = parts_->dynamicNoise,
                                         .gravity = parts_->gravity,
                                         .seed = parts_->seed};
  start(description, std::move(spec), "");
}

// The script's forms with an output argument.
void Simulator::kinematicsPos(Eigen::VectorXd& y, const std::string& body, const Eigen::Vector3d& rel) const {
  y = kinematicsPos(body, rel);
}
void Simulator::jacobianPos(Eigen::MatrixXd& J, const std::string& body, const Eigen::Vector3d& rel) const {
  J = jacobianPos(body, rel);
}
void Simulator::kinematicsVec(Eigen::VectorXd& y, const std::string& body, const Eigen::Vector3d& vec) const {
  y = kinematicsVec(body, vec);
}
void Simulator::jacobianVec(Eigen::MatrixXd& J, const std::string& body, const Eigen::Vector3d& vec) const {
  J = jacobianVec(body, vec);
}
void Simulator::kinematicsCOM(Eigen::VectorXd& y) const { y = kinematicsCOM(); }
void Simulator::jacobianCOM(Eigen::MatrixXd& J) const { J = jacobianCOM(); }

void Simulator::kinematicsQuat(Eigen::VectorXd& y, const std::string& body) const {
  y = kinematicsQuat(body);
}
void Simulator::jacobianQuat(Eigen::MatrixXd& J, const std::string& body) const { J = jacobianQuat(body); }
void Simulator::kinematicsContacts(Eigen::VectorXd& y) const { y = kinematicsContacts(); }
void Simulator::jacobianContacts(Eigen::MatrixXd& J) const { J = jacobianContacts(); }

void Simulator::watch(const std::string& name) const { writePicture(*this, name + ".png"); }

SimulatorDescription Simulator::description() const {
  SimulatorDescription description{parts_->sceneName,     parts_->sceneText, parts_->q,
                                   parts_->contactMargin, parts_->v,         parts_->dynamicNoise,
                                   parts_->gravity,       parts_->seed,      parts_->srdf};
  if (!description.sceneText.empty()) return description;
  description.sceneName = orsNameOf(parts_->sceneName);
  description.sceneText = textOf(*parts_->spec);
  description.srdf.clear();
  return description;
}
const Model& Simulator::model() const { return parts_->model; }
const Recording& Simulator::recording() const { return parts_->recording; }
void Simulator::clearRecording() { parts_->recording.clear(); }

}  // namespace rex
