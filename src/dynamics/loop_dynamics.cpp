#include "dynamics/loop_dynamics.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include "base/error.h"
#include "base/require.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/inverse_dynamics.h"
#include "kinematics/closed_loops.h"

namespace rex {
namespace {

// What forces along the rows of J do to a mechanism.
struct LoopInertia {
  Eigen::LLT<Eigen::MatrixXd> factors;  // of M
  Eigen::MatrixXd response;             // nv x rows: M^-1 J^T
  Eigen::JacobiSVD<Eigen::MatrixXd> svd;

  LoopInertia(const Model& model, const Eigen::VectorXd& q, const Eigen::MatrixXd& J)
      : factors(massMatrix(model, q)),
        response(factors.solve(Eigen::MatrixXd(J.transpose()))),
        svd(Eigen::MatrixXd(J * response), Eigen::ComputeThinU | Eigen::ComputeThinV) {
    svd.setThreshold(1e-11);  // of squares
  }
};

}  // namespace

LoopMotion loopDynamics(const Model& model, const State& state, std::span<const TaskMap> loops,
                        const VectorArg& u, const LoopDynamicsOptions& options) {
  requireNotNegative("stabilisation of loops", options.stabilisation);
  LoopMotion motion{.a = forwardDynamics(model, state.q, state.v, u, options.gravity_W)};
  const TaskValue at = stackLoops(model, loops, state.q);
  if (at.y.size() == 0) return motion;
  const double rate = options.stabilisation;
  Eigen::VectorXd wanted = -2 * rate * (at.J * state.v) - rate * rate * at.y - at.J * motion.a;
  Eigen::Index row = 0;
  for (const TaskMap& map : loops) {
    const Eigen::VectorXd drift = velocityAcceleration(model, state, map);
    wanted.segment(row, drift.size()) -= drift;
    row += drift.size();
  }
  const LoopInertia inertia(model, state.q, at.J);
  motion.forces = inertia.svd.solve(wanted);
  motion.a += inertia.response * motion.forces;
  return motion;
}

LoopResponse loopResponse(const Model& model, const VectorArg& q, std::span<const TaskMap> loops) {
  const TaskValue at = stackLoops(model, loops, q);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(model.nv(), model.nv());
  if (at.y.size() == 0)
    return {Eigen::LLT<Eigen::MatrixXd>(massMatrix(model, q)).solve(identity),
            Eigen::MatrixXd(0, model.nv())};
  const LoopInertia inertia(model, q, at.J);
  LoopResponse response{.a_u = inertia.factors.solve(identity),
                        .forces_u = -inertia.svd.solve(Eigen::MatrixXd(inertia.response.transpose()))};
  response.a_u += inertia.response * response.forces_u;
  return response;
}

State closedState(const Model& model, const State& state, std::span<const TaskMap> loops) {
  const ClosedPosture posture = assemble(model, loops, state.q);
  if (posture.status != ClosedPosture::Status::kClosed)
    throw Error({.what = "loops of the mechanism", .found = posture.message, .wanted = "ends that meet"});
  State closed{posture.q, state.v, state.time};
  const TaskValue at = stackLoops(model, loops, closed.q);
  if (at.y.size() == 0) return closed;
  const LoopInertia inertia(model, closed.q, at.J);
  closed.v -= inertia.response * inertia.svd.solve(Eigen::VectorXd(at.J * closed.v));
  return closed;
}

}  // namespace rex
