// caught by: rays
// mistake: the row comes first, as in a picture.

// <solution cellAt>
return {static_cast<int>(std::floor((p.y() - grid.origin.y()) / grid.cell)),
        static_cast<int>(std::floor((p.x() - grid.origin.x()) / grid.cell))};
// </solution>
