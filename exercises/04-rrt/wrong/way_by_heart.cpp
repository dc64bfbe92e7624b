// caught by: backward-arm, backward-worlds
// mistake: postures of a path that was found once; the edges are tested, but the answers ignored.

// <solution growBackward>
constexpr double kWay[][7] = {{1.02826, 0.01644, -1.70668, 0.94866, 2.06370, -0.64979, -1.63454},
                              {1.03890, -0.04396, -1.66967, 0.99432, 2.04121, -0.64385, -1.65567},
                              {1.04541, -0.08494, -1.64533, 1.02449, 2.02635, -0.63800, -1.66958},
                              {1.05907, -0.17225, -1.59370, 1.08855, 1.99480, -0.62497, -1.69910},
                              {1.06665, -0.25729, -1.54777, 1.14852, 1.96825, -0.60540, -1.72752},
                              {1.06803, -0.38567, -1.48607, 1.23479, 1.93555, -0.56371, -1.76985},
                              {1.06770, -0.39736, -1.48079, 1.24246, 1.93290, -0.55937, -1.77368},
                              {1.06009, -0.49972, -1.43773, 1.31059, 1.90654, -0.51777, -1.80670},
                              {1.05525, -0.54637, -1.41901, 1.34192, 1.89361, -0.49776, -1.82160},
                              {1.04429, -0.57877, -1.41100, 1.36530, 1.87957, -0.47807, -1.83113},
                              {1.02630, -0.58148, -1.42155, 1.37087, 1.86704, -0.46340, -1.83008}};
Tree& tree = search.tree;
const auto go = [&](const Eigen::VectorXd& place) {
  while (tree.nodes.back() != place) {
    const Eigen::VectorXd from = tree.nodes.back();
    tree.nodes.push_back(stepTowards(from, place, settings.stepSize));
    tree.parents.push_back(static_cast<int>(tree.parents.size()) - 1);
    edgeFree(from, tree.nodes.back());
  }
};
if (goal.size() == 7)
  for (const auto& place : kWay) go(Eigen::Map<const Eigen::VectorXd>(place, 7));
go(start);
search.path.assign(tree.nodes.rbegin(), tree.nodes.rend());
// </solution>
