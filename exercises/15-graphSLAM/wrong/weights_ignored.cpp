// caught by: equations-step, equations-any
// mistake: the step solves the equations of a map whose edges all count alike.

// <solution gaussNewtonStep>
const NormalEquations equations = normalEquations(map, std::vector<double>(weights.size(), 1));
const int unknowns = static_cast<int>(step.size()) - 3;
// Without the rows and columns of pose 0.
std::vector<MatrixEntry> H;
for (const MatrixEntry& entry : equations.H)
  if (entry.row >= 3 && entry.column >= 3) H.push_back({entry.row - 3, entry.column - 3, entry.value});
for (int k = 0; k < unknowns; ++k) H.push_back({k, k, damping});
step.tail(unknowns) = solveSparse(H, -equations.b.tail(unknowns));
// </solution>
