// caught by: mean-pose
// shown by: mean-pose
// mistake: the mean of the headings 3.1 and -3.1 is taken to be zero.

// <solution meanPose>
return cloud.states * cloud.weights;
// </solution>
