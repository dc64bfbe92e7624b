// Rows of `rex dev bench` measured from the outside: peers alone, by their public interfaces, with no code of
// rex and another clock. Prints JSON {"row": nanoseconds}; scripts/check-peers compares.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include <btBulletDynamicsCommon.h>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/treejnttojacsolver.hpp>
#include <time.h>

namespace {

double processorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The smallest of several means, nanoseconds.
double nanoseconds(const std::function<void()>& work, int calls) {
  double smallest = INFINITY;
  for (int repetition = 0; repetition < 15; ++repetition) {
    const double before = processorSeconds();
    for (int i = 0; i < calls; ++i) work();
    smallest = std::min(smallest, (processorSeconds() - before) / calls);
  }
  return 1e9 * smallest;
}

void print(const char* row, double value, const char* end = ",") {
  std::printf("  \"%s\": %.1f%s\n", row, value, end);
}

// The seven hinges of row fk-arm7: offset and roll of each joint frame in the one before.
void measureArm() {
  const double frames[7][4] = {{0, 0, .33, 0},     {0, 0, 0, -1}, {0, -.32, 0, 1}, {.08, 0, 0, 1},
                               {-.08, .38, 0, -1}, {0, 0, 0, 1},  {.09, 0, 0, 1}};
  KDL::Chain chain;
  KDL::Tree tree("world");
  std::string before = "world";
  for (int i = 0; i < 7; ++i) {
    const auto& [x, y, z, quarters] = frames[i];
    const KDL::Frame X(KDL::Rotation::RotX(quarters * M_PI / 2), KDL::Vector(x, y, z));
    const std::string name = "link" + std::to_string(i);
    const KDL::Segment segment(name, KDL::Joint(name, X.p, X.M * KDL::Vector(0, 0, 1), KDL::Joint::RotAxis),
                               X);
    chain.addSegment(segment);
    tree.addSegment(segment, before);
    before = name;
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-2, 2);
  std::vector<KDL::JntArray> Q(16, KDL::JntArray(7));
  for (KDL::JntArray& q : Q)
    for (unsigned i = 0; i < 7; ++i) q(i) = angle(random);
  KDL::ChainFkSolverPos_recursive fk(chain);
  KDL::TreeJntToJacSolver jacobian(tree);
  std::vector<KDL::Frame> poses(7);
  KDL::Jacobian J(7);
  std::size_t k = 0;
  print("fk-arm7", nanoseconds([&] { fk.JntToCart(Q[k = (k + 1) % 16], poses); }, 50000));
  print("jacobian-arm7", nanoseconds([&] { jacobian.JntToJac(Q[k = (k + 1) % 16], J, "link6"); }, 50000));
}

// Twenty boxes of .2 m at rest on a plane, with Bullet's own ten iterations.
void measureBoxes() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity({0, 0, -9.81});
  world.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  btBoxShape ground({50, 50, .5}), box({.1, .1, .1});
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  const auto add = [&](double mass, btBoxShape& shape, const btVector3& place) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    bodies.push_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
    bodies.back()->setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), place));
    bodies.back()->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(bodies.back().get());
  };
  add(0, ground, {0, 0, -.5});
  for (int i = 0; i < 20; ++i) add(1, box, {.5 * (i % 5), .5 * (i / 5), .1});
  for (int i = 0; i < 500; ++i) world.stepSimulation(1e-3, 0);
  print("boxes-20", nanoseconds([&] { world.stepSimulation(1e-3, 0); }, 500), "");
  for (const auto& body : bodies) world.removeRigidBody(body.get());
}

}  // namespace

int main() {
  std::printf("{\n");
  measureArm();
  measureBoxes();
  std::printf("}\n");
}
