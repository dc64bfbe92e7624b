#include "course/simulator.h"

#include <cmath>
#include <filesystem>
#include <iostream>

#include <fmt/format.h>

#include "course/pictures.h"
#include "course/recording.h"
#include "kinematics/center_of_mass.h"
#include "kinematics/jacobians.h"
#include "scene/find_scene.h"
#include "scene/ors_writer.h"
#include "scene/scene_file.h"

namespace rex {
namespace {

// The text of the file, or where that needs other files, the scene written anew.
std::string selfContainedText(const std::filesystem::path& file, const SceneSpec& spec) {
  std::string text = readSceneText(file);
  try {
    static_cast<void>(parseScene(text, file.string()));
    return text;
  } catch (const Error&) {
    return writeOrs(spec);
  }
}

}  // namespace

struct Simulator::Parts {
  std::string sceneName, sceneText;
  Model model;
  Eigen::VectorXd q;
  BodyPoses poses;
  Recording recording;
};

Simulator::Simulator(const std::string& sceneFile) {
  const std::filesystem::path path = findScene(sceneFile, REX_DATA_DIR);
  SceneFile scene = readScene(path, {.allowMissingMeshes = true});
  for (const Diagnostic& one : scene.notes)
    if (one.severity == Severity::kWarning) std::cerr << toString(one) << "\n";
  const bool hasEnding = std::filesystem::path(sceneFile).has_extension();
  scene.spec.name = hasEnding ? sceneFile : path.filename().string();
  start({.sceneName = scene.spec.name, .sceneText = selfContainedText(path, scene.spec), .q = {}},
        compile(scene.spec));
}

// The text may come from another process, whose files are none of ours: meshes stay away.
Simulator::Simulator(const SimulatorDescription& description) {
  start(description, compile(parseScene(description.sceneText, description.sceneName).spec));
}

void Simulator::start(const SimulatorDescription& description, Model model) {
  const Eigen::VectorXd q = description.q.size() > 0 ? description.q : model.initialPositions();
  parts_.reset(new Parts{description.sceneName, description.sceneText, std::move(model), q, {}, {}});
  setJointAngles(q);
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
  requireSize("setJointAngles", q.size(), parts_->model.nq());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    if (!std::isfinite(q[i])) {
      throw Error({.what = fmt::format("setJointAngles: angle {}", i),
                   .found = fmt::format("{}", q[i]),
                   .wanted = "a finite number"});
    }
  }
  parts_->q = q;
  forwardKinematics(parts_->model, q, parts_->poses);
  parts_->recording.add(q);
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

void Simulator::watch(const std::string& name) const { writePicture(*this, name + ".png"); }

SimulatorDescription Simulator::description() const {
  return {parts_->sceneName, parts_->sceneText, parts_->q};
}
const Model& Simulator::model() const { return parts_->model; }
const Recording& Simulator::recording() const { return parts_->recording; }
void Simulator::clearRecording() { parts_->recording.clear(); }

}  // namespace rex
