// caught by: connect-joined, connect-plane, connect-worlds
// shown by: connect-joined
// mistake: the path of the second tree is appended as it is, from the goal to the middle.

// <solution joinedPath>
path = wayFromRoot(fromStart, a);
Path rest = wayFromRoot(fromGoal, b);
if (rest.back() == path.back()) rest.pop_back();
path.insert(path.end(), rest.begin(), rest.end());
// </solution>
