// caught by: prm-straight, prm-join
// shown by: prm-straight, prm-join
// mistake: tests the ends of an edge, not what lies between.

// <solution straightIsFree>
return isFree(yard, a) && isFree(yard, b);
// </solution>
