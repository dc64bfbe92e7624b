// caught by: forbidden-call
// mistake: lets the library calibrate the camera.

// <solution headers>
#include "estimation/camera_calibration.h"
// </solution>

// <solution refined>
best = calibratedCamera(points, pixels).P;
// </solution>
