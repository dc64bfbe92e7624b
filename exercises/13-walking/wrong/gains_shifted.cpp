// caught by: gains, gains-any
// mistake: the gains of the preview begin one time step too late.

// <solution previewLaw>
const Eigen::RowVector3d C(1, 0, -cart.height / cart.g);
Eigen::Matrix3d A;
for (int i = 0; i < 3; ++i) A.col(i) = cartStep(cart, Eigen::Vector3d::Unit(i), 0);
const Eigen::Vector3d B = cartStep(cart, Eigen::Vector3d::Zero(), 1);
Eigen::Matrix4d F = Eigen::Matrix4d::Zero(), Q = Eigen::Matrix4d::Zero();
F(0, 0) = 1;
F.topRightCorner<1, 3>() = C * A;
F.bottomRightCorner<3, 3>() = A;
const Eigen::Vector4d G = (Eigen::Vector4d() << C * B, B).finished();
Q(0, 0) = cart.Qe;
const RiccatiResult riccati = solveDare(F, G, Q, Eigen::MatrixXd::Constant(1, 1, cart.R));
const Eigen::Matrix4d X = riccati.X, loop = F - G * riccati.K;
PreviewLaw law{riccati.K(0, 0), riccati.K.rightCols<3>(), Eigen::VectorXd(cart.ahead)};
Eigen::Vector4d cost = loop.transpose() * X.col(0);
for (double& gain : law.Gp) {
  gain = G.dot(cost) / (cart.R + G.dot(X * G));
  cost = (loop.transpose() * cost).eval();
}
return law;
// </solution>
