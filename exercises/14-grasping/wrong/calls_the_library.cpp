// caught by: forbidden-call
// mistake: the library judges.

// <solution judged>
const Closure closure = forceClosure(wrenches);
const bool closed = closure.status == ClosureStatus::kClosed;
return {closed, closed ? closure.weights : closure.direction};
// </solution>
