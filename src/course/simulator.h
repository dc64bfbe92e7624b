#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

namespace rex {

class Model;
class Recording;

/// All it takes to make the same simulator elsewhere: the text of its scene and a posture.
struct SimulatorDescription {
  std::string sceneName;  ///< stands for the file in messages
  std::string sceneText;  ///< the text of the file
  Eigen::VectorXd q;      ///< joint angles; empty: the posture of the file
};

/// A robot in its world, with the names of the course script. Positions are metres in the world frame, z up;
/// angles radians. Bodies are named as in the scene; a shape's name stands for its body. Every method that
/// takes a name throws Error with the closest names for an unknown one, every method that takes a vector
/// names both sizes for a wrong one.
class Simulator {
 public:
  /// Loads an .ors or .urdf file: a path, or the name of one of the course's scenes, such as "man.ors".
  /// Throws Error with file:line:column for a missing or broken file, also one of a mesh. Boxes stand for
  /// meshes that are missing; the reader's warnings are printed.
  explicit Simulator(const std::string& sceneFile);
  /// Reads no file: shapes described by a mesh are not drawn.
  explicit Simulator(const SimulatorDescription& description);
  Simulator(const Simulator& other);
  Simulator& operator=(const Simulator& other);
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;
  ~Simulator();

  /// n, the number of joint angles.
  int getJointDimension() const;
  /// The joint angles q, n numbers.
  Eigen::VectorXd getJointAngles() const;
  void getJointAngles(Eigen::VectorXd& q) const { q = getJointAngles(); }
  /// Moves the robot to q (n finite numbers) and records the posture for pictures.
  void setJointAngles(const Eigen::VectorXd& q);

  /// World position of the point `rel` of a body, given in the body's frame; by default its origin. Slide
  /// 2:53.
  Eigen::Vector3d kinematicsPos(const std::string& body,
                                const Eigen::Vector3d& rel = Eigen::Vector3d::Zero()) const;
  void kinematicsPos(Eigen::VectorXd& y, const std::string& body,
                     const Eigen::Vector3d& rel = Eigen::Vector3d::Zero()) const;
  /// Its Jacobian by q, 3 x n.
  Eigen::MatrixXd jacobianPos(const std::string& body,
                              const Eigen::Vector3d& rel = Eigen::Vector3d::Zero()) const;
  void jacobianPos(Eigen::MatrixXd& J, const std::string& body,
                   const Eigen::Vector3d& rel = Eigen::Vector3d::Zero()) const;

  /// World direction of the vector `vec` that is fixed to a body, by default its z axis. Slide 2:54.
  Eigen::Vector3d kinematicsVec(const std::string& body,
                                const Eigen::Vector3d& vec = Eigen::Vector3d::UnitZ()) const;
  void kinematicsVec(Eigen::VectorXd& y, const std::string& body,
                     const Eigen::Vector3d& vec = Eigen::Vector3d::UnitZ()) const;
  /// Its Jacobian by q, 3 x n.
  Eigen::MatrixXd jacobianVec(const std::string& body,
                              const Eigen::Vector3d& vec = Eigen::Vector3d::UnitZ()) const;
  void jacobianVec(Eigen::MatrixXd& J, const std::string& body,
                   const Eigen::Vector3d& vec = Eigen::Vector3d::UnitZ()) const;

  /// Centre of mass, x and y only, as in the course. Throws Error for a scene without mass. Slide 2:61.
  Eigen::Vector2d kinematicsCOM() const;
  void kinematicsCOM(Eigen::VectorXd& y) const;
  /// Its Jacobian by q, 2 x n.
  Eigen::MatrixXd jacobianCOM() const;
  void jacobianCOM(Eigen::MatrixXd& J) const;

  /// Draws the present posture into the picture NAME.png. Never opens a window.
  void watch(const std::string& name = "watch") const;

  /// The scene and the posture, enough to make this simulator again.
  SimulatorDescription description() const;
  /// What the core of rex works on; see scene/model.h.
  const Model& model() const;
  /// The postures since the start or the last clearRecording(). See course/pictures.h for what to make of it.
  const Recording& recording() const;
  void clearRecording();

 private:
  struct Parts;
  void start(const SimulatorDescription& description, Model model);

  std::unique_ptr<Parts> parts_;
};

}  // namespace rex
