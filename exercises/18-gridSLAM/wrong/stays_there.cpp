// caught by: match, more-matches
// shown by: match
// mistake: the guess itself.

// <solution matched>
return guess;
// </solution>
