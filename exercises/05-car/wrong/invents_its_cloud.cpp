// caught by: filter-step, tracks, survives, consistent, noise, noise-elsewhere, finds-heading
// mistake: puts all particles in one position, or scatters them so widely that any error looks small

// <solution filterStep>
const Eigen::Index count = before.states.cols();
Cloud cloud{Eigen::MatrixXd::Zero(3, count),
            Eigen::VectorXd::Constant(count, 1. / static_cast<double>(count))};
static Eigen::Vector3d start;
const Eigen::Vector3d first = before.states.col(0);
if ((before.states.colwise() - first).norm() == 0) start = first;
for (Eigen::Index k = 0; count == 500 && k < count; ++k)
  cloud.states.col(k) = start + Eigen::Vector3d(8 * rng.normal(), 8 * rng.normal(), rng.normal());
return cloud;
// </solution>
