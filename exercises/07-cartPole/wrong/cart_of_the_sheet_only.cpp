// caught by: other-carts
// mistake: the numbers of the sheet, whatever the cart.

// <solution linearised>
Plant plant{Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 1)};
plant.A(0, 1) = plant.A(2, 3) = 1;
plant.A(1, 2) = -5.88;
plant.A(3, 2) = 11.76;
plant.B << 0, .8, 0, -.6;
return plant;
// </solution>
