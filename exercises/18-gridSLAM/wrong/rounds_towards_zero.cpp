// caught by: rays, more-rays
// mistake: a cast to int, which is one cell too far left of the origin.

// <solution cellAt>
return {static_cast<int>((p.x() - grid.origin.x()) / grid.cell),
        static_cast<int>((p.y() - grid.origin.y()) / grid.cell)};
// </solution>
