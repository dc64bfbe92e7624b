// caught by: forbidden-call
// mistake: the library's distance in phase space.

// <solution effort>
return leastEffort(from, to, T);
// </solution>
