// caught by: chain-forces, chain-terms, chain-any
// mistake: passes on the torque, but not the torque of the force with its lever arm.

// <solution newtonEuler>
// Everything in the frame of its own link: w and wd turn it, pdd is the acceleration of its origin, f and
// torque are what it takes from the link before. A world that falls upwards stands for gravity.
std::vector<Eigen::Matrix3d> R_PL;
std::vector<Eigen::Vector3d> f, torque;
Eigen::Vector3d w = Eigen::Vector3d::Zero(), wd = Eigen::Vector3d::Zero(), pdd = -gravity;
for (Eigen::Index i = 0; i < n; ++i) {
  const ChainLink& link = chain[static_cast<std::size_t>(i)];
  const Eigen::Matrix3d R = link.R_PL0 * Eigen::AngleAxisd(q[i], link.axis).toRotationMatrix();
  pdd = R.transpose() * (pdd + wd.cross(link.p_PL) + w.cross(w.cross(link.p_PL)));
  const Eigen::Vector3d carried = R.transpose() * w;
  w = carried + v[i] * link.axis;
  wd = R.transpose() * wd + a[i] * link.axis + v[i] * carried.cross(link.axis);
  const Eigen::Vector3d cdd = pdd + wd.cross(link.center) + w.cross(w.cross(link.center));
  R_PL.push_back(R);
  f.emplace_back(link.mass * cdd);
  torque.emplace_back(link.inertia * wd + w.cross(link.inertia * w) + link.center.cross(f.back()));
}
for (Eigen::Index i = n - 1; i >= 0; --i) {
  const auto k = static_cast<std::size_t>(i);
  u[i] = chain[k].axis.dot(torque[k]);
  if (i == 0) break;
  const Eigen::Vector3d handed = R_PL[k] * f[k];
  f[k - 1] += handed;
  torque[k - 1] += R_PL[k] * torque[k];
}
// </solution>
