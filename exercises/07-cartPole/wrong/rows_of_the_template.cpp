// caught by: linear, other-carts
// mistake: the accelerations in the order of the sheet's template.

// <solution linearised>
const double c1 = 1 / (cart.poleMass + cart.cartMass), c2 = cart.l * cart.poleMass * c1;
const double D = 4 * cart.l / 3 - c2;
Plant plant{Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 1)};
plant.A(0, 1) = plant.A(2, 3) = 1;
plant.A(1, 2) = cart.g / D;
plant.A(3, 2) = -c2 * cart.g / D;
plant.B << 0, -c1 / D, 0, c1 + c1* c2 / D;
return plant;
// </solution>
