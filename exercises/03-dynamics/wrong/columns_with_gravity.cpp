// caught by: chain-terms
// mistake: as the slide has it: NE(q, 0, e_i) without subtracting G.

// <solution inertiaMatrix>
for (Eigen::Index i = 0; i < q.size(); ++i)
  M.col(i) = newtonEuler(chain, q, zero, Eigen::VectorXd::Unit(q.size(), i), Eigen::Vector3d(0, 0, -9.81));
// </solution>
