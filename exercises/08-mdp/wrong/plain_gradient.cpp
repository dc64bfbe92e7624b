// caught by: natural, linear-returns, other-features
// shown by: natural
// mistake: returns the gradient as it is.

// <solution naturalGradientOf>
return reinforce(policy, trials, discount);
// </solution>
