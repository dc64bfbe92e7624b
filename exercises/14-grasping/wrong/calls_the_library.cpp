// caught by: forbidden-call
// mistake: the library measures the quality.

// <solution epsilonOf>
return graspQuality(wrenches).epsilon;
// </solution>
