// caught by: car-step, car-view, car-bearing, car-any, kf-step, kf-track
// mistake: sigma itself on the diagonals of Q and W, as on the sheet.

// <solution stepNoise>
return car.dynamicsNoise * Eigen::MatrixXd::Identity(3, 3);
// </solution>

// <solution viewNoise>
const double second = car.rangeBearing ? car.bearingNoise : car.observationNoise;
W(0, 0) = car.observationNoise;
W(1, 1) = second;
// </solution>
