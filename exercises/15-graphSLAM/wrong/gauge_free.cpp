// caught by: equations-step, adjust-streets
// mistake: solves for all poses, although nothing says where the map lies.

// <solution gaussNewtonStep>
const NormalEquations equations = normalEquations(map, weights);
const int unknowns = static_cast<int>(step.size());
std::vector<MatrixEntry> H;
for (const MatrixEntry& entry : equations.H) H.push_back(entry);
for (int k = 0; k < unknowns; ++k) H.push_back({k, k, damping});
step.tail(unknowns) = solveSparse(H, -equations.b.tail(unknowns));
// </solution>
