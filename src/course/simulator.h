#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace rex {

class Model;
class Recording;
struct Pose;
struct SceneSpec;
struct Shape;

/// How a Simulator reads its scene.
struct SimulatorOptions {
  bool freeBase = false;  ///< the root of a .urdf robot moves freely: x y z and a quaternion come first in q
  std::string assetRoot{};  ///< folder of all files that the scene names; empty: the one above the scene's
  bool strict = false;      ///< what is repaired otherwise, with a warning, is an Error, also a missing mesh
};

/// All it takes to make the same simulator elsewhere: the text of its scene, a posture, and what was set.
struct SimulatorDescription {
  std::string sceneName;       ///< stands for the file in messages
  std::string sceneText;       ///< the text of the file
  Eigen::VectorXd q;           ///< joint angles; empty: the posture of the file
  double contactMargin = 0.1;  ///< metres, see Simulator::setContactMargin()
  Eigen::VectorXd v{};         ///< joint velocities; empty: at rest
  double dynamicNoise = 0;     ///< see Simulator::setDynamicSimulationNoise()
  bool gravity = true;         ///< see Simulator::setDynamicGravity()
  std::uint64_t seed = 0;      ///< of the noise
  std::string srdf{};          ///< what the SRDF of a URDF robot says about collisions; empty: nothing
};

/// What Simulator::inverseKinematics() found.
struct ReachedPosture {
  bool isReached = false;  ///< within 1e-6 metres and radians
  Eigen::VectorXd q{};     ///< n joint angles within their limits; the nearest posture if none reaches
  double error = 0;        ///< the largest difference that is left, metres or radians
  std::string message{};   ///< says how far off it is
};

/// Two shapes that touch; without a name of its own a shape is called as in Simulator::proxyReport().
struct SimulatorContact {
  std::string shapeA, shapeB;
  Eigen::Vector3d p_WA, p_WB;  ///< the nearest points on each, metres
  Eigen::Vector3d normal_W;    ///< unit, from B to A
  double distance = 0;         ///< metres, negative in overlap
  double force = 0;            ///< newtons along the normal, with which B pushes A
};

/// A robot in its world, with the names of the course script. Positions are metres in the world frame, z up;
/// angles radians. Bodies are named as in the scene; a shape's name stands for its body. Every method that
/// takes a name throws Error with the closest names for an unknown one, every method that takes a vector
/// names both sizes for a wrong one.
class Simulator {
 public:
  /// Loads an .ors, .urdf or MuJoCo .xml file: a path, or the name of one of the course's scenes, such as
  /// "man.ors". Throws Error with file:line:column for a missing or broken file, also one of a mesh, and for
  /// a free base of an .ors scene. Boxes stand for meshes that are missing; warnings of the reader and of
  /// collisionWarnings() are printed.
  explicit Simulator(const std::string& sceneFile, const SimulatorOptions& options = {});
  /// Reads no file: shapes described by a mesh are not drawn.
  explicit Simulator(const SimulatorDescription& description);
  Simulator(const Simulator& other);
  Simulator& operator=(const Simulator& other);
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;
  ~Simulator();

  /// n, the number of joint angles.
  int getJointDimension() const;
  /// What each of them belongs to: "elbow", or of a joint with several "base [0]", "base [1]", ...
  std::vector<std::string> getJointNames() const;
  /// Their limits, n numbers each; infinite where there are none.
  Eigen::VectorXd getLowerLimits() const;
  Eigen::VectorXd getUpperLimits() const;
  /// All bodies, in the order of the scene.
  std::vector<std::string> getBodyNames() const;
  /// The joint angles q, n numbers.
  Eigen::VectorXd getJointAngles() const;
  void getJointAngles(Eigen::VectorXd& q) const { q = getJointAngles(); }
  /// Moves the robot to q (n finite numbers) and records the posture for pictures. The first posture that is
  /// set takes the place of the one of the file, so that films and traces begin with the motion.
  void setJointAngles(const Eigen::VectorXd& q);
  /// The same, tau seconds after the posture before: films and replays then play in real time. Throws Error
  /// unless tau is positive.
  void setJointAngles(const Eigen::VectorXd& q, double tau);

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

  /// A posture that brings a body's frame to X_WB, or the point `rel` of the body to p_W, metres: the search
  /// begins at the present posture and goes on at random ones. The same each time; the robot does not move.
  /// A program needs the library course_inverse_kinematics; `rex run FILE.cpp` adds it by itself. Slide
  /// 2:27; see kinematics/inverse_kinematics_solver.h for more tasks at once.
  [[nodiscard]] ReachedPosture inverseKinematics(const std::string& body, const Pose& X_WB) const;
  [[nodiscard]] ReachedPosture inverseKinematics(const std::string& body, const Eigen::Vector3d& p_W,
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

  /// Orientation of a body: the unit quaternion w, x, y, z of its frame in the world, w >= 0. Slide 2:10.
  Eigen::Vector4d kinematicsQuat(const std::string& body) const;
  void kinematicsQuat(Eigen::VectorXd& y, const std::string& body) const;
  /// Its Jacobian by q, 4 x n. Where w is 0, the quaternion jumps to its opposite.
  Eigen::MatrixXd jacobianQuat(const std::string& body) const;
  void jacobianQuat(Eigen::MatrixXd& J, const std::string& body) const;

  /// Centre of mass, x and y only, as in the course. Throws Error for a scene without mass. Slide 2:61.
  Eigen::Vector2d kinematicsCOM() const;
  void kinematicsCOM(Eigen::VectorXd& y) const;
  /// Its Jacobian by q, 2 x n.
  Eigen::MatrixXd jacobianCOM() const;
  void jacobianCOM(Eigen::MatrixXd& J) const;

  /// Contact cost, one number: the sum over all pairs of shapes that may collide of 1 - d / margin where
  /// their distance d is below the margin; negative d is overlap. Slide 2:60, see collision/contacts.h.
  /// Throws Error if a shape that may collide has no mesh.
  Eigen::VectorXd kinematicsContacts() const;
  void kinematicsContacts(Eigen::VectorXd& y) const;
  /// Its Jacobian by q, 1 x n.
  Eigen::MatrixXd jacobianContacts() const;
  void jacobianContacts(Eigen::MatrixXd& J) const;
  /// Sets the margin of the contact cost, metres; 0.1 at first. Throws Error unless it is positive and
  /// finite.
  void setContactMargin(double margin);
  /// Prints proxyReport().
  void reportProxies() const;
  /// The pairs of shapes nearer than 0.5 m (or the margin, if that is more), nearest first: their names,
  /// distance and nearest points, metres.
  std::string proxyReport() const;

  /// Joint angles and velocities: n numbers each, or v one less for each ball joint (see Joint::nv). Angles
  /// set by setJointAngles() leave the velocities as they are; at first the robot is at rest.
  void getJointAnglesAndVels(Eigen::VectorXd& q, Eigen::VectorXd& qdot) const;
  Eigen::VectorXd getJointVels() const;
  void setJointAnglesAndVels(const Eigen::VectorXd& q, const Eigen::VectorXd& qdot);
  /// M (n x n) and F (n) of the equation of motion M qddot + F = u, at the present angles and velocities.
  /// Slide 3:28.
  void getDynamics(Eigen::MatrixXd& M, Eigen::VectorXd& F) const;
  /// Kinetic and potential energy, joules; a body at height z has m 9.81 z.
  double getEnergy() const;
  /// Moves the robot on by tau > 0 seconds under the joint forces u (one per velocity, N m or N), held:
  /// one step of Runge and Kutta, without contacts, limits or friction, and then the noise. Records the
  /// posture. Throws Error, and moves nothing, for numbers that are not finite, for a joint that moves no
  /// mass, and for a motion that grows without bounds, with its time, which counts from the first step.
  void stepDynamics(const Eigen::VectorXd& u, double tau);
  /// The same with contact between all shapes that may collide, with limits, damping and friction of the
  /// joints, and without noise: by Bullet, in steps of at most a millisecond. Friction is 0.6, nothing
  /// bounces, and meshes collide as their convex hulls. A copy in contact starts without the forces found
  /// last: it goes on like the original, but not to the bit. Throws Error as PhysicsWorld
  /// (physics/physics_world.h), also for joints that mimic others and for screws; the robot then stays where
  /// it was.
  void stepPhysics(const Eigen::VectorXd& u, double tau);
  /// The same with no forces but those of motors.
  void stepPhysics(double tau);
  /// From now on stepPhysics() drives a joint, called as by getJointNames(), to a position (radians or
  /// metres) or keeps its velocity, with at most maxForce (N m or N), until removeMotor(). Its number in u
  /// must then be zero. Positions are approached as by Motor (physics/physics_world.h). Motors are not part
  /// of description(). Throws Error for a ball or free joint and for numbers that make no sense.
  void setPositionMotor(const std::string& joint, double position, double maxForce);
  void setVelocityMotor(const std::string& joint, double velocity, double maxForce);
  void removeMotor(const std::string& joint);
  /// What touched in the last millisecond of the last stepPhysics(); nothing before that, and none after
  /// addObstacle().
  std::vector<SimulatorContact> getContacts() const;
  /// From now on each stepDynamics() adds sqrt(tau) * noise * N(0, 1) to each velocity. The numbers are the
  /// same in every run, see setSeed().
  void setDynamicSimulationNoise(double noise);
  void setDynamicsSimulationNoise(double noise) { setDynamicSimulationNoise(noise); }
  /// Turns gravity on (as it is at first) or off, for getDynamics, getEnergy, stepDynamics and stepPhysics.
  void setDynamicGravity(bool gravity);
  /// Starts the noise anew, with other numbers for another seed.
  void setSeed(std::uint64_t seed);

  /// Puts a solid into the world at X_WS, as a body that never moves: kinematicsPos(), contacts, pictures and
  /// stepPhysics() know it from now on; films show it from their beginning. It may collide with all that
  /// moves. model() is a new one afterwards. Throws Error for a shape that is described by a mesh or has no
  /// volume, for sizes that are not positive, and for a name that is taken.
  void addObstacle(const Shape& shape, const Pose& X_WS, const std::string& name);

  /// Holds `body` where it stands now and hangs the rest of its chain on it, as on a foot that stands on the
  /// ground. The world looks as before, but joints count from the new root, so that the numbers of q may
  /// stand in another order and with another sign. The robot is at rest afterwards, without motors;
  /// recording, noise and time start anew. Throws Error as reconfigureRoot() (scene/scene_edit.h), and for a
  /// mesh that is in no file.
  void anchorKinematicChainIn(const std::string& body);

  /// Draws the present posture into the picture NAME.png. Never opens a window.
  void watch(const std::string& name = "watch") const;

  /// The scene as it is anchored now, posture and margin: enough to make this simulator again. Throws Error
  /// as writeOrs() (scene/ors_writer.h) for scenes of several files, a free base and obstacles.
  SimulatorDescription description() const;
  /// What the core of rex works on; see scene/model.h.
  const Model& model() const;
  /// The postures since the start or the last clearRecording(), with the times of steps, and of angles that
  /// were set with one. See course/pictures.h for what to make of it.
  const Recording& recording() const;
  void clearRecording();

 private:
  struct Parts;
  void start(const SimulatorDescription& description, SceneSpec spec);

  std::unique_ptr<Parts> parts_;
};

}  // namespace rex
