// caught by: frames, frames-elsewhere
// mistake: The inverse has the opposite translation, but in the axes of the wrong frame.

// <solution inverted>
Eigen::Matrix3d X_BA = X_AB;
X_BA.topLeftCorner<2, 2>() = X_AB.topLeftCorner<2, 2>().transpose();
X_BA.topRightCorner<2, 1>() = -X_AB.topRightCorner<2, 1>();
return X_BA;
// </solution>
