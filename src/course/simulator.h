#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace rex {

class Model;
class Recording;
struct Pose;
struct SceneSpec;
struct Shape;

/// Settings for reading a Simulator's scene.
struct SimulatorOptions {
  bool freeBase = false;  ///< the root of a .urdf robot moves freely: x y z and a quaternion come first in q
  std::string assetRoot{};  ///< folder of all files that the scene names; empty: the one above the scene's
  bool strict = false;  ///< faults that are otherwise repaired with a warning are Errors, also a missing mesh
  std::string srdf{};   ///< of a .urdf robot; empty: NAME.srdf beside NAME.urdf or in ../srdf, if any
  /// Whether meshes have the axes of their Collada files; unset: those of a .urdf have, as in ROS, and others
  /// are turned to z up.
  std::optional<bool> ignoresUpAxis{};
  /// Where it starts: a name of Model::postures(), such as "key:home"; empty: the posture of the file.
  std::string posture{};
};

/// Everything needed to make the same simulator elsewhere: the text of its scene, a posture and settings.
struct SimulatorDescription {
  std::string sceneName;       ///< stands for the file in messages
  std::string sceneText;       ///< the text of the file
  Eigen::VectorXd q;           ///< joint angles; empty: the posture of the file
  double contactMargin = 0.1;  ///< metres, see Simulator::setContactMargin()
  Eigen::VectorXd v{};         ///< joint velocities; empty: at rest
  double dynamicNoise = 0;     ///< see Simulator::setDynamicSimulationNoise()
  bool gravity = true;         ///< see Simulator::setDynamicGravity()
  std::uint64_t seed = 0;      ///< seed of the noise
  std::string srdf{};          ///< the SRDF of a URDF robot, about its collisions; empty: none
};

/// What Simulator::inverseKinematics() found.
struct ReachedPosture {
  bool isReached = false;  ///< within 1e-6 metres and radians
  Eigen::VectorXd q{};     ///< n joint angles within their limits; the nearest posture found if none reaches
  double error = 0;        ///< the largest remaining difference, metres or radians
  std::string message{};   ///< says how far the target is missed
};

/// Two shapes that touch. A shape without a name of its own is called as in Simulator::proxyReport().
struct SimulatorContact {
  std::string shapeA, shapeB;
  Eigen::Vector3d p_WA, p_WB;  ///< the nearest points on each, metres
  Eigen::Vector3d normal_W;    ///< unit, from B to A
  double distance = 0;         ///< metres, negative in overlap
  double force = 0;            ///< with which B pushes A along the normal, newtons
};

/// A robot in its world, with the method names of the course script. Positions are in metres in the world
/// frame, z up; angles are in radians. Bodies are named as in the scene; the name of a shape stands for its
/// body. Every method that takes a name throws Error with the closest names if it is unknown; every method
/// that takes a vector throws Error with both sizes if its size is wrong.
class Simulator {
 public:
  /// Loads an .ors, .urdf or MuJoCo .xml file: a path, or the name of one of the course's scenes, such as
  /// "man.ors". Throws Error with file:line:column if the scene is missing or broken or a mesh is broken,
  /// for a free base or an SRDF with another format than they are for, and for an unknown posture. Boxes
  /// replace missing meshes unless `strict`; warnings of the reader and of collisionWarnings() are printed.
  explicit Simulator(const std::string& sceneFile, const SimulatorOptions& options = {});
  /// Reads no file, so shapes described by a mesh are not drawn.
  explicit Simulator(const SimulatorDescription& description);
  Simulator(const Simulator& other);
  Simulator& operator=(const Simulator& other);
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;
  ~Simulator();

  /// n, the number of joint angles.
  int getJointDimension() const;
  /// Their names: that of the joint, such as "elbow", or "base [0]", "base [1]", ... for a joint with
  /// several angles.
  std::vector<std::string> getJointNames() const;
  /// Their limits, n numbers each; infinite where there are none.
  Eigen::VectorXd getLowerLimits() const;
  Eigen::VectorXd getUpperLimits() const;
  /// All bodies, in the order of the scene.
  std::vector<std::string> getBodyNames() const;
  /// The joint angles q, n numbers.
  Eigen::VectorXd getJointAngles() const;
  void getJointAngles(Eigen::VectorXd& q) const { q = getJointAngles(); }
  /// Moves the robot to q (n finite numbers) and records the posture for pictures. The first posture that
  /// is set replaces that of the file in the recording, so that films and traces begin with the motion.
  void setJointAngles(const Eigen::VectorXd& q);
  /// The same, tau seconds after the previous posture, so that films and replays play in real time. Throws
  /// Error unless tau is positive.
  void setJointAngles(const Eigen::VectorXd& q, double tau);

  /// World position of the point `rel` of a body, given in the body's frame; by default the body's origin.
  /// Slide 2:53.
  Eigen::Vector3d kinematicsPos(const std::string& body,
                                const Eigen::Vector3d& rel = Eigen::Vector3d::Zero()) const;
  void kinematicsPos(Eigen::VectorXd& y, const std::string& body,
                     const Eigen::Vector3d& rel = Eigen::Vector3d::Zero()) const;
  /// Its Jacobian with respect to q, 3 x n.
  Eigen::MatrixXd jacobianPos(const std::string& body,
                              const Eigen::Vector3d& rel = Eigen::Vector3d::Zero()) const;
  void jacobianPos(Eigen::MatrixXd& J, const std::string& body,
                   const Eigen::Vector3d& rel = Eigen::Vector3d::Zero()) const;

  /// A posture that brings a body's frame to X_WB, or the point `rel` of the body to p_W (metres). The
  /// search starts at the present posture and continues from random ones; its result is the same each time.
  /// For a pose of an arm of six hinges that has a closed form, it is the nearest of all its postures.
  /// The robot does not move. Programs must link the library course_inverse_kinematics; `rex run FILE.cpp`
  /// adds it by itself. Slide 2:27; see kinematics/inverse_kinematics_solver.h for several tasks at once.
  [[nodiscard]] ReachedPosture inverseKinematics(const std::string& body, const Pose& X_WB) const;
  [[nodiscard]] ReachedPosture inverseKinematics(const std::string& body, const Eigen::Vector3d& p_W,
                                                 const Eigen::Vector3d& rel = Eigen::Vector3d::Zero()) const;

  /// The same among the postures in which all shapes that may collide, obstacles included, are `clearance` >
  /// 0 metres apart (for a place, up to a millionth of it). Throws Error as kinematicsContacts().
  [[nodiscard]] ReachedPosture inverseKinematics(const std::string& body, const Pose& X_WB,
                                                 double clearance) const;
  [[nodiscard]] ReachedPosture inverseKinematics(const std::string& body, const Eigen::Vector3d& p_W,
                                                 const Eigen::Vector3d& rel, double clearance) const;

  /// World direction of the vector `vec`, fixed in a body; by default the body's z axis. Slide 2:54.
  Eigen::Vector3d kinematicsVec(const std::string& body,
                                const Eigen::Vector3d& vec = Eigen::Vector3d::UnitZ()) const;
  void kinematicsVec(Eigen::VectorXd& y, const std::string& body,
                     const Eigen::Vector3d& vec = Eigen::Vector3d::UnitZ()) const;
  /// Its Jacobian with respect to q, 3 x n.
  Eigen::MatrixXd jacobianVec(const std::string& body,
                              const Eigen::Vector3d& vec = Eigen::Vector3d::UnitZ()) const;
  void jacobianVec(Eigen::MatrixXd& J, const std::string& body,
                   const Eigen::Vector3d& vec = Eigen::Vector3d::UnitZ()) const;

  /// Orientation of a body: the unit quaternion w, x, y, z of its frame in the world, w >= 0. Slide 2:10.
  Eigen::Vector4d kinematicsQuat(const std::string& body) const;
  void kinematicsQuat(Eigen::VectorXd& y, const std::string& body) const;
  /// Its Jacobian with respect to q, 4 x n. At w = 0 the quaternion jumps to its opposite.
  Eigen::MatrixXd jacobianQuat(const std::string& body) const;
  void jacobianQuat(Eigen::MatrixXd& J, const std::string& body) const;

  /// Centre of mass, x and y only, as in the course. Throws Error for a scene without mass. Slide 2:61.
  Eigen::Vector2d kinematicsCOM() const;
  void kinematicsCOM(Eigen::VectorXd& y) const;
  /// Its Jacobian with respect to q, 2 x n.
  Eigen::MatrixXd jacobianCOM() const;
  void jacobianCOM(Eigen::MatrixXd& J) const;

  /// Contact cost, one number: the sum of 1 - d / margin over all pairs of shapes that may collide and
  /// whose distance d is below the margin; negative d is overlap. Slide 2:60, see collision/contacts.h.
  /// Throws Error if a shape that may collide lacks the mesh it needs.
  Eigen::VectorXd kinematicsContacts() const;
  void kinematicsContacts(Eigen::VectorXd& y) const;
  /// Its Jacobian with respect to q, 1 x n.
  Eigen::MatrixXd jacobianContacts() const;
  void jacobianContacts(Eigen::MatrixXd& J) const;
  /// Sets the margin of the contact cost, metres; initially 0.1. Throws Error unless it is positive and
  /// finite.
  void setContactMargin(double margin);
  /// Prints proxyReport().
  void reportProxies() const;
  /// The pairs of shapes nearer than 0.5 m (or the margin, if that is more), nearest first: their names,
  /// distance and nearest points, metres.
  std::string proxyReport() const;

  /// Joint angles and velocities, as many as there are; a quaternion has four angles, but three velocities.
  /// setJointAngles() leaves the velocities as they are; initially the robot is at rest.
  void getJointAnglesAndVels(Eigen::VectorXd& q, Eigen::VectorXd& qdot) const;
  Eigen::VectorXd getJointVels() const;
  void setJointAnglesAndVels(const Eigen::VectorXd& q, const Eigen::VectorXd& qdot);
  /// M (n x n) and F (n) of the equation of motion M qddot + F = u, at the present angles and velocities.
  /// Slide 3:28.
  void getDynamics(Eigen::MatrixXd& M, Eigen::VectorXd& F) const;
  /// Kinetic plus potential energy, joules; a body at height z has the potential energy m 9.81 z.
  double getEnergy() const;
  /// Simulates tau > 0 seconds under constant joint forces u (one per velocity, N m or N): one Runge-Kutta
  /// step, without contacts, limits or friction, then the noise. Records the posture. Throws Error, and
  /// moves nothing, for numbers that are not finite, for a joint that moves no mass, and for a motion that
  /// grows without bounds, naming its time since the first step.
  void stepDynamics(const Eigen::VectorXd& u, double tau);
  /// The same with contacts between all shapes that may collide, with limits, damping and friction of the
  /// joints, and without noise, by Bullet in steps of at most a millisecond. The contact friction is 0.6,
  /// nothing bounces, and meshes collide as their convex hulls. A copy made in contact starts without the
  /// last contact forces, so its motion is close to the original's but not bitwise equal. Throws like
  /// PhysicsWorld (physics/physics_world.h), for example for a ball joint that mimics another; the robot
  /// then stays where it was.
  void stepPhysics(const Eigen::VectorXd& u, double tau);
  /// The same without joint forces other than those of motors.
  void stepPhysics(double tau);
  /// From now on stepPhysics() drives a joint, named as in getJointNames(), to a position (radians or
  /// metres) or at a velocity, with at most maxForce (N m or N), until removeMotor(). Its entry in u must
  /// then be zero. Positions are approached as described at Motor (physics/physics_world.h). Motors are not
  /// part of description(). Throws Error for a ball or free joint and for invalid numbers.
  void setPositionMotor(const std::string& joint, double position, double maxForce);
  void setVelocityMotor(const std::string& joint, double velocity, double maxForce);
  void removeMotor(const std::string& joint);
  /// The contacts in the last inner step, of at most a millisecond, of the last stepPhysics(); empty before
  /// the first one and after addObstacle().
  std::vector<SimulatorContact> getContacts() const;
  /// From now on each stepDynamics() adds sqrt(tau) * noise * N(0, 1) to each velocity. The random numbers
  /// are the same in every run, see setSeed().
  void setDynamicSimulationNoise(double noise);
  void setDynamicsSimulationNoise(double noise) { setDynamicSimulationNoise(noise); }
  /// Turns gravity on (the default) or off for getDynamics, getEnergy, stepDynamics and stepPhysics.
  void setDynamicGravity(bool gravity);
  /// Restarts the noise with this seed.
  void setSeed(std::uint64_t seed);

  /// Puts a solid into the world at X_WS, as a body that never moves but may collide with everything that
  /// does. From now on kinematicsPos(), contacts, pictures and stepPhysics() know it; films show it from
  /// their beginning. Afterwards model() is a new one. Throws Error for a shape that is described by a mesh
  /// or has no volume, for sizes that are not positive, and for a name that is taken.
  void addObstacle(const Shape& shape, const Pose& X_WS, const std::string& name);

  /// Fixes `body` where it is now and makes it the root of its chain, such as a foot on the ground. The
  /// world looks as before, but joints count from the new root, so that the order and the signs of the
  /// entries of q may change. Afterwards the robot is at rest and without motors; recording, noise and time
  /// restart. Throws Error as reconfigureRoot() (scene/scene_edit.h), and for a mesh that is in no file.
  void anchorKinematicChainIn(const std::string& body);

  /// Draws the present posture into NAME.png. Never opens a window.
  void watch(const std::string& name = "watch") const;

  /// The scene as it is anchored now, with posture and settings: enough to make this simulator again.
  /// Throws Error as writeOrs() (formats/ors_writer.h) for scenes of several files, a free base and
  /// obstacles.
  SimulatorDescription description() const;
  /// The model that the core of rex works on; see scene/model.h.
  const Model& model() const;
  /// The postures since the start or the last clearRecording(), with the times of steps and of angles that
  /// were set with a tau. See course/pictures.h for pictures and films of it.
  const Recording& recording() const;
  void clearRecording();

 private:
  struct Parts;
  void start(const SimulatorDescription& description, SceneSpec spec, const std::string& posture);

  std::unique_ptr<Parts> parts_;
};

}  // namespace rex
