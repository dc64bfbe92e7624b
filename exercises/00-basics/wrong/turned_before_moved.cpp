// caught by: book, frames-elsewhere
// mistake: Moves the book along its own axes, after turning it.

// <solution bookPose>
const double c = std::cos(angle), s = std::sin(angle);
Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(), shift = Eigen::Matrix3d::Identity();
turn.topLeftCorner<2, 2>() << c, -s, s, c;
shift.topRightCorner<2, 1>() = move;
return turn * shift;
// </solution>
