// caught by: frames, frames-elsewhere
// mistake: The letters in the middle do not meet: X_WB stands before X_AW.

// <solution seenFrom>
return X_WB * inverted(X_WA);
// </solution>
