// caught by: chain-terms
// mistake: as the slide has it: C v + G.

// <solution coriolisTerm>
return newtonEuler(chain, q, v, Eigen::VectorXd::Zero(q.size()), Eigen::Vector3d(0, 0, -9.81));
// </solution>
