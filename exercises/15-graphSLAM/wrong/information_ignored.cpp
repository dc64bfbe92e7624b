// caught by: equations-cost, equations-normal, adjust-streets
// mistake: weighs all entries of an error equally.

// <solution mapCost>
for (const MeasuredEdge& edge : map.edges) {
  const Eigen::Vector3d e = edgeError(map.poses[static_cast<std::size_t>(edge.from)],
                                      map.poses[static_cast<std::size_t>(edge.to)], edge.motion);
  cost += e.dot(e);
}
// </solution>

// <solution normalEquations>
for (std::size_t k = 0; k < map.edges.size(); ++k) {
  const MeasuredEdge& edge = map.edges[k];
  const Eigen::Vector3d &i = map.poses[static_cast<std::size_t>(edge.from)],
                        &j = map.poses[static_cast<std::size_t>(edge.to)];
  const EdgeJacobians J = edgeJacobians(i, j, edge.motion);
  const Eigen::Matrix3d omega = weights[k] * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d ofI = J.byI.transpose() * omega, ofJ = J.byJ.transpose() * omega;
  const Eigen::Vector3d e = edgeError(i, j, edge.motion);
  addBlock(equations.H, edge.from, edge.from, ofI * J.byI);
  addBlock(equations.H, edge.from, edge.to, ofI * J.byJ);
  addBlock(equations.H, edge.to, edge.from, ofJ * J.byI);
  addBlock(equations.H, edge.to, edge.to, ofJ * J.byJ);
  equations.b.segment<3>(3 * edge.from) += ofI * e;
  equations.b.segment<3>(3 * edge.to) += ofJ * e;
}
// </solution>
