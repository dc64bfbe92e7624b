// caught by: book, frames-elsewhere
// mistake: Turns the book clockwise: the rotation is transposed.

// <solution bookPose>
const double c = std::cos(angle), s = std::sin(angle);
Eigen::Matrix3d X_WB;
X_WB << c, s, move.x(), -s, c, move.y(), 0, 0, 1;
return X_WB;
// </solution>
