// caught by: connect-joined, connect-arm, connect-worlds
// shown by: connect-joined, connect-arm
// mistake: the node where the trees meet belongs to both, and so it is in the path twice.

// <solution joinedPath>
path = wayFromRoot(fromStart, a);
const Path rest = wayFromRoot(fromGoal, b);
path.insert(path.end(), rest.rbegin(), rest.rend());
// </solution>
