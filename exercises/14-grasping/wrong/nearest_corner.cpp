// caught by: radius, any-radius
// mistake: the distance of the nearest corner of the hull, instead of the nearest face.

// <solution epsilonOf>
return judged(wrenches).closed ? wrenches.colwise().norm().minCoeff() : 0;
// </solution>
