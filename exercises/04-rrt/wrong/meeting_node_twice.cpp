// caught by: connect-joined, connect-arm, connect-worlds
// mistake: the node where the trees meet belongs to both, and so it is in the path twice.

// <solution joinedPath>
path = wayFromRoot(fromStart, a);
const Path rest = wayFromRoot(fromGoal, b);
path.insert(path.end(), rest.rbegin(), rest.rend());
// </solution>
