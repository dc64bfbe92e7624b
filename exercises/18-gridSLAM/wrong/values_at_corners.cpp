// caught by: fits, more-fits
// mistake: values belong to the lower left corners of cells.

// <solution valueAt>
const Eigen::Vector2d share = ((p - grid.origin) / grid.cell).array() - 0.;
const double x = std::clamp(share[0], 0., static_cast<double>(grid.values.rows() - 1)),
             y = std::clamp(share[1], 0., static_cast<double>(grid.values.cols() - 1));
const Eigen::Index i = std::min(static_cast<Eigen::Index>(x), grid.values.rows() - 2),
                   j = std::min(static_cast<Eigen::Index>(y), grid.values.cols() - 2);
const double a = x - static_cast<double>(i), b = y - static_cast<double>(j);
return (1 - b) * ((1 - a) * grid.values(i, j) + a * grid.values(i + 1, j)) +
       b * ((1 - a) * grid.values(i, j + 1) + a * grid.values(i + 1, j + 1));
// </solution>
