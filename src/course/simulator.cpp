#include "course/simulator.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <variant>

#include <fmt/format.h>

#include "base/lower_case.h"
#include "base/require_finite.h"
#include "base/require_positive.h"
#include "base/rng.h"
#include "collision/collision_pairs.h"
#include "collision/contacts.h"
#include "collision/proxy_report.h"
#include "course/contact_world_internal.h"
#include "course/pictures.h"
#include "course/recording.h"
#include "dynamics/energy.h"
#include "dynamics/mass_matrix.h"
#include "dynamics/stepper.h"
#include "kinematics/center_of_mass.h"
#include "kinematics/jacobians.h"
#include "kinematics/task_maps.h"
#include "scene/find_scene.h"
#include "scene/ors_writer.h"
#include "scene/scene_edit.h"
#include "scene/scene_file.h"
#include "scene/srdf_reader.h"
#include "scene/srdf_writer.h"

namespace rex {
namespace {

// A scene as text; its name tells how that is read.
struct NamedText {
  std::string name, text;
};

// The text of the file, or where that needs other files, the scene written anew.
NamedText selfContainedText(const std::filesystem::path& file, const SceneSpec& spec) {
  std::string text = readSceneText(file);
  try {
    static_cast<void>(parseScene(text, file.string()));
    return {spec.name, std::move(text)};
  } catch (const Error&) {
    return {std::filesystem::path(spec.name).replace_extension(".ors").string(), writeOrs(spec)};
  }
}

// The scene of a description. Its text may come from another process, whose files are none of ours: meshes
// stay away.
SceneSpec parsed(const SimulatorDescription& description) {
  SceneFile scene = parseScene(description.sceneText, description.sceneName);
  if (!description.srdf.empty()) parseSrdf(description.srdf, description.sceneName, scene);
  return std::move(scene.spec);
}

// The choices of an SRDF; the texts of other scenes have their own.
std::string srdfOf(const std::filesystem::path& file, const SceneSpec& spec) {
  if (spec.collisionChoices.empty() || lowerCase(file.extension().string()) != ".urdf") return {};
  return writeSrdf(file.stem().string(), spec.collisionChoices);
}

// What may collide, or why that cannot be told: it matters only to those who ask.
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

}  // namespace

struct Simulator::Parts {
  std::string sceneName, sceneText, srdf;
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
  State next{};                      // where a step leads; its time is that of all steps
  internal::ContactWorld contactWorld{};

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
  TaskValue valueOf(const TaskMap& map) const {
    TaskValue value;
    map({model, q, poses}, value);
    return value;
  }
};

Simulator::Simulator(const std::string& sceneFile) {
  const std::filesystem::path path = findScene(sceneFile, REX_DATA_DIR);
  SceneFile scene = readScene(path, {.allowMissingMeshes = true});
  for (const Diagnostic& one : scene.notes)
    if (one.severity == Severity::kWarning) std::cerr << toString(one) << "\n";
  const bool hasEnding = std::filesystem::path(sceneFile).has_extension();
  scene.spec.name = hasEnding ? sceneFile : path.filename().string();
  const NamedText text = selfContainedText(path, scene.spec);
  const SimulatorDescription description{
      .sceneName = text.name, .sceneText = text.text, .q = {}, .srdf = srdfOf(path, scene.spec)};
  start(description, std::move(scene.spec));
  for (const Diagnostic& one : collisionWarnings(parts_->model)) std::cerr << toString(one) << "\n";
}

Simulator::Simulator(const SimulatorDescription& description) { start(description, parsed(description)); }

void Simulator::start(const SimulatorDescription& description, SceneSpec spec) {
  Model model = compile(spec);
  Contacts contacts = contactsOf(model);
  const Eigen::VectorXd q = description.q.size() > 0 ? description.q : model.initialPositions();
  parts_.reset(new Parts{description.sceneName, description.sceneText, description.srdf,
                         std::make_shared<const SceneSpec>(std::move(spec)), std::move(model),
                         std::move(contacts)});
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

Eigen::VectorXd Simulator::getJointAngles() const { return parts_->q; }

void Simulator::setJointAngles(const Eigen::VectorXd& q) {
  requireNumbers("setJointAngles", "angle", q, parts_->model.nq());
  parts_->moveTo(q, parts_->v);
  parts_->recording.add(q);
}

void Simulator::setJointAngles(const Eigen::VectorXd& q, double tau) {
  requireNumbers("setJointAngles", "angle", q, parts_->model.nq());
  requirePositive("setJointAngles: seconds", tau);
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
  F = motion.F;
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
  parts_->contactWorld.step(parts_->model, parts_->gravity_W(), u, tau, parts_->next);
  parts_->moveTo(parts_->next.q, parts_->next.v);
  parts_->recording.step(parts_->q, tau);
}

void Simulator::setDynamicSimulationNoise(double noise) {
  if (!(noise >= 0) || !std::isfinite(noise)) {
    throw Error({.what = "setDynamicSimulationNoise",
                 .found = fmt::format("{:g}", noise),
                 .wanted = "zero or a positive, finite number"});
  }
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
  if (!(margin > 0) || !std::isfinite(margin)) {
    throw Error({.what = "setContactMargin",
                 .found = fmt::format("{:g}", margin),
                 .wanted = "a positive, finite number of metres"});
  }
  parts_->contactMargin = margin;
}

std::string Simulator::proxyReport() const {
  const double reach = std::max(kQueryCutoff, parts_->contactMargin);
  return rex::proxyReport(parts_->model, proxies(parts_->requireContacts(), parts_->poses, reach));
}

void Simulator::reportProxies() const { fmt::print("{}", proxyReport()); }

void Simulator::anchorKinematicChainIn(const std::string& body) {
  const std::string& root = parts_->model[parts_->model.body(body)].name;
  SceneSpec spec = reconfigureRoot(atPositions(*parts_->spec, parts_->q), root);
  // The name tells how the text is read, and the text is .ors now.
  spec.name = std::filesystem::path(parts_->sceneName).replace_extension(".ors").string();
  SimulatorDescription description = this->description();
  description.sceneName = spec.name;
  description.sceneText = writeOrs(spec);
  description.srdf.clear();
  description.q.resize(0);
  description.v.resize(0);
  start(description, std::move(spec));
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
  return {parts_->sceneName,    parts_->sceneText, parts_->q,    parts_->contactMargin, parts_->v,
          parts_->dynamicNoise, parts_->gravity,   parts_->seed, parts_->srdf};
}
const Model& Simulator::model() const { return parts_->model; }
const Recording& Simulator::recording() const { return parts_->recording; }
void Simulator::clearRecording() { parts_->recording.clear(); }

}  // namespace rex
