// caught by: search, stays, unseen-search
// mistake: does not search; takes weights that balance the racer of the sheet, wired as it is there.

// <solution searchedPolicy>
Eigen::VectorXd w = Eigen::VectorXd::Zero(kFeatures);
w.head(9) << .0005, -1.31, 8.28, 1.34, .166, .0045, -.0195, -.0054, .0907;
return w;
// </solution>
