// caught by: pin-upright, pin-any-tilt
// shown by: pin-upright
// mistake: keeps the pin upright at any price: the arm runs away with it.

// <solution balancePin>
const Eigen::VectorXd q = S.getJointAngles(), v = S.getJointVels();
Eigen::MatrixXd M;
Eigen::VectorXd F;
S.getDynamics(M, F);
S.setJointAngles(home);
const Eigen::Vector2d footAtHome = S.kinematicsPos("universalJoint").head<2>();
const auto J = [&](double h) -> Eigen::MatrixXd {
  S.setJointAngles(q + h * v);
  return S.jacobianVec("pin").topRows(2);
};
const double h = 1e-5 / (1 + v.norm());
AccelerationTask task{Eigen::MatrixXd(8, 8), Eigen::VectorXd::Zero(8), Eigen::VectorXd(8),
                      Eigen::MatrixXd::Identity(8, 8)};
task.bias.head(2) = (J(h) - J(-h)) * v / (2 * h);
task.J << J(0), Eigen::MatrixXd::Identity(6, 8);
// The foot can only go where the pin leans: as on an inclined plane, it accelerates by g times the tilt.
// So the tilt takes orders from a slow controller of the foot, and is itself one of the two tasks. Four
// ways are left to the arm; in those it goes home.
const Eigen::Vector2d foot = S.kinematicsPos("universalJoint").head<2>();
const Eigen::Vector2d footVelocity = S.jacobianPos("universalJoint").topRows(2) * v;
const PathPoint stay{footAtHome, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
const Eigen::VectorXd lean = wantedAcceleration(foot, footVelocity, stay, 2, 1) * 0;
const PathPoint upright{lean, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
const PathPoint atHome{home.head(6), Eigen::VectorXd::Zero(6), Eigen::VectorXd::Zero(6)};
task.ydd << wantedAcceleration(S.kinematicsVec("pin").head(2), J(0) * v, upright, 0.25, 1),
    wantedAcceleration(q.head(6), v.head(6), atHome, 0.5, 1);
task.C.topLeftCorner(2, 2) *= 1e4;
// Forces that nobody can afford are not used.
Eigen::MatrixXd H = 1e-4 * Eigen::MatrixXd::Identity(8, 8);
H.bottomRightCorner(2, 2) = 1e8 * Eigen::Matrix2d::Identity();
u.head(6) = operationalForce(task, M, F, H).head(6);
// </solution>
