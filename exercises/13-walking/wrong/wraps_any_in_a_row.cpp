// caught by: corners
// mistake: wraps the points like a gift, and takes any of several in one direction.

// <solution supportCorners>
const Eigen::Index n = contacts.cols();
std::vector<Eigen::Index> chosen;
Eigen::Index at = 0;
for (Eigen::Index i = 1; i < n; ++i)
  if (contacts(0, i) < contacts(0, at)) at = i;
const Eigen::Index first = at;
do {
  chosen.push_back(at);
  Eigen::Index next = at == 0 ? 1 : 0;
  for (Eigen::Index i = 0; i < n && next < n; ++i) {
    const Eigen::Vector2d way = contacts.col(next) - contacts.col(at),
                          to = contacts.col(i) - contacts.col(at);
    if (way.x() * to.y() - way.y() * to.x() < 0) next = i;
  }
  at = next;
} while (at < n && at != first && static_cast<Eigen::Index>(chosen.size()) < n);
Eigen::MatrixXd result(2, n == 0 ? 0 : chosen.size());
for (Eigen::Index i = 0; i < result.cols(); ++i)
  result.col(i) = contacts.col(chosen[static_cast<std::size_t>(i)]);
return result;
// </solution>
